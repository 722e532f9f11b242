// The colliders over Highway vectors. Include after "hwy/highway.h" inside a foreach_target file,
// outside any namespace; defines harpoon::colliders::HWY_NAMESPACE once per instruction set.
//
// Every function says HWY_ATTR: g++ does not give templates and their friends the instruction set
// of the region they stand in, and where one is not inlined, caller and callee disagree on how
// vectors are passed.

#if defined(HARPOON_COLLIDE_SIMD_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef HARPOON_COLLIDE_SIMD_INL
#undef HARPOON_COLLIDE_SIMD_INL
#else
#define HARPOON_COLLIDE_SIMD_INL
#endif

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace harpoon::colliders::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// A set of lanes. D is a Highway tag such as ScalableTag<float>.
template <class D>
struct SimdMask {
  hn::Mask<D> m;
};

/// A vector of numbers that behaves like one number.
template <class D>
struct SimdReal {
  hn::Vec<D> v;

  SimdReal() = default;
  HWY_ATTR HWY_INLINE SimdReal(hn::Vec<D> vector) : v(vector) {}
  HWY_ATTR HWY_INLINE explicit SimdReal(double number)
      : v(hn::Set(D(), static_cast<hn::TFromD<D>>(number))) {}

  friend HWY_ATTR HWY_INLINE SimdReal operator+(const SimdReal& a, const SimdReal& b) {
    return hn::Add(a.v, b.v);
  }
  friend HWY_ATTR HWY_INLINE SimdReal operator-(const SimdReal& a, const SimdReal& b) {
    return hn::Sub(a.v, b.v);
  }
  friend HWY_ATTR HWY_INLINE SimdReal operator*(const SimdReal& a, const SimdReal& b) {
    return hn::Mul(a.v, b.v);
  }
  friend HWY_ATTR HWY_INLINE SimdReal operator/(const SimdReal& a, const SimdReal& b) {
    return hn::Div(a.v, b.v);
  }
  friend HWY_ATTR HWY_INLINE SimdMask<D> operator>(const SimdReal& a, const SimdReal& b) {
    return {hn::Gt(a.v, b.v)};
  }
  friend HWY_ATTR HWY_INLINE SimdMask<D> operator<=(const SimdReal& a, const SimdReal& b) {
    return {hn::Le(a.v, b.v)};
  }
};

template <class D>
HWY_ATTR HWY_INLINE SimdReal<D> sqrt(const SimdReal<D>& a) {
  return hn::Sqrt(a.v);
}

template <class D>
HWY_ATTR HWY_INLINE SimdMask<D> operator!(const SimdMask<D>& mask) {
  return {hn::Not(mask.m)};
}

template <class D>
HWY_ATTR HWY_INLINE SimdReal<D> select(const SimdMask<D>& mask, const SimdReal<D>& if_set,
                                       const SimdReal<D>& if_clear) {
  return hn::IfThenElse(mask.m, if_set.v, if_clear.v);
}

// The collider's functions are functions of this instruction set.
#pragma push_macro("HARPOON_COLLIDER_FN")
#undef HARPOON_COLLIDER_FN
#define HARPOON_COLLIDER_FN HWY_ATTR HWY_INLINE

#include "collide/vec3.inl"

#include "collide/sphere_sphere.inl"

#pragma pop_macro("HARPOON_COLLIDER_FN")

}  // namespace harpoon::colliders::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
