#include "bench/stats.hpp"

#include <algorithm>
#include <cmath>

namespace harpoon::bench {
namespace {

double quantile_of_sorted(const std::vector<double>& sorted, double quantile) {
  const double rank = quantile * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(std::floor(rank));
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  const double share = rank - static_cast<double>(below);
  return sorted[below] + share * (sorted[above] - sorted[below]);
}

std::vector<double> sorted_copy(std::span<const double> values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

}  // namespace

double quantile_of(std::span<const double> values, double quantile) {
  return quantile_of_sorted(sorted_copy(values), quantile);
}

Summary summarize(std::span<const double> values) {
  if (values.empty()) {
    return {};
  }
  const std::vector<double> sorted = sorted_copy(values);
  return {quantile_of_sorted(sorted, 0.5), sorted.front(), quantile_of_sorted(sorted, 0.1),
          quantile_of_sorted(sorted, 0.9), sorted.size()};
}

LineFit fit_line(std::span<const double> x, std::span<const double> y) {
  const auto n = static_cast<double>(x.size());
  double mean_x = 0;
  double mean_y = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  double xx = 0;
  double xy = 0;
  double yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
  }
  const double slope = xy / xx;
  // A horizontal set of points is a line exactly.
  const double r_squared = yy > 0 ? (xy * xy) / (xx * yy) : 1;
  return {mean_y - slope * mean_x, slope, r_squared};
}

}  // namespace harpoon::bench
