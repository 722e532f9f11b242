// Do two axis-aligned boxes overlap? Without branches, over any number type. Included like
// sphere_sphere.inl (no guard, inside the includer's namespace, after vec3.inl); Real needs >, its
// Mask needs || and !.
//
// Semantics are ODE's (collideAABBs): boxes are apart when one ends before the other begins on some
// axis. Touching boxes overlap, and so does a box with a NaN bound: the test may keep too much,
// never too little.

template <class Real>
struct AabbArg {
  Vec3<Real> min, max;
};

template <class Real>
auto aabb_overlap(const AabbArg<Real>& a, const AabbArg<Real>& b) {
  const auto apart_x = a.min.x > b.max.x || b.min.x > a.max.x;
  const auto apart_y = a.min.y > b.max.y || b.min.y > a.max.y;
  const auto apart_z = a.min.z > b.max.z || b.min.z > a.max.z;
  return !(apart_x || apart_y || apart_z);
}
