#pragma once

// Chooses levels (size classes of radii) and their grids so that the search costs least. Depends on
// the set of bodies only: not on threads, instruction set or earlier frames, because the order of
// results follows from it.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "broad/grid.hpp"

namespace harpoon::broad {

/// Radii are classed by powers of two below the largest; the last class takes all the rest.
inline constexpr std::size_t kRadiusClasses = 24;

struct RadiusClass {
  std::size_t bodies = 0;
  double max_radius = 0;
};

/// What the plan is made from. Radii are the bodies' own; `margin` is added to every distance at
/// which two bodies count as near.
struct Census {
  std::size_t bodies = 0;
  double min[3] = {0, 0, 0};  ///< the world, or the core of it where most bodies are
  double max[3] = {0, 0, 0};
  bool bodies_beyond = false;  ///< some are beyond min or max
  double margin = 0;
  std::size_t giants = 0;      ///< bodies in no grid, which are tested against blocks of the others
  bool giants_abound = false;  ///< too many for that, so they are among the others
  double giant_distance = 0;   ///< largest of those that come near the core
  bool cull_double = false;    ///< culling has to be in double
  std::size_t real_digits = std::numeric_limits<float>::digits;
  std::array<RadiusClass, kRadiusClasses> classes;
  /// How much of each axis the bodies occupy; the whole extent where that is not known.
  double occupied[3] = {0, 0, 0};
};

/// Geometry of one level.
struct LevelPlan {
  std::size_t bodies = 0;
  double max_radius = 0;  ///< as used for culling
  double sub_cell = 0;
  double cell_x = 0;
  std::uint32_t row_shift = 0;
  std::uint32_t half_window = 1;
  bool folded = false;
  double candidates = 0;       ///< in a window, on average
  bool bodies_beyond = false;  ///< as in the census
  bool bordered = false;       ///< empty rows lie between the world and what is beyond it
};

struct Plan {
  std::array<LevelPlan, kRadiusClasses> levels;  ///< coarsest first
  std::size_t level_count = 0;
  std::array<std::uint8_t, kRadiusClasses> level_of_class = {};
  bool cull_double = false;
  bool in_trees = false;  ///< no grid is any good
  CullMap map;
};

/// True when most of the bodies' bounding box must be empty, so that `Census::occupied` matters.
bool is_sparse(const Census& census) noexcept;

Plan make_plan(const Census& census) noexcept;

/// The grid of a level, without its table and positions. `min` and `max` are the extremes of the
/// bodies' culling coordinates.
template <class Cull>
Grid<Cull> make_grid(const LevelPlan& level, const CullMap& map, const Cull min[3],
                     const Cull max[3]) noexcept;

}  // namespace harpoon::broad
