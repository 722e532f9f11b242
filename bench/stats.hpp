#pragma once

// Order statistics of repeated measurements. Medians and percentiles, because timings on a shared
// machine have a long upper tail that a mean would follow; for verdicts the fastest times, which
// nothing else on the machine can make faster.

#include <cstddef>
#include <span>
#include <vector>

namespace harpoon::bench {

/// Linear interpolation between closest ranks; `quantile` in [0, 1]. `values` must not be empty.
/// O(n log n), on a copy.
double quantile_of(std::span<const double> values, double quantile);

/// A time that is known to lie within [low, high].
struct Range {
  double low = 0;
  double high = 0;

  /// How much of `low` the two ends are apart; 0 when they are equal.
  [[nodiscard]] double width() const { return low > 0 ? high / low - 1 : 0; }
};

/// All quotients of a number of `a` and one of `b`, which must be above 0.
Range ratio_of(const Range& a, const Range& b);

/// What a set of samples says, in the unit of the samples.
struct Summary {
  double median = 0;
  double min = 0;
  double low = 0;   ///< 10th percentile
  double high = 0;  ///< 90th percentile
  std::size_t samples = 0;
  /// The fastest time that was seen a second time: of the fastest times of up to four equal parts
  /// of the samples, in the order in which they were taken, the second smallest.
  double min_again = 0;

  /// The time without what else the machine did, which only ever adds to it: between the fastest
  /// that was seen and the fastest that was seen again.
  [[nodiscard]] Range undisturbed() const { return {min, min_again}; }
};

/// `values` in the order in which they were taken. All zero when empty.
Summary summarize(std::span<const double> values);

/// The straight line through points (x, y) by medians (Theil 1950, Sen 1968): up to a quarter of
/// the points may be anywhere without moving it much.
struct LineFit {
  double intercept = 0;
  double slope = 0;
  /// Share of the variation of y that the line explains, at most 1; below 0 when it explains
  /// nothing. By the upper quartiles of the distances from the line and from the median of y.
  double explained = 0;
  double residual = 0;  ///< the upper quartile of the distances from the line
};

/// Needs at least two different x; `x` and `y` have equal length. O(n^2 log n).
LineFit fit_line(std::span<const double> x, std::span<const double> y);

}  // namespace harpoon::bench
