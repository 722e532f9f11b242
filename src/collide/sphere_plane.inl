// Sphere against plane (half-space), without branches, over any number type. Included like
// sphere_sphere.inl (no guard, inside the includer's namespace, after vec3.inl); Real needs + - *
// and <=.
//
// Semantics and order of operations are ODE's (dCollideSpherePlane). The plane is
// { q : n.q = offset }, n of unit length, solid on the side that n points away from:
//   depth = (offset - ((p.x*n.x + p.y*n.y) + p.z*n.z)) + r, contact when 0 <= depth,
//   pos = p - n*r, normal = n.
// A NaN depth is no contact. Where there is none the other fields mean nothing.

template <class Real>
struct SpherePlaneArg {
  Vec3<Real> p;
  Real r;
  Vec3<Real> n;
  Real offset;
};

template <class Real, class Mask>
struct SpherePlaneResult {
  Vec3<Real> pos, normal;
  Real depth;
  Mask hit;
};

template <class Real>
auto sphere_plane(const SpherePlaneArg<Real>& a) {
  const Real k = a.p.x * a.n.x + a.p.y * a.n.y + a.p.z * a.n.z;
  const Real depth = a.offset - k + a.r;
  const auto hit = Real(0) <= depth;
  const Vec3<Real> pos = a.p - a.n * a.r;
  return SpherePlaneResult<Real, decltype(hit)>{pos, a.n, depth, hit};
}
