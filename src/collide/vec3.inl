// Three-vectors over any number type, for the colliders. Included like them: no guard, inside the
// includer's namespace (see sphere_sphere.inl). Sums associate from the left: (x + y) + z.

template <class Real>
struct Vec3 {
  Real x, y, z;
};

template <class Real>
Vec3<Real> operator-(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class Real>
Vec3<Real> operator+(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class Real>
Vec3<Real> operator*(const Vec3<Real>& a, const Real& s) {
  return {a.x * s, a.y * s, a.z * s};
}

template <class Real>
Real length(const Vec3<Real>& a) {
  return sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
}

template <class Mask, class Real>
Vec3<Real> select(const Mask& m, const Vec3<Real>& a, const Vec3<Real>& b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
