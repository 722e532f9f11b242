// A sphere copied as one vector, or two: compilers copy it number by number where they gather
// records into a block. Include after "hwy/highway.h" inside a foreach_target file, outside any
// namespace.

#if defined(HARPOON_COLLIDE_COPY_SPHERE_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HARPOON_COLLIDE_COPY_SPHERE_INL
#undef HARPOON_COLLIDE_COPY_SPHERE_INL
#else
#define HARPOON_COLLIDE_COPY_SPHERE_INL
#endif

#include <cstddef>
#include <type_traits>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace harpoon::colliders::HWY_NAMESPACE {

/// A sphere is four numbers in a row from its x on.
template <class Sphere>
HWY_ATTR HWY_INLINE void copy_sphere(const Sphere& from, Sphere& to) {
  namespace hn = hwy::HWY_NAMESPACE;
  const hn::CappedTag<std::remove_cv_t<decltype(to.x)>, 4> d;
  static_assert(sizeof(Sphere) == 4 * sizeof(to.x));
  for (std::size_t k = 0; k < 4; k += hn::Lanes(d)) {
    hn::StoreU(hn::LoadU(d, &from.x + k), d, &to.x + k);
  }
}

}  // namespace harpoon::colliders::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
