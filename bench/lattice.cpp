#include "bench/lattice.hpp"

#include <cstdlib>

namespace harpoon::bench {

std::uint64_t diamond_sphere_count(std::uint64_t h_max) {
  return (2 * h_max + 1) * (2 * h_max * h_max + 2 * h_max + 3) / 3;
}

std::vector<Point> diamond_points(unsigned h_max, double spacing) {
  const int h = static_cast<int>(h_max);
  std::vector<Point> points;
  points.reserve(diamond_sphere_count(h_max));
  for (int i = -h; i <= h; ++i) {
    const int rest_i = h - std::abs(i);
    for (int j = -rest_i; j <= rest_i; ++j) {
      const int rest_j = rest_i - std::abs(j);
      for (int k = -rest_j; k <= rest_j; ++k) {
        points.push_back({i * spacing, j * spacing, k * spacing});
      }
    }
  }
  return points;
}

}  // namespace harpoon::bench
