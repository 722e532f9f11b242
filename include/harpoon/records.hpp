#pragma once

/// The records that travel between a program and a device: spheres, pairs of spheres, contacts.
///
/// All lengths share one unit of the caller's choice and all positions one frame. Layouts are
/// fixed: they are what the SIMD kernels, the GPU and the AFU read and write, with no padding.
///
///   SpherePair (32 bytes in f32, 64 in f64):  [ p1.x p1.y p1.z r1 | p2.x p2.y p2.z r2 ]
///   Contact    (32 bytes in f32, 64 in f64):  [ pos.xyz | normal.xyz | depth | flow ]
///   BodyContact(36 bytes in f32, 64 in f64):  [ pos.xyz | normal.xyz | depth | g1 g2 ]

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>

namespace harpoon {

/// Which way Algorithm 1 of the paper went. The values are the paper's flow numbers, so a record
/// that was never written (all zero) is told from a pair that was tested and found apart.
enum class Flow : std::uint8_t {
  fake = 1,     ///< Flow 1, fake collision: the spheres are apart, there is no contact
  grazing = 2,  ///< Flow 2, grazing collision: the centres coincide (distance <= 0)
  real = 3,     ///< Flow 3, real collision: the spheres overlap or touch
};

/// A sphere: centre and radius. Radius 0 is legal.
template <class Real>
struct SphereOf {
  Real x, y, z, r;
};

/// A candidate pair, the paper's (p1, r1, p2, r2).
template <class Real>
struct SpherePairOf {
  SphereOf<Real> s1, s2;
};

/// The contact of one pair.
/// `pos` lies midway in the overlap, `normal` is unit length and points from sphere 2 to sphere 1,
/// `depth` >= 0 is the penetration depth (0 when the spheres just touch).
/// For Flow::fake the seven numbers are +0. For Flow::grazing pos = p1, normal = (1, 0, 0) and
/// depth = r1 + r2.
///
/// The length of `normal` is 1 to 2e-7 in f32 and to 4e-16 in f64, unless the squares of the
/// centres' differences underflow. There it is off, as in ODE, whose bits these are; the direction
/// stays right to 1e-5 degrees:
///
///   distance of centres        f32  1e-20   1e-21   3e-22   1e-22   3e-23     f64  1e-160   3e-162
///   length off by at most           1e-5    1e-3    0.01    0.1     0.2            3e-4     0.36
///
/// From about 2e-23 (f64: 1e-162) on the squares are 0 and the centres coincide: Flow::grazing.
/// Squares that overflow (distances from 1.9e19 on, f64: 1.4e154) are infinite: Flow::fake,
/// whatever the radii.
template <class Real>
struct ContactOf {
  using FlowWord = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;

  Real pos[3];
  Real normal[3];
  Real depth;
  FlowWord flow_word;

  [[nodiscard]] Flow flow() const noexcept { return static_cast<Flow>(flow_word); }
  [[nodiscard]] bool hit() const noexcept { return flow() != Flow::fake; }
};

/// Two bodies of a sphere array, by index.
struct IndexPair {
  std::uint32_t g1, g2;
};

/// The contact of two bodies of a sphere array; geometry as in `ContactOf`.
template <class Real>
struct BodyContactOf {
  Real pos[3];
  Real normal[3];
  Real depth;
  std::uint32_t g1, g2;
};

using Sphere = SphereOf<float>;
using SphereF64 = SphereOf<double>;
using SpherePair = SpherePairOf<float>;
using SpherePairF64 = SpherePairOf<double>;
using Contact = ContactOf<float>;
using ContactF64 = ContactOf<double>;
using BodyContact = BodyContactOf<float>;
using BodyContactF64 = BodyContactOf<double>;

static_assert(sizeof(SpherePair) == 32 && sizeof(SpherePairF64) == 64);
static_assert(sizeof(Contact) == 32 && sizeof(ContactF64) == 64);
static_assert(sizeof(BodyContact) == 36 && sizeof(BodyContactF64) == 64);

/// The same pairs as eight separate arrays, each of `count` numbers.
template <class Real>
struct SpherePairArraysOf {
  const Real *x1, *y1, *z1, *r1;
  const Real *x2, *y2, *z2, *r2;
  std::size_t count;
};

/// The same contacts as separate arrays, each of `count` records. `flow` holds Flow values.
template <class Real>
struct ContactArraysOf {
  Real *pos_x, *pos_y, *pos_z;
  Real *normal_x, *normal_y, *normal_z;
  Real* depth;
  typename ContactOf<Real>::FlowWord* flow;
  std::size_t count;
};

}  // namespace harpoon
