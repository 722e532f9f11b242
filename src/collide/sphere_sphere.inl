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

template <class Real, class Mask>
struct ContactResult {
  Vec3<Real> pos, normal;
  Real depth;
  Mask hit, grazing;
};

template <class Real>
HARPOON_COLLIDER_FN auto sphere_sphere(const SphereArg<Real>& s1, const SphereArg<Real>& s2) {
  const Vec3<Real> psub = s1.p - s2.p;
  const Real d = length(psub);
  const Real rsum = s1.r + s2.r;
  const Real rsub = s2.r - s1.r;
  const auto hit = !(d > rsum);
  const auto grazing = d <= Real(0);
  const Real d1 = Real(1) / d;
  const Vec3<Real> normal = psub * d1;
  const Real k = Real(0.5) * (rsub - d);
  const Vec3<Real> pos = s1.p + normal * k;
  const Vec3<Real> unit_x{Real(1), Real(0), Real(0)};
  // The depth of Flow 2 needs no selection: there d is +0, and rsum - d is rsum to the bit.
  return ContactResult<Real, decltype(hit)>{
      select(grazing, s1.p, pos), select(grazing, unit_x, normal), rsum - d, hit, grazing};
}
