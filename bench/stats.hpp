#pragma once

// Order statistics of repeated measurements. Medians and percentiles, because timings on a shared
// machine have a long upper tail that a mean would follow.

#include <cstddef>
#include <span>
#include <vector>

namespace harpoon::bench {

/// Linear interpolation between closest ranks; `quantile` in [0, 1]. `values` must not be empty.
/// O(n log n), on a copy.
double quantile_of(std::span<const double> values, double quantile);

/// What a set of samples says, in the unit of the samples.
struct Summary {
  double median = 0;
  double min = 0;
  double low = 0;   ///< 10th percentile
  double high = 0;  ///< 90th percentile
  std::size_t samples = 0;
};

/// All zero when `values` is empty.
Summary summarize(std::span<const double> values);

/// The straight line through points (x, y) by least squares.
struct LineFit {
  double intercept = 0;
  double slope = 0;
  double r_squared = 0;  ///< share of the variance of y that the line explains, 0 to 1
};

/// Needs at least two different x; `x` and `y` have equal length.
LineFit fit_line(std::span<const double> x, std::span<const double> y);

}  // namespace harpoon::bench
