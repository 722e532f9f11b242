// Cost model. A body looks into its own row forward and, with probability 1/s for each axis, into
// neighbouring rows (s sub-cells make a row): (1 + 1/s)^2 + 1/s^2 windows in all. Wide rows mean
// few windows but many bodies in each; a window of up to 16 bodies is one vector test. The
// constants are nanoseconds measured on one machine; only their ratios matter, and only for speed.

#include "broad/plan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace harpoon::broad {
namespace {

constexpr double kWindowNs = 2.5;  ///< to find a window
constexpr double kTestNs = 4.0;    ///< to test up to 16 bodies
constexpr double kBucketNs = 0.6;  ///< to clear, sum and cache a bucket
constexpr double kBodyNs = 3.0;    ///< to sort a body into a level of its own
constexpr double kVectorBodies = 16;
/// A further vector costs more than the first: its branch is mispredicted.
constexpr double kMoreTests = 1.6;
/// Buckets that a dense grid may have, and that a folded one has, for each body.
constexpr double kDenseBuckets = 4;
constexpr double kFoldedBuckets = 2;
constexpr double kMinBuckets = 1024;
/// Width of a sub-cell over the reach of two bodies: room for the rounding of cell numbers up to
/// kMaxCells in float (docs/scene.md).
constexpr double kReachScale = 1.0 + 0x1p-7;
constexpr double kMaxCellsFloat = 0x1p14;
constexpr double kMaxCellsDouble = 0x1p28;
/// Largest loss of a double coordinate's resolution in float that culling puts up with, as a part
/// of the radius.
constexpr double kMaxRelativePad = 0.02;
/// The same for giants, as a multiple of the radius of the largest other body.
constexpr double kMaxGiantPad = 8;
/// More giants than this are not tested against blocks of a folded grid, whose bodies are anywhere.
constexpr std::size_t kMaxGiantsOfFolded = 64;
/// What lies beyond a world of fewer cells would be near too much of it: empty rows part them.
constexpr double kBorderedCells = 16;
/// Cells along an axis with which float is always safe, and how many times the cost of culling in
/// double a plan with no more than these may have.
constexpr double kSafeCellsFloat = 0x1p13;
constexpr double kDoubleCost = 1.5;

/// Up to this many candidates in a window its tests are made for short runs.
constexpr double kShortRun = 6;

/// Vector tests for an average of `bodies` candidates in a window.
double vector_tests(double bodies) noexcept {
  return 1 + kMoreTests * bodies * bodies / (kVectorBodies * (bodies + kVectorBodies));
}

double extent(const Census& census, int axis) noexcept {
  return census.max[axis] - census.min[axis];
}

double largest_extent(const Census& census) noexcept {
  return std::max({extent(census, 0), extent(census, 1), extent(census, 2)});
}

/// One way to cut a level, and what it costs.
struct Cut {
  LevelPlan level;
  double own_ns = std::numeric_limits<double>::infinity();
  double foreign_ns = 0;  ///< for each body of a finer level
};

constexpr std::array kWidenings = {1.0, 1.5, 2.0, 3.0};
constexpr std::array kHalfWindows = {1U, 2U, 4U};
constexpr std::array kRowShifts = {0U, 1U, 2U};

/// What a choice of half_window decides along x.
struct LineCut {
  double cell, cells, share;  ///< cells of a line, part of the bodies in a window's extent
};

/// What a choice of row_shift decides along y and z.
struct RowCut {
  double windows;  ///< windows that a body looks into, its own row counted once
  double others;   ///< those beside its own row
  double rows_y, rows_z, share_y, share_z;
};

/// All cuts of a level whose sub-cell is given.
class Cutter {
 public:
  Cutter(const Census& census, double sub_cell) noexcept
      : sub_cell_(sub_cell),
        giants_(static_cast<double>(census.giants)),
        beyond_(census.bodies_beyond),
        bordered_(beyond_ && largest_extent(census) < kBorderedCells * sub_cell) {
    const auto share = [&](double window, int axis) {
      return std::min(1.0, window / std::max(census.occupied[axis], sub_cell));
    };
    for (std::size_t w = 0; w < kHalfWindows.size(); ++w) {
      const double k = kHalfWindows[w];
      const double cell = sub_cell / k;
      const double border = bordered_ ? 4 * (k + 1) : 0;
      lines_[w] = {cell, extent(census, 0) / cell + 1 + border, share((2 * k + 1) * cell, 0)};
    }
    for (std::size_t r = 0; r < kRowShifts.size(); ++r) {
      const double s = static_cast<double>(1U << kRowShifts[r]);
      const double row = s * sub_cell;
      const double windows = (1 + 1 / s) * (1 + 1 / s);
      rows_[r] = {windows,
                  windows + 1 / (s * s) - 1,
                  extent(census, 1) / row + 1 + (bordered_ ? 4 : 0),
                  extent(census, 2) / row + 1 + (bordered_ ? 4 : 0),
                  share(row, 1),
                  share(row, 2)};
    }
  }

  [[nodiscard]] Cut cut(std::size_t level_bodies, double cull_radius, std::size_t w,
                        std::size_t r) const noexcept {
    const LineCut& line = lines_[w];
    const RowCut& row = rows_[r];
    const double bodies = static_cast<double>(level_bodies);
    const double k = kHalfWindows[w];
    double buckets = (line.cells + k) * (row.rows_y + 1) * (row.rows_z + 1);
    double candidates = line.share * row.share_y * row.share_z * bodies;
    const bool folded = buckets > kDenseBuckets * bodies + kMinBuckets;
    double scans = 0;
    if (folded) {
      buckets = kFoldedBuckets * bodies + kMinBuckets;
      candidates += (2 * k + 1) / kFoldedBuckets;
      scans = giants_ / kVectorBodies;
    }
    const double full_test = kTestNs * vector_tests(candidates);
    Cut cut;
    cut.level = {level_bodies,    cull_radius, sub_cell_,  line.cell, kRowShifts[r],
                 kHalfWindows[w], folded,      candidates, beyond_,   bordered_};
    cut.own_ns = bodies * (row.others * (kWindowNs + full_test) + kBodyNs + kWindowNs +
                           kTestNs * (vector_tests(candidates / 2) + scans)) +
                 buckets * kBucketNs;
    cut.foreign_ns = row.windows * (1.5 * kWindowNs + full_test);
    return cut;
  }

 private:
  double sub_cell_, giants_;
  bool beyond_, bordered_;
  std::array<LineCut, kHalfWindows.size()> lines_;
  std::array<RowCut, kRowShifts.size()> rows_;
};

/// The best cut of a level of the given bodies.
Cut best_cut(const Census& census, std::size_t bodies, double cull_radius, bool only,
             double most_cells) noexcept {
  const double reach = std::max(2 * cull_radius, largest_extent(census) / most_cells);
  Cut best;
  for (const double widening : kWidenings) {
    const Cutter cutter(census, reach * kReachScale * widening);
    for (std::size_t r = only ? 0 : 1; r < kRowShifts.size(); ++r) {
      for (std::size_t w = 0; w < kHalfWindows.size(); ++w) {
        const Cut cut = cutter.cut(bodies, cull_radius, w, r);
        if (cut.own_ns < best.own_ns) best = cut;
      }
    }
  }
  return best;
}

CullMap cull_map(const Census& census, bool cull_double) noexcept {
  CullMap map;
  const bool real_double = census.real_digits > std::numeric_limits<float>::digits;
  map.radius_pad =
      real_double && cull_double ? kUnderflowPad<double, double> : kUnderflowPad<double, float>;
  if (real_double && !cull_double) {
    std::copy(census.min, census.min + 3, map.origin);
    map.radius_pad += largest_extent(census) * 0x1p-22;
  }
  map.radius_pad += census.margin / 2;
  return map;
}

/// Levels of the classes, coarsest first: the partition into runs of classes that costs least.
class Partition {
 public:
  Partition(const Census& census, const CullMap& map, double most_cells) noexcept {
    for (std::size_t c = 0; c < kRadiusClasses; ++c) {
      if (census.classes[c].bodies != 0) used_[used_count_++] = c;
    }
    std::array<double, kRadiusClasses + 1> cost;
    cost[0] = 0;
    std::size_t finer = census.bodies;
    for (std::size_t last = 0; last < used_count_; ++last) {
      finer -= census.classes[used_[last]].bodies;
      cost[last + 1] = std::numeric_limits<double>::infinity();
      std::size_t bodies = 0;
      double radius = 0;
      for (std::size_t first = last + 1; first-- > 0;) {
        bodies += census.classes[used_[first]].bodies;
        radius = std::max(radius, census.classes[used_[first]].max_radius);
        const Cut cut = best_cut(census, bodies, radius * kRadiusScale + map.radius_pad,
                                 used_count_ == 1, most_cells);
        const double total = cost[first] + cut.own_ns + cut.foreign_ns * static_cast<double>(finer);
        if (total < cost[last + 1]) {
          cost[last + 1] = total;
          first_[last] = first;
          cut_[last] = cut.level;
        }
      }
    }
    cost_ns_ = cost[used_count_];
  }

  [[nodiscard]] double cost_ns() const noexcept { return cost_ns_; }
  [[nodiscard]] bool of_one_class() const noexcept { return used_count_ == 1; }

  void write(Plan& plan) const noexcept {
    std::size_t boundaries[kRadiusClasses];
    std::size_t count = 0;
    for (std::size_t end = used_count_; end > 0; end = first_[end - 1]) boundaries[count++] = end;
    plan.level_count = count;
    for (std::size_t level = 0; level < count; ++level) {
      const std::size_t last = boundaries[count - 1 - level] - 1;
      plan.levels[level] = cut_[last];
      for (std::size_t u = first_[last]; u <= last; ++u) {
        plan.level_of_class[used_[u]] = static_cast<std::uint8_t>(level);
      }
    }
  }

 private:
  std::array<std::size_t, kRadiusClasses> used_ = {};
  std::size_t used_count_ = 0;
  std::array<std::size_t, kRadiusClasses> first_ = {};
  std::array<LevelPlan, kRadiusClasses> cut_;
  double cost_ns_ = 0;
};

/// Whether a world is beyond the reach of float, or so small that squares underflow.
bool beyond_float(const Census& census) noexcept {
  const double size = largest_extent(census);
  return census.real_digits > std::numeric_limits<float>::digits &&
         (size > 0x1p50 || census.margin > 0x1p50 || size < 0x1p-30);
}

/// Whether float cannot number the cells of a level safely, or loses too much of the coordinates.
bool needs_double(const Census& census, const Plan& plan) noexcept {
  const double size = largest_extent(census);
  for (std::size_t l = 0; l < plan.level_count; ++l) {
    const LevelPlan& level = plan.levels[l];
    if (size / level.cell_x > kMaxCellsFloat) return true;
    if (census.real_digits > std::numeric_limits<float>::digits &&
        size * 0x1p-22 > kMaxRelativePad * level.max_radius) {
      return true;
    }
  }
  return false;
}

/// Whether giants near the world are so far from its corner that float does not tell them apart
/// from what they touch.
bool giants_need_double(const Census& census, const Plan& plan) noexcept {
  return census.real_digits > std::numeric_limits<float>::digits && plan.level_count != 0 &&
         census.giant_distance * kFarPad > kMaxGiantPad * plan.levels[0].max_radius;
}

std::uint32_t power_of_two_at_least(double value) noexcept {
  std::uint32_t power = 1;
  while (power < value && power < 0x80000000U) power *= 2;
  return power;
}

/// Distance on the circle of `buckets` numbers.
std::uint32_t circle_distance(std::uint32_t a, std::uint32_t b, std::uint32_t buckets) noexcept {
  const std::uint32_t d = (a - b) & (buckets - 1);
  return std::min(d, buckets - d);
}

/// Strides with which no two windows of a neighbourhood share a bucket, in a folded table.
template <class Cull>
void choose_strides(Grid<Cull>& grid) noexcept {
  const std::uint32_t buckets = grid.buckets;
  const std::uint32_t apart = 4 * grid.half_window + 4;
  // Fractions of the golden ratio and its square spread any box of cells evenly.
  auto y = static_cast<std::uint32_t>(buckets * 0.6180339887498949) | 1U;
  auto z = static_cast<std::uint32_t>(buckets * 0.7548776662466927) | 1U;
  const auto clash = [&] {
    const std::uint32_t offsets[9] = {0, y, z, z + y, z - y, 0 - y, 0 - z, 0 - z - y, y - z};
    for (int a = 0; a < 9; ++a) {
      for (int b = a + 1; b < 9; ++b) {
        if (circle_distance(offsets[a], offsets[b], buckets) < apart) return true;
      }
    }
    return false;
  };
  for (; clash(); y += 2) z += 6;
  grid.stride_y = y & (buckets - 1);
  grid.stride_z = z & (buckets - 1);
}

/// Whether the level with the most bodies is folded.
bool most_are_folded(const Plan& plan) noexcept {
  const auto* const end = plan.levels.data() + plan.level_count;
  const auto* const most =
      std::max_element(plan.levels.data(), end,
                       [](const LevelPlan& a, const LevelPlan& b) { return a.bodies < b.bodies; });
  return most != end && most->folded;
}

}  // namespace

bool is_sparse(const Census& census) noexcept {
  double largest = 0;
  for (const RadiusClass& c : census.classes) largest = std::max(largest, c.max_radius);
  const double reach = 2 * largest + census.margin;
  double cells = 1;
  for (int axis = 0; axis < 3; ++axis) cells *= extent(census, axis) / (2 * reach) + 1;
  return !(cells <= 2 * static_cast<double>(census.bodies) + kMinBuckets);
}

Plan make_plan(const Census& census) noexcept {
  Plan plan;
  if (census.bodies == 0) {
    plan.cull_double = census.cull_double;
    plan.map = cull_map(census, plan.cull_double);
    return plan;
  }
  plan.map = cull_map(census, false);
  const Partition in_float(census, plan.map, kMaxCellsDouble);
  in_float.write(plan);
  bool in_double = census.cull_double || beyond_float(census) || giants_need_double(census, plan);
  if (!in_double && needs_double(census, plan)) {
    // Few bodies may be so small: then it is cheaper to keep them in the cells of larger ones.
    const Partition safe(census, plan.map, kSafeCellsFloat);
    in_double = in_float.of_one_class() || !(safe.cost_ns() <= kDoubleCost * in_float.cost_ns());
    if (!in_double) safe.write(plan);
  }
  plan.in_trees =
      census.giants_abound || (census.giants > kMaxGiantsOfFolded && most_are_folded(plan));
  if (in_double) {
    plan.cull_double = true;
    plan.map = cull_map(census, true);
    Partition(census, plan.map, kMaxCellsDouble).write(plan);
  }
  return plan;
}

template <class Cull>
Grid<Cull> make_grid(const LevelPlan& level, const CullMap& map, const Cull min[3],
                     const Cull max[3]) noexcept {
  Grid<Cull> grid;
  // A body looks at most a row further, so from the world it does not see the outermost rows.
  const double row = level.bordered ? 2 * level.sub_cell * (1U << level.row_shift) : 0;
  const double line_end = level.bordered ? 2 * level.cell_x * (level.half_window + 1) : 0;
  const double border[3] = {line_end, row, row};
  Cull top[3];
  for (int k = 0; k < 3; ++k) {
    grid.origin[k] = min[k] - static_cast<Cull>(border[k]);
    top[k] = max[k] + static_cast<Cull>(border[k]);
  }
  grid.cells_per_unit_x = static_cast<Cull>(1 / level.cell_x);
  grid.sub_cells_per_unit = static_cast<Cull>(1 / level.sub_cell);
  grid.max_radius = static_cast<Cull>(level.max_radius * (1 + 0x1p-20));
  // Bodies beyond the world may have larger pads.
  grid.doubtful_below = level.bodies_beyond
                            ? std::numeric_limits<Cull>::infinity()
                            : static_cast<Cull>(doubtful_below(level.max_radius, map.radius_pad));
  grid.short_runs = level.candidates <= kShortRun;
  grid.row_shift = level.row_shift;
  grid.half_window = level.half_window;
  const auto last = [](Cull end, Cull origin, Cull per_unit) {
    return std::trunc((end - origin) * per_unit);
  };
  grid.last_cell_x = last(top[0], grid.origin[0], grid.cells_per_unit_x);
  grid.last_sub_cell_y = last(top[1], grid.origin[1], grid.sub_cells_per_unit);
  grid.last_sub_cell_z = last(top[2], grid.origin[2], grid.sub_cells_per_unit);
  const double bodies = static_cast<double>(level.bodies);
  const double line = static_cast<double>(grid.last_cell_x) + 1 + level.half_window;
  const double rows = 1U << level.row_shift;
  const double plane = line * (std::floor(static_cast<double>(grid.last_sub_cell_y) / rows) + 2);
  const double all = plane * (std::floor(static_cast<double>(grid.last_sub_cell_z) / rows) + 2);
  if (all <= kDenseBuckets * bodies + 2 * kMinBuckets) {
    grid.stride_y = static_cast<std::uint32_t>(line);
    grid.stride_z = static_cast<std::uint32_t>(plane);
    grid.buckets = static_cast<std::uint32_t>(all);
    return grid;
  }
  grid.buckets = power_of_two_at_least(std::max(kFoldedBuckets * bodies, kMinBuckets));
  grid.mask = grid.buckets - 1;
  choose_strides(grid);
  return grid;
}

template Grid<float> make_grid(const LevelPlan&, const CullMap&, const float[3],
                               const float[3]) noexcept;
template Grid<double> make_grid(const LevelPlan&, const CullMap&, const double[3],
                                const double[3]) noexcept;

}  // namespace harpoon::broad
