// Are two spheres apart? The decision of sphere_sphere's Flow 1, bit for bit, without its square
// root: what a device may ask before it spends the whole collider on a pair. Included like
// sphere_sphere.inl, after it; Real needs + - * and sqrt_greater(a, b), which is sqrt(a) > b for
// the correctly rounded root.

template <class Real>
auto sphere_miss(const SphereArg<Real>& s1, const SphereArg<Real>& s2) {
  const Vec3<Real> psub = s1.p - s2.p;
  const Real square = psub.x * psub.x + psub.y * psub.y + psub.z * psub.z;
  return sqrt_greater(square, s1.r + s2.r);
}
