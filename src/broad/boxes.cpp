#include "broad/boxes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <type_traits>

#include "base/out_of_memory.hpp"

namespace harpoon::broad {
namespace {

/// Boxes much larger than the rest are taken out of the grid when they are no more than this.
constexpr std::size_t kFew = 32;
/// Up to this many boxes none is worth a grid: all pairs, sixteen at a time, are quicker.
constexpr std::size_t kScanAll = 96;
/// Times they are looked for anew, the rest having been measured without them.
constexpr int kFewRounds = 4;
/// More boxes than this many times the square root of all in no grid are too many, because all
/// pairs of them are tested.
constexpr double kScannedOfRoot = 8;
/// More boxes than this beyond the range of float: cull in double.
constexpr std::size_t kMaxBeyondFloat = 16;
/// Boxes whose corners make the middle of the world.
constexpr std::size_t kSamples = 31;
/// Boxes that decide which axes the grid has.
constexpr std::size_t kShapeSamples = 64;
/// A box is long when its longest side is this many times its shortest one.
constexpr double kLong = 8;
/// Unless one in so many of the sampled boxes is long, the grid has all axes.
constexpr std::size_t kLongPart = 4;
/// A grid that ignores an axis more has to save this many times the tests.
constexpr double kWorthAnAxis = 2;
/// Sides of boxes over which partners are looked for along an axis.
constexpr double kSidesSearched = 3;
/// Largest loss of a coordinate in float, as a part of the radius, that culling puts up with.
constexpr double kMaxRelativeLoss = 0.02;
/// Fewest boxes of a piece of work.
constexpr std::size_t kPieceBoxes = 8192;

template <class Real>
bool proper(const Real* box) noexcept {  // false for NaN
  return box[0] <= box[1] && box[2] <= box[3] && box[4] <= box[5];
}

/// Culling coordinates: monotone, so an order between two numbers is never turned around.
template <class Real, class Cull>
struct BoxMap {
  std::array<Real, 3> origin = {0, 0, 0};

  [[nodiscard]] Cull operator()(Real value, std::size_t axis) const noexcept {
    if constexpr (sizeof(Cull) < sizeof(Real)) {
      return static_cast<Cull>(value - origin[axis]);
    } else {
      return static_cast<Cull>(value);
    }
  }
  /// The same for boxes that may be infinite.
  [[nodiscard]] Cull clamped(Real value, std::size_t axis) const noexcept {
    constexpr Cull kMost = std::numeric_limits<Cull>::max();
    return std::clamp((*this)(value, axis), -kMost, kMost);
  }
};

/// The middle of a sample of `count` points, axis by axis, whose coordinates are at(i, axis) or
/// NaN: near it float resolves best, and a few points far away do not draw it to them.
template <class At>
auto middle_of(std::size_t count, const At& at) noexcept {
  using T = decltype(at(0, 0));
  std::array<T, 3> middle = {0, 0, 0};
  const std::size_t step = std::max<std::size_t>(1, count / kSamples);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<T, kSamples> samples;
    auto end = samples.begin();
    for (std::size_t i = 0; i < count && end != samples.end(); i += step) {
      const T value = at(i, axis);
      if (std::abs(value) <= kLimit<T>) *end++ = value;
    }
    if (end == samples.begin()) continue;
    const auto half = samples.begin() + (end - samples.begin()) / 2;
    std::nth_element(samples.begin(), half, end);
    middle[axis] = *half;
  }
  return middle;
}

/// A sample of boxes, by which the axes of the grid are chosen.
template <class Real>
class ShapeSample {
 public:
  explicit ShapeSample(const BoxSource<Real>& source) noexcept {
    const std::size_t step = std::max<std::size_t>(1, source.count / kShapeSamples);
    for (std::size_t i = 0; i < source.count && count_ < kShapeSamples; i += step) {
      if (proper(source[i])) add(source[i]);
    }
  }

  /// Which axes the grid ignores, at most two: those without which boxes have so few others near
  /// them along the rest that it pays.
  [[nodiscard]] std::array<bool, 3> ignored_axes() const noexcept {
    std::array<bool, 3> best = {false, false, false};
    if (kLongPart * long_ < count_ || count_ == 0) return best;
    double least = tests(best);
    for (const unsigned axes : {1U, 2U, 4U, 3U, 5U, 6U}) {
      const std::array<bool, 3> ignored = {(axes & 1) != 0, (axes & 2) != 0, (axes & 4) != 0};
      const double cost = tests(ignored);
      if (kWorthAnAxis * cost < least) {
        least = cost;
        best = ignored;
      }
    }
    return best;
  }

 private:
  void add(const Real* box) noexcept {
    std::array<double, 3>& sides = sides_[count_++];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto low = static_cast<double>(box[2 * axis]);
      // Not a number where both ends are the same infinity.
      const double side = static_cast<double>(box[2 * axis + 1]) - low;
      sides[axis] = side >= 0 ? side : std::numeric_limits<double>::infinity();
      if (!std::isfinite(low)) continue;
      low_[axis] = std::min(low_[axis], low);
      high_[axis] = std::max(high_[axis], low);
    }
    const auto [shortest, longest] = std::minmax_element(sides.begin(), sides.end());
    if (*longest > kLong * *shortest) ++long_;
  }

  /// The part of all boxes that one of them is tested against, on average.
  [[nodiscard]] double tests(const std::array<bool, 3>& ignored) const noexcept {
    double sum = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      double longest = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!ignored[axis]) longest = std::max(longest, sides_[k][axis]);
      }
      double share = 1;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double extent = high_[axis] - low_[axis];
        const double searched = kSidesSearched * longest;
        if (!ignored[axis] && searched < extent) share *= searched / extent;
      }
      sum += share;
    }
    return sum / static_cast<double>(count_);
  }

  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<std::array<double, 3>, kShapeSamples> sides_;
  std::array<double, 3> low_ = {kInfinity, kInfinity, kInfinity};
  std::array<double, 3> high_ = {-kInfinity, -kInfinity, -kInfinity};
  std::size_t count_ = 0;
  std::size_t long_ = 0;
};

/// One ordering under way.
template <class Real, class Cull>
class BoxSorter {
 public:
  BoxSorter(const Means& means, const BoxSource<Real>& source, BoxMemory& memory,
            OrderMemory& order_memory, OrderedBoxes<Real, Cull>& out)
      : means_(means),
        source_(source),
        memory_(memory),
        order_memory_(order_memory),
        out_(out),
        ignored_(ShapeSample<Real>(source).ignored_axes()) {
    if constexpr (sizeof(Cull) < sizeof(Real)) {
      map_.origin = middle_of(source.count, [&](std::size_t i, std::size_t axis) {
        return proper(source[i]) ? source[i][2 * axis] : std::numeric_limits<Real>::quiet_NaN();
      });
    }
  }

  Result<BoxOrder> run(std::vector<std::uint32_t>& excluded) {
    memory_.scanned.clear();
    if (auto error = place_corners()) return *std::move(error);
    if (auto error = take_survey()) return *std::move(error);
    const std::size_t excluded_before = excluded.size();
    for (const std::uint32_t id : memory_.invalid) {
      (proper(source_[id]) ? memory_.scanned : excluded).push_back(id);
      corners()[id].r = -1;
    }
    if (beyond_float()) {
      excluded.resize(excluded_before);
      return BoxOrder::needs_double;
    }
    if (auto error = take_out_few()) return *std::move(error);
    const std::vector<std::uint32_t>& giants = survey_.giants;
    memory_.scanned.insert(memory_.scanned.end(), giants.begin(), giants.end());
    if (static_cast<double>(memory_.scanned.size()) >
        kScanAll + kScannedOfRoot * std::sqrt(static_cast<double>(source_.count))) {
      return BoxOrder::needs_trees;
    }
    Census& census = survey_.census;
    census.giants = memory_.scanned.size();
    census.cull_double = std::is_same_v<Cull, double>;
    census.real_digits = std::numeric_limits<Cull>::digits;
    if (census.bodies == 0 && memory_.scanned.empty()) return BoxOrder::nothing;
    const Plan plan = make_plan(census);
    if (std::is_same_v<Cull, float> && (plan.cull_double || too_coarse(plan))) {
      excluded.resize(excluded_before);
      return BoxOrder::needs_double;
    }
    return plan.in_trees ? BoxOrder::needs_trees : sort(plan);
  }

 private:
  [[nodiscard]] SphereOf<Cull>* corners() const noexcept {
    return memory_.corners.as<SphereOf<Cull>>();
  }

  [[nodiscard]] Source<Cull> corner_source() const noexcept {
    const SphereOf<Cull>* const c = corners();
    return {&c->x, &c->y, &c->z, &c->r, sizeof *c, source_.count};
  }

  std::optional<Error> place_corners() {
    if (!memory_.corners.reserve((source_.count + kSlack) * sizeof(SphereOf<Cull>))) {
      return out_of_memory();
    }
    SphereOf<Cull>* const to = corners();
    return means_.run_pieces(source_.count, kPieceBoxes,
                             [&](std::size_t, std::size_t begin, std::size_t end) {
                               for (std::size_t i = begin; i < end; ++i) {
                                 to[i] = corner_of(source_[i]);
                               }
                             });
  }

  /// Infinite and NaN extents, and a NaN that max does not see, make it invalid.
  [[nodiscard]] SphereOf<Cull> corner_of(const Real* box) const noexcept {
    const auto place = [&](std::size_t axis) {
      return ignored_[axis] ? Cull(0) : map_(box[2 * axis], axis);
    };
    const Cull x = place(0);
    const Cull y = place(1);
    const Cull z = place(2);
    const auto side = [&](std::size_t axis, Cull low) {
      return ignored_[axis] ? Cull(0) : map_(box[2 * axis + 1], axis) - low;
    };
    const Cull longest = std::max({side(0, x), side(1, y), side(2, z)});
    return {x, y, z, proper(box) ? longest / 2 : Cull(-1)};
  }

  std::optional<Error> take_survey() {
    memory_.invalid.clear();
    survey_ = {};
    return survey(means_, corner_source(), 0, memory_.invalid, survey_);
  }

  [[nodiscard]] bool beyond_float() const noexcept {
    return sizeof(Cull) < sizeof(Real) && memory_.scanned.size() > kMaxBeyondFloat &&
           std::count_if(memory_.scanned.begin(), memory_.scanned.end(), [&](std::uint32_t id) {
             return std::all_of(source_[id], source_[id] + 6,
                                [](Real v) { return std::isfinite(v); });
           }) > static_cast<std::ptrdiff_t>(kMaxBeyondFloat);
  }

  /// Takes boxes out of the grid while a few of them make it much coarser or wider for the rest.
  std::optional<Error> take_out_few() {
    for (int round = 0; round < kFewRounds; ++round) {
      const std::size_t before = memory_.scanned.size();
      const double largest = largest_of_many();
      scan_if([&](const SphereOf<Cull>& c) { return static_cast<double>(c.r) > largest; });
      if (memory_.scanned.size() == before) return std::nullopt;
      if (auto error = take_survey()) return error;
    }
    return std::nullopt;
  }

  /// The largest radius when the few boxes of the top size classes are left out; negative when no
  /// box is to be in a grid.
  [[nodiscard]] double largest_of_many() const noexcept {
    if (survey_.census.bodies <= kScanAll) return -1;
    std::size_t few = 0;
    for (const RadiusClass& size : survey_.census.classes) {
      few += size.bodies;
      if (few > kFew) return size.max_radius;
    }
    return -1;
  }

  template <class Rule>
  void scan_if(const Rule& rule) {
    for (std::uint32_t id = 0; id < source_.count; ++id) {
      SphereOf<Cull>& corner = corners()[id];
      if (corner.r < 0 || !rule(corner)) continue;
      memory_.scanned.push_back(id);
      corner.r = -1;
    }
  }

  /// Whether float loses too much of the coordinates of some level.
  [[nodiscard]] bool too_coarse(const Plan& plan) const noexcept {
    if (sizeof(Cull) == sizeof(Real)) return false;
    double magnitude = 0;
    for (int axis = 0; axis < 3; ++axis) {
      magnitude = std::max(
          {magnitude, std::abs(survey_.census.min[axis]), std::abs(survey_.census.max[axis])});
    }
    if (magnitude < 0x1p-30) return survey_.census.bodies != 0;
    for (std::size_t l = 0; l < plan.level_count; ++l) {
      if (magnitude * 0x1p-22 > kMaxRelativeLoss * plan.levels[l].max_radius) return true;
    }
    return false;
  }

  Result<BoxOrder> sort(const Plan& plan) {
    Ordered<Cull, Cull>& bodies = out_.bodies;
    std::sort(memory_.scanned.begin(), memory_.scanned.end());
    bodies.scanned = memory_.scanned.size();
    const Source<Cull> source = corner_source();
    if (auto error = order(means_, source, survey_, plan, order_memory_, bodies)) {
      return *std::move(error);
    }
    if (auto error = place_corners_in_order()) return *std::move(error);
    return BoxOrder::done;
  }

  /// Corners of all boxes by sorted position, and the places of scanned ones.
  std::optional<Error> place_corners_in_order() {
    Ordered<Cull, Cull>& bodies = out_.bodies;
    const std::size_t all = bodies.bodies + bodies.scanned;
    const std::size_t with_slack = all + kSlack;
    if (!memory_.high.reserve(3 * with_slack * sizeof(Cull))) return out_of_memory();
    const bool full_grid = std::none_of(ignored_.begin(), ignored_.end(), std::identity());
    if (!memory_.low.reserve(full_grid ? 0 : 3 * with_slack * sizeof(Cull))) return out_of_memory();
    out_.touching_unsure = out_.touching_unsure || !full_grid;
    std::copy(memory_.scanned.begin(), memory_.scanned.end(), bodies.ids + bodies.bodies);
    std::array<Cull*, 3> low = {bodies.cull.x, bodies.cull.y, bodies.cull.z};
    std::array<Cull*, 3> high;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::fill(low[axis] + bodies.bodies, low[axis] + with_slack, Cull(0));
      if (ignored_[axis]) low[axis] = memory_.low.as<Cull>() + axis * with_slack;
      high[axis] = memory_.high.as<Cull>() + axis * with_slack;
      std::fill(low[axis] + all, low[axis] + with_slack, Cull(0));
      std::fill(high[axis] + all, high[axis] + with_slack, Cull(0));
    }
    CullArrays<Cull>& cull = bodies.cull;
    cull = {cull.x, cull.y, cull.z, cull.r, low[0], low[1], low[2], high[0], high[1], high[2]};
    const auto place = [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p) {
        const Real* const box = source_[bodies.ids[p]];
        high[0][p] = map_.clamped(box[1], 0);
        high[1][p] = map_.clamped(box[3], 1);
        high[2][p] = map_.clamped(box[5], 2);
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {  // others lie at their lowest corners
        for (std::size_t p = ignored_[axis] ? begin : std::max(begin, bodies.bodies); p < end;
             ++p) {
          low[axis][p] = map_.clamped(source_[bodies.ids[p]][2 * axis], axis);
        }
      }
    };
    return means_.run_pieces(all, kPieceBoxes, place);
  }

  const Means& means_;
  const BoxSource<Real>& source_;
  BoxMemory& memory_;
  OrderMemory& order_memory_;
  OrderedBoxes<Real, Cull>& out_;
  std::array<bool, 3> ignored_;  ///< axes without a part in the grid
  BoxMap<Real, Cull> map_;
  Survey<Cull> survey_;
};

/// A box as the curve meets it; where it is infinite, it sits in the middle of what is finite.
template <class Real>
TreeItem<Real> item_of(const Real* box, std::uint32_t id) noexcept {
  constexpr Real kMost = std::numeric_limits<Real>::max() / 4;
  TreeItem<Real> item;
  item.id = id;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Real low = std::clamp(box[2 * axis], -kMost, kMost);
    const Real high = std::clamp(box[2 * axis + 1], -kMost, kMost);
    item.at[axis] = low / 2 + high / 2;
    // Both ends may be the same infinity.
    const double side = static_cast<double>(box[2 * axis + 1]) - static_cast<double>(box[2 * axis]);
    item.side[axis] = side_exponent(side >= 0 ? side : std::numeric_limits<double>::infinity());
  }
  return item;
}

/// Whether two closed boxes overlap, in the caller's own numbers.
template <class Real, class Cull>
bool overlap(const BoxJudge& self, std::uint32_t i, std::uint32_t j) {
  const auto& boxes = static_cast<const OrderedBoxes<Real, Cull>&>(self);
  const Real* const a = boxes.source[boxes.bodies.ids[i]];
  const Real* const b = boxes.source[boxes.bodies.ids[j]];
  return a[0] <= b[1] && b[0] <= a[1] && a[2] <= b[3] && b[2] <= a[3] && a[4] <= b[5] &&
         b[4] <= a[5];
}

}  // namespace

template <class Real, class Cull>
Result<BoxOrder> order_boxes(const Means& means, const BoxSource<Real>& source, BoxMemory& memory,
                             OrderMemory& order_memory, std::vector<std::uint32_t>& excluded,
                             OrderedBoxes<Real, Cull>& out) {
  out.source = source;
  out.BoxJudge::overlap = overlap<Real, Cull>;
  return BoxSorter<Real, Cull>(means, source, memory, order_memory, out).run(excluded);
}

template <class Real>
std::optional<Error> order_boxes_in_trees(const Means& means, const BoxSource<Real>& source,
                                          BoxMemory& memory, OrderMemory& order_memory,
                                          TreeMemory& tree_memory, OrderedBoxes<Real, Real>& out) {
  out.source = source;
  out.BoxJudge::overlap = overlap<Real, Real>;
  out.touching_unsure = true;  // infinite corners are made finite
  TreeItem<Real>* const items = reserve_items<Real>(tree_memory, source.count);
  if (items == nullptr) return out_of_memory();
  std::size_t count = 0;
  for (std::size_t i = 0; i < source.count; ++i) {
    if (proper(source[i])) items[count++] = item_of(source[i], static_cast<std::uint32_t>(i));
  }
  if (auto error = grow_trees(std::span(items, count), tree_memory, out.bodies)) {
    return error;
  }
  const std::size_t with_slack = count + kSlack;
  if (!reserve_sorted(order_memory, count, out.bodies) ||
      !memory.high.reserve(3 * with_slack * sizeof(Real))) {
    return out_of_memory();
  }
  CullArrays<Real>& cull = out.bodies.cull;
  Real* const high = memory.high.as<Real>();
  Real* const low[3] = {cull.x, cull.y, cull.z};
  cull.low_x = cull.x;
  cull.low_y = cull.y;
  cull.low_z = cull.z;
  cull.high_x = high;
  cull.high_y = high + with_slack;
  cull.high_z = high + 2 * with_slack;
  const BoxMap<Real, Real> map;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::fill(high + axis * with_slack + count, high + (axis + 1) * with_slack, Real(0));
  }
  if (auto error = means.run_pieces(
          count, kPieceBoxes, [&](std::size_t, std::size_t begin, std::size_t end) {
            for (std::size_t p = begin; p < end; ++p) {
              const Real* const box = source[items[p].id];
              out.bodies.ids[p] = items[p].id;
              for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis][p] = map.clamped(box[2 * axis], axis);
                high[axis * with_slack + p] = map.clamped(box[2 * axis + 1], axis);
              }
            }
          })) {
    return error;
  }
  const auto& kernels = means.kernels->of<Real>().template cull<Real>();
  return means.run(out.bodies.tree_count,
                   [&](std::size_t t) { kernels.tree_of_boxes(cull, out.bodies.trees[t]); });
}

template std::optional<Error> order_boxes_in_trees(const Means&, const BoxSource<float>&,
                                                   BoxMemory&, OrderMemory&, TreeMemory&,
                                                   OrderedBoxes<float, float>&);
template std::optional<Error> order_boxes_in_trees(const Means&, const BoxSource<double>&,
                                                   BoxMemory&, OrderMemory&, TreeMemory&,
                                                   OrderedBoxes<double, double>&);
template Result<BoxOrder> order_boxes(const Means&, const BoxSource<float>&, BoxMemory&,
                                      OrderMemory&, std::vector<std::uint32_t>&,
                                      OrderedBoxes<float, float>&);
template Result<BoxOrder> order_boxes(const Means&, const BoxSource<float>&, BoxMemory&,
                                      OrderMemory&, std::vector<std::uint32_t>&,
                                      OrderedBoxes<float, double>&);
template Result<BoxOrder> order_boxes(const Means&, const BoxSource<double>&, BoxMemory&,
                                      OrderMemory&, std::vector<std::uint32_t>&,
                                      OrderedBoxes<double, float>&);
template Result<BoxOrder> order_boxes(const Means&, const BoxSource<double>&, BoxMemory&,
                                      OrderMemory&, std::vector<std::uint32_t>&,
                                      OrderedBoxes<double, double>&);

}  // namespace harpoon::broad
