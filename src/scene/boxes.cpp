#include "scene/boxes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

namespace harpoon::scene {
namespace {

/// Boxes much larger than the rest or far away from it are taken out of the grid when they are no
/// more than this: each costs a pass over all others.
constexpr std::size_t kFew = 32;
/// Up to this many boxes none is worth a grid: all pairs, sixteen at a time, are quicker.
constexpr std::size_t kScanAll = 96;
/// Times they are looked for anew, the rest having been measured without them.
constexpr int kFewRounds = 4;
/// A radius for boxes that are points.
constexpr double kSmallest = 0x1p-60;
/// Far away, in radii of the largest box: there a cell number has no room left.
template <class Cull>
constexpr double kFarRadii = sizeof(Cull) == sizeof(float) ? 0x1p12 : 0x1p27;
/// More boxes than this beyond the range of float: cull in double.
constexpr std::size_t kMaxBeyondFloat = 16;
/// Boxes whose corners make the middle of the world.
constexpr std::size_t kSamples = 31;
/// Largest loss of a coordinate in float, as a part of the radius, that culling puts up with.
constexpr double kMaxRelativeLoss = 0.02;
/// Below this many boxes a pass is not shared between threads.
constexpr std::size_t kTaskBoxes = 16384;

Error out_of_memory() {
  return {Errc::out_of_memory, "out of memory"};
}

template <class Real>
bool proper(const Real* box) noexcept {  // false for NaN
  return box[0] <= box[1] && box[2] <= box[3] && box[4] <= box[5];
}

/// Culling coordinates: monotone, so an order between two numbers is never turned around.
template <class Real, class Cull>
struct BoxMap {
  std::array<Real, 3> origin = {0, 0, 0};

  [[nodiscard]] Cull operator()(Real value, int axis) const noexcept {
    if constexpr (sizeof(Cull) < sizeof(Real)) {
      return static_cast<Cull>(value - origin[static_cast<std::size_t>(axis)]);
    } else {
      return static_cast<Cull>(value);
    }
  }
  /// The same for boxes that may be infinite.
  [[nodiscard]] Cull clamped(Real value, int axis) const noexcept {
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

/// One ordering under way.
template <class Real, class Cull>
class BoxSorter {
 public:
  BoxSorter(const Means& means, const BoxSource<Real>& source, BoxMemory& memory,
            OrderMemory& order_memory, OrderedBoxes<Real, Cull>& out)
      : means_(means), source_(source), memory_(memory), order_memory_(order_memory), out_(out) {
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
    Census& census = survey_.census;
    census.cull_double = std::is_same_v<Cull, double>;
    census.real_digits = std::numeric_limits<Cull>::digits;
    if (census.bodies == 0 && memory_.scanned.empty()) return BoxOrder::nothing;
    const Plan plan = make_plan(census);
    if (std::is_same_v<Cull, float> && (plan.cull_double || too_coarse(plan))) {
      excluded.resize(excluded_before);
      return BoxOrder::needs_double;
    }
    return sort(plan);
  }

 private:
  [[nodiscard]] SphereOf<Cull>* corners() const noexcept {
    return memory_.corners.as<SphereOf<Cull>>();
  }

  [[nodiscard]] Source<Cull> corner_source() const noexcept {
    const SphereOf<Cull>* const c = corners();
    return {&c->x, &c->y, &c->z, &c->r, sizeof *c, source_.count};
  }

  /// Runs body(begin, end) over [0, count).
  template <class Body>
  std::optional<Error> in_tasks(std::size_t count, const Body& body) const {
    const std::size_t tasks =
        means_.threads() == 1 ? 1 : std::min<std::size_t>(64, count / kTaskBoxes + 1);
    return means_.run(tasks,
                      [&](std::size_t t) { body(count * t / tasks, count * (t + 1) / tasks); });
  }

  std::optional<Error> place_corners() {
    if (!memory_.corners.reserve((source_.count + kSlack) * sizeof(SphereOf<Cull>))) {
      return out_of_memory();
    }
    SphereOf<Cull>* const to = corners();
    return in_tasks(source_.count, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Real* const box = source_[i];
        const Cull x = map_(box[0], 0);
        const Cull y = map_(box[2], 1);
        const Cull z = map_(box[4], 2);
        const Cull longest =
            std::max({map_(box[1], 0) - x, map_(box[3], 1) - y, map_(box[5], 2) - z});
        // Infinite and NaN extents, and a NaN that max does not see, make the sphere invalid.
        to[i] = {x, y, z, proper(box) ? longest / 2 : Cull(-1)};
      }
    });
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
      if (largest >= 0) scan_far(std::max(largest, kSmallest) * kFarRadii<Cull>);
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

  /// Boxes further than that from the middle of the world, unless they are many.
  void scan_far(double distance) {
    const Census& census = survey_.census;
    double extent = 0;
    for (int axis = 0; axis < 3; ++axis) {
      extent = std::max(extent, census.max[axis] - census.min[axis]);
    }
    if (extent <= distance) return;
    const SphereOf<Cull>* const c = corners();
    const auto middle = middle_of(source_.count, [&](std::size_t i, std::size_t axis) {
      const Cull at[3] = {c[i].x, c[i].y, c[i].z};
      return c[i].r >= 0 ? at[axis] : std::numeric_limits<Cull>::quiet_NaN();
    });
    const auto far = [&](const SphereOf<Cull>& s) {
      const auto beyond = [&](Cull v, std::size_t axis) {
        return std::abs(static_cast<double>(v) - static_cast<double>(middle[axis])) > distance;
      };
      return beyond(s.x, 0) || beyond(s.y, 1) || beyond(s.z, 2);
    };
    const auto is_far = [&](const SphereOf<Cull>& s) { return s.r >= 0 && far(s); };
    const auto count = std::count_if(c, c + source_.count, is_far);
    if (count <= static_cast<std::ptrdiff_t>(kFew)) scan_if(far);
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
    const std::size_t all = bodies.bodies + bodies.scanned;
    const std::size_t with_slack = all + kSlack;
    if (!memory_.high.reserve(3 * with_slack * sizeof(Cull))) return out_of_memory();
    auto* const high = memory_.high.as<Cull>();
    bodies.cull.high_x = high;
    bodies.cull.high_y = high + with_slack;
    bodies.cull.high_z = high + 2 * with_slack;
    for (std::size_t p = bodies.bodies; p < all; ++p) {
      const std::uint32_t id = memory_.scanned[p - bodies.bodies];
      bodies.ids[p] = id;
      bodies.cull.x[p] = map_.clamped(source_[id][0], 0);
      bodies.cull.y[p] = map_.clamped(source_[id][2], 1);
      bodies.cull.z[p] = map_.clamped(source_[id][4], 2);
    }
    for (Cull* array : {bodies.cull.high_x, bodies.cull.high_y, bodies.cull.high_z}) {
      std::fill(array + all, array + with_slack, Cull(0));
    }
    if (auto error = in_tasks(all, [&](std::size_t begin, std::size_t end) {
          for (std::size_t p = begin; p < end; ++p) {
            const Real* const box = source_[bodies.ids[p]];
            bodies.cull.high_x[p] = map_.clamped(box[1], 0);
            bodies.cull.high_y[p] = map_.clamped(box[3], 1);
            bodies.cull.high_z[p] = map_.clamped(box[5], 2);
          }
        })) {
      return *std::move(error);
    }
    return BoxOrder::done;
  }

  const Means& means_;
  const BoxSource<Real>& source_;
  BoxMemory& memory_;
  OrderMemory& order_memory_;
  OrderedBoxes<Real, Cull>& out_;
  BoxMap<Real, Cull> map_;
  Survey<Cull> survey_;
};

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

}  // namespace harpoon::scene
