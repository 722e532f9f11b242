#include "ode/mirror.hpp"

#include <cmath>

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

/// Whether the class is one of the user's that asks about each pair.
bool asks(int number, const UserTests& tests) {
  return number >= geom_class::kFirstUser && tests[number - geom_class::kFirstUser] != nullptr;
}

}  // namespace

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
                             const UserTests& tests) {
  const std::uint32_t slot = filled_++;
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
  filled_ = 0;
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
    read_geom(ode, geom, number, tests);
    all_category &= category[filled_ - 1];
    all_collide &= collide[filled_ - 1];
  }
  resize(filled_);
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

template class Mirror<float>;
template class Mirror<double>;

}  // namespace harpoon::ode
