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

/// libode excludes geoms of size zero from its spaces; nobody may ask it for that flag.
template <class Real>
bool is_zero_sized(const LibodeOf<Real>& ode, dxGeom* geom, int number) {
  Real size[4] = {};
  switch (number) {
    case geom_class::kSphere:
      return ode.sphere_get_radius(geom) == 0;
    case geom_class::kBox:
      ode.box_get_lengths(geom, size);
      return size[0] == 0 || size[1] == 0 || size[2] == 0;
    case geom_class::kCapsule:
      ode.capsule_get_params(geom, &size[0], &size[1]);
      return size[0] == 0;
    case geom_class::kCylinder:
      ode.cylinder_get_params(geom, &size[0], &size[1]);
      return size[0] == 0 || size[1] == 0;
    default:
      return false;
  }
}

template <class Real>
std::uint8_t traits_of(const BoundsBox<Real>& box) {
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

/// Whether the class is one of the user's that asks about each pair.
bool asks(int number, const UserTests& tests) {
  return number >= geom_class::kFirstUser && tests[number - geom_class::kFirstUser] != nullptr;
}

}  // namespace

template <class Real>
bool takes_part(const LibodeOf<Real>& ode, dxGeom* geom) {
  return ode.geom_is_enabled(geom) != 0 && !is_zero_sized(ode, geom, ode.geom_get_class(geom));
}

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

/// With infinities there would be NaNs, whose bits no two colliders agree on.
template <class Real>
bool Mirror<Real>::read_sphere(const LibodeOf<Real>& ode, dxGeom* geom, std::uint32_t slot) {
  const Real* position = ode.geom_get_position(geom);
  positions_[slot] = position;
  const SphereOf<Real> s{position[0], position[1], position[2], ode.sphere_get_radius(geom)};
  spheres[slot] = s;
  return std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z) && std::isfinite(s.r);
}

template <class Real>
void Mirror<Real>::append_for_contacts(const LibodeOf<Real>& ode, dxGeom* geom,
                                       const UserTests& tests) {
  const std::uint32_t slot = size();
  resize(std::size_t{slot} + 1);
  geoms[slot] = geom;
  spheres[slot] = {};
  positions_[slot] = reinterpret_cast<const Real*>(geom);
  const int number = ode.geom_get_class(geom);
  traits[slot] = asks(number, tests) ? kHasAabbTest : 0;
  if (number == geom_class::kSphere && read_sphere(ode, geom, slot)) traits[slot] |= kIsSphere;
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
void Mirror<Real>::read_geom(const LibodeOf<Real>& ode, dxGeom* geom, int number,
                             const UserTests& tests, std::uint32_t slot) {
  geoms[slot] = geom;
  ode.geom_get_aabb(geom, bounds[slot].v);
  std::uint8_t bits = traits_of(bounds[slot]);
  spheres[slot] = {};
  positions_[slot] = reinterpret_cast<const Real*>(geom);
  if (number == geom_class::kSphere) {
    if (read_sphere(ode, geom, slot)) bits |= kIsSphere;
  } else if (number != geom_class::kPlane && !is_space_class(number)) {
    positions_[slot] = ode.geom_get_position(geom);
  }
  if (asks(number, tests)) bits |= kHasAabbTest;
  bodies[slot] = ode.geom_get_body(geom);
  category[slot] = ode.geom_get_category_bits(geom);
  collide[slot] = ode.geom_get_collide_bits(geom);
  traits[slot] = bits;
  all_traits |= bits;
  only_spheres = only_spheres && (bits & kIsSphere) != 0;
}

template <class Real>
void Mirror<Real>::read_all(const LibodeOf<Real>& ode, dxSpace* space, int count,
                            const UserTests& tests) {
  resize(static_cast<std::size_t>(count));
  is_packed_ = was_asked_ = false;
  std::uint32_t filled = 0;
  all_traits = 0;
  only_spheres = true;
  unsigned long all_category = ~0UL, all_collide = ~0UL;
  for (int index = 0; index < count; ++index) {
    // The geoms of the last frame in its order are a good guess at those to come.
    if (const std::size_t ahead = static_cast<std::size_t>(index) + kPrefetchDistance;
        ahead < geoms.size() && geoms[ahead] != nullptr) {
      const auto* bytes = reinterpret_cast<const char*>(geoms[ahead]);
      for (std::size_t line = 0; line < kGeomLines; ++line) {
        __builtin_prefetch(bytes + line * kCacheLineBytes);
      }
      __builtin_prefetch(positions_[ahead]);
    }
    dxGeom* const geom = ode.space_get_geom(space, index);
    if (ode.geom_is_enabled(geom) == 0) continue;
    const int number = ode.geom_get_class(geom);
    if (is_zero_sized(ode, geom, number)) continue;
    read_geom(ode, geom, number, tests, filled);
    all_category &= category[filled];
    all_collide &= collide[filled];
    ++filled;
  }
  resize(filled);
  uniform_bits = (all_category & all_collide) != 0;
}

template <class Real>
void Mirror<Real>::read(const LibodeOf<Real>& ode, dxSpace* space, int count,
                        const UserTests& tests) {
  read_all(ode, space, count, tests);
  ode.space_clean(space);
}

template <class Real>
void Mirror<Real>::clean_and_read(const LibodeOf<Real>& ode, dxSpace* space, int count,
                                  const UserTests& tests) {
  ode.space_clean(space);
  read_all(ode, space, count, tests);
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
bool Mirror<Real>::read_fresh(const LibodeOf<Real>& ode, const UserTests& tests,
                              const SlotChange& change) {
  for (std::size_t k = 0; k < arrived_.size(); ++k) {
    dxGeom* const geom = arrived_[k];
    const int number = ode.geom_get_class(geom);
    read_geom(ode, geom, number, tests, change.fresh[k]);
  }
  std::sort(arrived_.begin(), arrived_.end());
  std::sort(left_.begin(), left_.end());
  return arrived_ == left_;
}

template <class Real>
bool Mirror<Real>::update_list(const LibodeOf<Real>& ode, dxSpace* space,
                               std::span<dxGeom* const> moved, const UserTests& tests,
                               SlotChange& change) {
  if ((all_traits & (kIsNan | kIsInverted)) != 0) return false;
  arrived_.clear();
  for (std::size_t k = 0; k < moved.size(); ++k) {
    dxGeom* const geom = ode.space_get_geom(space, static_cast<int>(k));
    if (!std::binary_search(moved.begin(), moved.end(), geom)) return false;
    if (takes_part(ode, geom)) arrived_.push_back(geom);
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
  const bool complete = read_fresh(ode, tests, change);
  ode.space_clean(space);
  if (is_packed_) packed_.repack(bounds, 0, change.new_slots.size());
  return complete;
}

template <class Real>
bool Mirror<Real>::clean_and_update_array(const LibodeOf<Real>& ode, dxSpace* space,
                                          std::span<dxGeom* const> moved, const UserTests& tests,
                                          SlotChange& change) {
  const auto count = static_cast<std::uint32_t>(ode.space_get_num_geoms(space));
  if (size() != count || (all_traits & (kIsNan | kIsInverted)) != 0) return false;
  ode.space_clean(space);
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
    dxGeom* const geom = ode.space_get_geom(space, static_cast<int>(slot));
    if (!takes_part(ode, geom)) return false;
    arrived_.push_back(geom);
    left_.push_back(geoms[slot]);
  }
  const bool complete = read_fresh(ode, tests, change);
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

template bool takes_part(const LibodeOf<float>&, dxGeom*);
template bool takes_part(const LibodeOf<double>&, dxGeom*);
template class Mirror<float>;
template class Mirror<double>;

}  // namespace harpoon::ode
