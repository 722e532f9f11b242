#pragma once

// The diamond of the paper's section IV.B as a set of lattice points, without physics.

#include <array>
#include <cstdint>
#include <vector>

namespace harpoon::bench {

using Point = std::array<double, 3>;

/// Number of points with |i| + |j| + |k| <= h_max: 25, 63, 1561, 37881 for 2, 3, 10, 30.
/// `h_max` counts the shells around the centre sphere, so the diamond is 2 h_max + 1 spheres high.
std::uint64_t diamond_sphere_count(std::uint64_t h_max);

/// The points themselves, `spacing` apart and centred on the origin, in lexicographic order of
/// (i, j, k).
std::vector<Point> diamond_points(unsigned h_max, double spacing);

}  // namespace harpoon::bench
