// Three-vectors over any number type, for the colliders. Included like them: no guard, inside the
// includer's namespace (see sphere_sphere.inl). Sums associate from the left: (x + y) + z.

// How collider functions are declared: always inlined, because vectors passed through memory cost
// more than the arithmetic.
#ifndef HARPOON_COLLIDER_FN
#define HARPOON_COLLIDER_FN [[gnu::always_inline]] inline
#endif

template <class Real>
struct Vec3 {
  Real x, y, z;
};

template <class Real>
HARPOON_COLLIDER_FN Vec3<Real> operator-(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class Real>
HARPOON_COLLIDER_FN Vec3<Real> operator+(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class Real>
HARPOON_COLLIDER_FN Vec3<Real> operator*(const Vec3<Real>& a, const Real& s) {
  return {a.x * s, a.y * s, a.z * s};
}

template <class Real>
HARPOON_COLLIDER_FN Real length(const Vec3<Real>& a) {
  return sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

template <class Mask, class Real>
HARPOON_COLLIDER_FN Vec3<Real> select(const Mask& m, const Vec3<Real>& a, const Vec3<Real>& b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
