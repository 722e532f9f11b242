#pragma once

// What the sort and the search must agree on: how a body's coordinates become a cell, a bucket and
// the buckets around it. Plain data, chosen by plan.cpp, read by the kernels. docs/scene.md proves
// that no contact is lost.

#include <cstddef>
#include <cstdint>

namespace harpoon::broad {

/// Bodies that are searched together; every block starts at a multiple of this in its level.
inline constexpr std::size_t kBlockBodies = 256;
/// Elements that may be read or written past the end of a sorted array or a candidate list.
inline constexpr std::size_t kSlack = 64;

/// The grid of one level (size class). `Cull` is the number type of culling.
///
/// Along y and z the unit is the sub-cell, at least as wide as two bodies of the level can reach;
/// 2^row_shift sub-cells make a row, so a body needs a neighbouring row only when it sits in the
/// outermost sub-cell. Along x a cell is 1 / half_window of that reach. The bucket of a body is
///   (ix + stride_y * (iy >> row_shift) + stride_z * (iz >> row_shift)) & mask.
/// With mask = 2^32 - 1 buckets and cells are one to one ("dense"), with empty cells at the end of
/// every line and plane so that neighbours never run over. Otherwise the world is folded: far-apart
/// cells share a bucket, which costs tests but no memory, and no two buckets of a neighbourhood
/// coincide.
template <class Cull>
struct Grid {
  Cull origin[3] = {0, 0, 0};
  Cull cells_per_unit_x = 0;
  Cull sub_cells_per_unit = 0;
  Cull last_cell_x = 0;  ///< largest ix; bodies beyond the grid are in its outermost cells
  Cull last_sub_cell_y = 0;
  Cull last_sub_cell_z = 0;
  Cull max_radius = 0;  ///< of the level, as used for culling
  /// Spheres whose distance squared is less than that below the square of their reach may turn out
  /// not to touch; all others do.
  Cull doubtful_below = 0;
  bool short_runs = false;  ///< few bodies in a window; a matter of speed alone
  std::uint32_t row_shift = 0;
  std::uint32_t half_window = 1;
  std::uint32_t stride_y = 0;
  std::uint32_t stride_z = 0;
  std::uint32_t mask = 0xFFFFFFFFU;
  std::uint32_t buckets = 0;
  std::uint32_t begin = 0;  ///< sorted positions of the level's bodies
  std::uint32_t end = 0;
  /// ends[b] is the position after the last body of bucket b; ends[-1] == begin.
  std::uint32_t* ends = nullptr;

  [[nodiscard]] bool folded() const noexcept { return mask != 0xFFFFFFFFU; }
};

/// Spheres up to that radius, padded by so much, certainly touch where their distance squared is
/// below the square of their reach by as much or more, whatever culling rounded (docs/scene.md).
template <class Number>
constexpr Number doubtful_below(Number max_radius, Number radius_pad) noexcept {
  return max_radius * (max_radius * Number(0x1p-13) + 32 * radius_pad);
}

/// How culling coordinates and radii come from the bodies' own.
///   coordinate: Cull(x - origin), radius: Cull(r) * kRadiusScale + radius_pad
/// Where float coordinates stand for double ones, those of bodies far from the origin are rounded
/// more: their radii are padded by kFarPad of their largest coordinate where that is more.
struct CullMap {
  double origin[3] = {0, 0, 0};
  double radius_pad = 0;
};
inline constexpr double kRadiusScale = 1.0 + 0x1p-19;
inline constexpr double kFarPad = 0x1p-22;
/// Below these distances squares underflow and the collider finds the centres to coincide.
template <class Real, class Cull>
inline constexpr double kUnderflowPad = sizeof(Real) + sizeof(Cull) == 16 ? 0x1p-520 : 0x1p-60;
/// Double coordinates and radii are brought within these before they become float: squares stay
/// finite, bodies only come closer, and a radius so large reaches everything.
inline constexpr double kFarCoordinate = 0x1p60;
inline constexpr double kFarRadius = 0x1p62;

/// Sorted bodies as the search reads them: culling coordinates, one array each. For spheres x, y, z
/// is the centre. For boxes it is the place in the grid, r half of the longest side, and both
/// corners come with it. The place is the lowest corner, but 0 along an axis that the grid ignores.
template <class Cull>
struct CullArrays {
  Cull *x, *y, *z, *r;
  Cull *low_x = nullptr, *low_y = nullptr, *low_z = nullptr;
  Cull *high_x = nullptr, *high_y = nullptr, *high_z = nullptr;
};

/// Boxes of nodes of trees, one array each.
template <class Cull>
struct NodeBoxes {
  Cull *low_x = nullptr, *low_y = nullptr, *low_z = nullptr;
  Cull *high_x = nullptr, *high_y = nullptr, *high_z = nullptr;
};

/// Children of a node, and bodies of a leaf.
inline constexpr std::uint32_t kTreeWidth = 16;
inline constexpr std::size_t kMaxTreeLevels = 8;

/// A tree over sorted bodies without pointers: leaf k holds the bodies from begin + 16 k on, node k
/// of a level those of the nodes from 16 k on of the level below. There are at least two levels,
/// and at most 16 nodes in the last. Every level begins at a multiple of 16 nodes and is filled up
/// to one with boxes that meet nothing.
template <class Cull>
struct Tree {
  NodeBoxes<Cull> boxes;
  std::uint32_t begin = 0, end = 0;  ///< sorted positions
  Cull max_radius = 0;               ///< of its spheres, as used for culling
  std::uint32_t levels = 0;
  std::uint32_t first[kMaxTreeLevels] = {};  ///< node of each level
  std::uint32_t count[kMaxTreeLevels] = {};
};
static_assert(kBlockBodies == std::size_t{kTreeWidth} * kTreeWidth, "a block is a node");

}  // namespace harpoon::broad
