// Sphere against sphere: Algorithm 1 of the paper without branches, over any number type.
//
// This file has no include guard and opens no namespace: it is included inside one, once per number
// type and instruction set (src/collide/scalar.hpp, src/device/cpu/kernels.cpp, src/hls), so that
// its arithmetic is compiled with that target's instructions. The includer provides, for Real:
// + - * /, sqrt, comparisons > and <= that give a Mask, !Mask, and select(Mask, Real, Real); and
// vec3.inl before it.
//
// Order of operations is ODE's (dCollideSpheres), so f64 gives its bits:
//   d = sqrt((x*x + y*y) + z*z), n = (p1 - p2) * (1/d), k = 0.5 * ((r2 - r1) - d),
//   pos = p1 + n*k, depth = (r1 + r2) - d.
//
// | d > r1+r2 | d <= 0 | flow                                              |
// |     1     |   x    | 1 fake: no hit, the other fields mean nothing     |
// |     0     |   1    | 2 grazing: pos p1, normal (1,0,0), depth r1+r2    |
// |     0     |   0    | 3 real (also when d is NaN, as in ODE)            |

template <class Real>
struct SphereArg {
  Vec3<Real> p;
  Real r;
};

/// Stage 1 of Algorithm 2: what depends on the operands alone, with the distance as one step.
template <class Real>
struct Separation {
  Vec3<Real> psub;
  Real d, rsum, rsub;
};

template <class Real, class Mask>
struct ContactResult {
  Vec3<Real> pos, normal;
  Real depth;
  Mask hit, grazing;
};

template <class Real>
HARPOON_COLLIDER_FN Separation<Real> separation(const SphereArg<Real>& s1,
                                                const SphereArg<Real>& s2) {
  const Vec3<Real> psub = s1.p - s2.p;
  return {psub, length(psub), s1.r + s2.r, s2.r - s1.r};
}

template <class Real>
HARPOON_COLLIDER_FN auto touches(const Separation<Real>& s) {
  return !(s.d > s.rsum);
}

/// Stages 2 to 5 of Algorithm 2.
template <class Real>
HARPOON_COLLIDER_FN auto contact(const Vec3<Real>& p1, const Separation<Real>& s) {
  const auto hit = touches(s);
  const auto grazing = s.d <= Real(0);
  const Real d1 = Real(1) / s.d;
  const Vec3<Real> normal = s.psub * d1;
  const Real k = Real(0.5) * (s.rsub - s.d);
  const Vec3<Real> pos = p1 + normal * k;
  const Vec3<Real> unit_x{Real(1), Real(0), Real(0)};
  // The depth of Flow 2 needs no selection: there d is +0, and rsum - d is rsum to the bit.
  return ContactResult<Real, decltype(hit)>{
      select(grazing, p1, pos), select(grazing, unit_x, normal), s.rsum - s.d, hit, grazing};
}

template <class Real>
HARPOON_COLLIDER_FN auto sphere_sphere(const SphereArg<Real>& s1, const SphereArg<Real>& s2) {
  return contact(s1.p, separation(s1, s2));
}
