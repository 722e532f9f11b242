#include "ode/mirror.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace harpoon::ode {
namespace {

/// How many geoms ahead memory is asked for.
constexpr std::size_t kPrefetchDistance = 12;
/// Of libode's geom objects: what the enumeration and the queries below touch.
constexpr std::size_t kGeomLines = 3;

template <class Real>
std::uint8_t traits_of(const BoundsBox<Real>& box) {
  // Mostly all is well, which no NaN compares as.
  if (box.v[0] <= box.v[1] && box.v[2] <= box.v[3] && box.v[4] <= box.v[5]) return 0;
  std::uint8_t traits = 0;
  for (int low = 0; low < 6; low += 2) {
    if (std::isnan(box.v[low]) || std::isnan(box.v[low + 1])) traits |= kIsNan;
    if (box.v[low] > box.v[low + 1]) traits |= kIsInverted;
  }
  return traits;
}

/// A set of a few geoms, asked about many: mostly one bit answers.
class KnownGeoms {
 public:
  /// `geoms` are ascending and outlive this.
  explicit KnownGeoms(std::span<dxGeom* const> geoms) : geoms_(geoms) {
    for (const dxGeom* geom : geoms) bits_[place(geom)] = true;
  }
  [[nodiscard]] bool has(dxGeom* geom) const {
    return bits_[place(geom)] && std::binary_search(geoms_.begin(), geoms_.end(), geom);
  }

 private:
  static constexpr std::size_t kPlaces = 4096;
  static std::size_t place(const dxGeom* geom) {
    const auto bits = reinterpret_cast<std::uintptr_t>(geom);
    return (bits >> 4 ^ bits >> 11) % kPlaces;
  }
  std::span<dxGeom* const> geoms_;
  bool bits_[kPlaces] = {};
};

}  // namespace

template <class Real>
void Mirror<Real>::drop_filters() {
  bodies.assign(size(), nullptr);
  category.assign(size(), ~0UL);
  collide.assign(size(), ~0UL);
  uniform_bits = true;
}

template <class Real>
void Mirror<Real>::clear() {
  geoms.clear();
  bounds.clear();
  spheres.clear();
  bodies.clear();
  category.clear();
  collide.clear();
  traits.clear();
  positions_.clear();
  is_packed_ = was_asked_ = false;
  all_traits = 0;
  only_spheres = false;
}

template <class Real>
struct Mirror<Real>::Slots {
  dxGeom** geoms;
  BoundsBox<Real>* bounds;
  SphereOf<Real>* spheres;
  const dxBody** bodies;
  unsigned long *category, *collide;
  std::uint8_t* traits;
  const Real** positions;
};

template <class Real>
typename Mirror<Real>::Slots Mirror<Real>::slots() {
  return {geoms.data(),    bounds.data(),  spheres.data(), bodies.data(),
          category.data(), collide.data(), traits.data(),  positions_.data()};
}

namespace {

/// False when a number is NaN or infinite: there would be NaNs, whose bits no two colliders agree
/// on.
template <class Real>
bool read_sphere(const GeomReader<Real>& reader, dxGeom* geom, const Real* position,
                 SphereOf<Real>& sphere) {
  const SphereOf<Real> s{position[0], position[1], position[2], reader.radius_of(geom)};
  sphere = s;
  // What is not finite gives NaN, less itself.
  return (s.x - s.x) + (s.y - s.y) + (s.z - s.z) + (s.r - s.r) == 0;
}

}  // namespace

template <class Real>
void Mirror<Real>::append_for_contacts(const GeomReader<Real>& reader, dxGeom* geom) {
  const std::uint32_t slot = size();
  resize(std::size_t{slot} + 1);
  geoms[slot] = geom;
  spheres[slot] = {};
  positions_[slot] = reinterpret_cast<const Real*>(geom);
  const int number = reader.class_of(geom);
  traits[slot] = reader.asks(number) ? kHasAabbTest : 0;
  if (number == geom_class::kSphere) {
    positions_[slot] = reader.position_of(geom);
    if (read_sphere(reader, geom, positions_[slot], spheres[slot])) traits[slot] |= kIsSphere;
  }
  all_traits |= traits[slot];
}

template <class Real>
void Mirror<Real>::resize(std::size_t count) {
  geoms.resize(count);
  bounds.resize(count);
  spheres.resize(count);
  bodies.resize(count);
  category.resize(count);
  collide.resize(count);
  traits.resize(count);
  positions_.resize(count);
}

template <class Real>
inline std::uint8_t Mirror<Real>::read_geom(const GeomReader<Real>& reader, dxGeom* geom,
                                            int number, const Slots& slots, std::size_t slot) {
  slots.geoms[slot] = geom;
  reader.read_bounds(geom, slots.bounds[slot]);
  std::uint8_t bits = traits_of(slots.bounds[slot]);
  if (number == geom_class::kSphere) {
    const Real* const position = reader.position_of(geom);
    slots.positions[slot] = position;
    if (read_sphere(reader, geom, position, slots.spheres[slot])) bits |= kIsSphere;
  } else {
    const bool has_pose = number != geom_class::kPlane && !is_space_class(number);
    slots.positions[slot] =
        has_pose ? reader.position_of(geom) : reinterpret_cast<const Real*>(geom);
    slots.spheres[slot] = {};
  }
  if (reader.asks(number)) bits |= kHasAabbTest;
  slots.bodies[slot] = reader.body_of(geom);
  slots.category[slot] = reader.category_of(geom);
  slots.collide[slot] = reader.collide_of(geom);
  slots.traits[slot] = bits;
  return bits;
}

template <class Real>
void Mirror<Real>::read(const GeomReader<Real>& reader, dxSpace* space, int count) {
  reader.ode.space_clean(space);
  resize(static_cast<std::size_t>(count));
  is_packed_ = was_asked_ = false;
  std::uint32_t filled = 0;
  std::uint8_t any_traits = 0, common_traits = 0xFF;
  bool is_stale = false;
  unsigned long all_category = ~0UL, all_collide = ~0UL;
  const Slots to = slots();
  const auto size_before = static_cast<std::size_t>(count);
  for (int index = 0; index < count; ++index) {
    // The geoms of the last frame in its order are a good guess at those to come.
    if (const std::size_t ahead = static_cast<std::size_t>(index) + kPrefetchDistance;
        ahead < size_before && to.geoms[ahead] != nullptr) {
      const auto* bytes = reinterpret_cast<const char*>(to.geoms[ahead]);
      for (std::size_t line = 0; line < kGeomLines; ++line) {
        __builtin_prefetch(bytes + line * kCacheLineBytes);
      }
      __builtin_prefetch(to.positions[ahead]);
    }
    dxGeom* const geom = reader.ode.space_get_geom(space, index);
    const int number = reader.class_of(geom);
    if (!reader.takes_part(geom, number)) continue;
    is_stale |= reader.is_stale(geom);
    const std::uint8_t bits = read_geom(reader, geom, number, to, filled);
    any_traits |= bits;
    common_traits &= bits;
    all_category &= to.category[filled];
    all_collide &= to.collide[filled];
    ++filled;
  }
  resize(filled);
  all_traits = any_traits;
  only_spheres = (common_traits & kIsSphere) != 0;
  has_stale = is_stale;
  uniform_bits = (all_category & all_collide) != 0;
}

/// Slots of geoms among `moved`. Ends when all are found, which is soon in a list whose first geoms
/// move again and again.
template <class Real>
void Mirror<Real>::find_vacated(std::span<dxGeom* const> moved, SlotChange& change) const {
  const KnownGeoms known(moved);
  change.vacated.clear();
  for (std::uint32_t slot = 0; slot < size() && change.vacated.size() < moved.size(); ++slot) {
    if (known.has(geoms[slot])) change.vacated.push_back(slot);
  }
}

/// Fills the fresh slots from `arrived_`. False when these are not the geoms that left.
template <class Real>
bool Mirror<Real>::read_fresh(const GeomReader<Real>& reader, const SlotChange& change) {
  const Slots to = slots();
  for (std::size_t k = 0; k < arrived_.size(); ++k) {
    dxGeom* const geom = arrived_[k];
    note_traits(read_geom(reader, geom, reader.class_of(geom), to, change.fresh[k]));
  }
  std::sort(arrived_.begin(), arrived_.end());
  std::sort(left_.begin(), left_.end());
  return arrived_ == left_;
}

template <class Real>
bool Mirror<Real>::update_list(const GeomReader<Real>& reader, dxSpace* space,
                               std::span<dxGeom* const> moved, SlotChange& change) {
  if ((all_traits & (kIsNan | kIsInverted)) != 0) return false;
  reader.ode.space_clean(space);
  arrived_.clear();
  for (std::size_t k = 0; k < moved.size(); ++k) {
    dxGeom* const geom = reader.ode.space_get_geom(space, static_cast<int>(k));
    if (!std::binary_search(moved.begin(), moved.end(), geom)) return false;
    if (reader.takes_part(geom, reader.class_of(geom))) arrived_.push_back(geom);
  }
  find_vacated(moved, change);
  if (change.vacated.size() != arrived_.size()) return false;
  left_.clear();
  for (const std::uint32_t slot : change.vacated) left_.push_back(geoms[slot]);
  change.bring_to_front();
  change.apply_to(geoms);
  change.apply_to(bounds);
  change.apply_to(spheres);
  change.apply_to(bodies);
  change.apply_to(category);
  change.apply_to(collide);
  change.apply_to(traits);
  change.apply_to(positions_);
  const bool complete = read_fresh(reader, change);
  if (is_packed_) packed_.repack(bounds, 0, change.new_slots.size());
  return complete;
}

template <class Real>
bool Mirror<Real>::update_array(const GeomReader<Real>& reader, dxSpace* space,
                                std::span<dxGeom* const> moved, SlotChange& change) {
  const auto count = static_cast<std::uint32_t>(reader.ode.space_get_num_geoms(space));
  if (size() != count || (all_traits & (kIsNan | kIsInverted)) != 0) return false;
  reader.ode.space_clean(space);
  find_vacated(moved, change);
  if (change.vacated.size() != moved.size()) return false;
  // Whatever is written to libode's array is written to a place that one of these had, or to its
  // end: a geom's place is written over only when it moves, and it has been in no other places.
  for (std::uint32_t k = 1; k <= moved.size(); ++k) change.vacated.push_back(count - k);
  std::sort(change.vacated.begin(), change.vacated.end());
  change.vacated.erase(std::unique(change.vacated.begin(), change.vacated.end()),
                       change.vacated.end());
  change.keep_in_place();
  arrived_.clear();
  left_.clear();
  for (const std::uint32_t slot : change.fresh) {
    dxGeom* const geom = reader.ode.space_get_geom(space, static_cast<int>(slot));
    if (!reader.takes_part(geom, reader.class_of(geom))) return false;
    arrived_.push_back(geom);
    left_.push_back(geoms[slot]);
  }
  const bool complete = read_fresh(reader, change);
  if (is_packed_) {
    for (const std::uint32_t slot : change.fresh) {
      packed_.repack(bounds, slot, std::size_t{slot} + 1);
    }
  }
  return complete;
}

template <class Real>
const PackedBounds<Real>& Mirror<Real>::packed() {
  if (!is_packed_) packed_.pack(bounds);
  is_packed_ = true;
  return packed_;
}

template <class Real>
const PackedBounds<Real>* Mirror<Real>::packed_if_asked_again() {
  if (is_packed_ || std::exchange(was_asked_, true)) return &packed();
  return nullptr;
}

template class Mirror<float>;
template class Mirror<double>;

}  // namespace harpoon::ode
