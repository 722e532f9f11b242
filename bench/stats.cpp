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

double second_of_minima(std::span<const double> values) {
  constexpr std::size_t kParts = 4;
  const std::size_t parts = std::min(kParts, values.size());
  std::vector<double> minima;
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t begin = part * values.size() / parts;
    const std::size_t end = (part + 1) * values.size() / parts;
    minima.push_back(*std::min_element(values.begin() + static_cast<std::ptrdiff_t>(begin),
                                       values.begin() + static_cast<std::ptrdiff_t>(end)));
  }
  std::sort(minima.begin(), minima.end());
  return minima[std::min<std::size_t>(1, parts - 1)];
}

// The upper quartile of the distances from `centre`.
double spread_around(std::span<const double> values, double centre) {
  std::vector<double> distances;
  for (const double value : values) {
    distances.push_back(std::abs(value - centre));
  }
  return quantile_of_sorted(sorted_copy(distances), 0.75);
}

}  // namespace

double quantile_of(std::span<const double> values, double quantile) {
  return quantile_of_sorted(sorted_copy(values), quantile);
}

Range ratio_of(const Range& a, const Range& b) {
  return {a.low / b.high, a.high / b.low};
}

Summary summarize(std::span<const double> values) {
  if (values.empty()) {
    return {};
  }
  const std::vector<double> sorted = sorted_copy(values);
  return {quantile_of_sorted(sorted, 0.5), sorted.front(), quantile_of_sorted(sorted, 0.1),
          quantile_of_sorted(sorted, 0.9), sorted.size(),  second_of_minima(values)};
}

LineFit fit_line(std::span<const double> x, std::span<const double> y) {
  std::vector<double> slopes;
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (x[i] != x[j]) {
        slopes.push_back((y[i] - y[j]) / (x[i] - x[j]));
      }
    }
  }
  LineFit fit;
  fit.slope = quantile_of(slopes, 0.5);
  std::vector<double> rests;
  for (std::size_t i = 0; i < x.size(); ++i) {
    rests.push_back(y[i] - fit.slope * x[i]);
  }
  fit.intercept = quantile_of(rests, 0.5);
  fit.residual = spread_around(rests, fit.intercept);
  const double spread = spread_around(y, quantile_of(y, 0.5));
  // A horizontal set of points is a line exactly.
  fit.explained = spread > 0 ? 1 - (fit.residual / spread) * (fit.residual / spread) : 1;
  return fit;
}

}  // namespace harpoon::bench
