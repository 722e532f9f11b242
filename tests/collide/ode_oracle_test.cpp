// Stock ODE as the oracle of the colliders that no device calls yet: over double, sphere_plane
// gives the bits of dCollide, and aabb_overlap the decisions of a simple space.

#include <gtest/gtest.h>
#include <ode/ode.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "collide/scalar.hpp"
#include "support/random.hpp"

namespace harpoon {
namespace {

constexpr std::uint64_t kSeed = 20260311;
constexpr int kCases = 200'000;

using Vector = std::array<double, 3>;

class OdeOracle : public testing::Test {
 protected:
  OdeOracle() { dInitODE2(0); }
  ~OdeOracle() override { dCloseODE(); }

  Vector vector(double size) {
    return {random_.between(-size, size), random_.between(-size, size),
            random_.between(-size, size)};
  }

  test::Random random_{kSeed};
};

bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST_F(OdeOracle, SpherePlane) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  const dGeomID sphere = dCreateSphere(nullptr, 1);
  const dGeomID plane = dCreatePlane(nullptr, 0, 0, 1, 0);
  int hits = 0;
  int touching = 0;
  for (int i = 0; i < kCases; ++i) {
    Vector p = vector(2);
    Vector n = vector(1);
    double r = random_.unit();
    if (i % 4 == 0) {  // on a lattice, where depth is often exactly 0
      n = {0, 0, 1};
      r = static_cast<double>(random_.below(3));
      for (double& x : p) x = static_cast<double>(random_.below(5));
    }
    dGeomSphereSetRadius(sphere, r);
    dGeomSetPosition(sphere, p[0], p[1], p[2]);
    dGeomPlaneSetParams(plane, n[0], n[1], n[2],
                        i % 4 == 0 ? static_cast<double>(random_.below(3)) : random_.unit());
    dVector4 normalised;  // ODE makes n a unit vector
    dGeomPlaneGetParams(plane, normalised);
    dContactGeom stock{};
    const bool stock_hit = dCollide(sphere, plane, 1, &stock, sizeof stock) != 0;
    const auto c = colliders::sphere_plane<double>(
        {{p[0], p[1], p[2]}, r, {normalised[0], normalised[1], normalised[2]}, normalised[3]});
    ASSERT_EQ(c.hit, stock_hit) << "case " << i;
    if (!stock_hit) continue;
    ++hits;
    touching += stock.depth == 0;
    ASSERT_TRUE(same_bits(c.depth, stock.depth)) << "case " << i;
    const Vector pos{c.pos.x, c.pos.y, c.pos.z};
    const Vector normal{c.normal.x, c.normal.y, c.normal.z};
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_TRUE(same_bits(pos[k], stock.pos[k])) << "case " << i;
      ASSERT_TRUE(same_bits(normal[k], stock.normal[k])) << "case " << i;
    }
  }
  EXPECT_GT(hits, kCases / 10);
  EXPECT_LT(hits, kCases * 9 / 10);
  EXPECT_GT(touching, 1000);
  dGeomDestroy(sphere);
  dGeomDestroy(plane);
}

TEST_F(OdeOracle, AabbOverlap) {
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  std::array<dGeomID, 2> boxes{dCreateBox(space, 1, 1, 1), dCreateBox(space, 1, 1, 1)};
  const auto count = [](void* counter, dGeomID, dGeomID) { ++*static_cast<int*>(counter); };
  int overlaps = 0;
  int touching = 0;
  for (int i = 0; i < kCases; ++i) {
    const bool lattice = i % 2 == 0;
    std::array<colliders::AabbArg<double>, 2> bounds{};
    for (std::size_t b = 0; b < 2; ++b) {
      Vector p = vector(1);
      Vector side{random_.between(0.1, 2), random_.between(0.1, 2), random_.between(0.1, 2)};
      if (lattice) {
        for (double& x : p) x = static_cast<double>(random_.below(4));
        for (double& x : side) x = static_cast<double>(2 * random_.below(2) + 2);
      }
      dGeomBoxSetLengths(boxes[b], side[0], side[1], side[2]);
      dGeomSetPosition(boxes[b], p[0], p[1], p[2]);
      std::array<dReal, 6> aabb{};  // low and high of each axis in turn
      dGeomGetAABB(boxes[b], aabb.data());
      bounds[b] = {{aabb[0], aabb[2], aabb[4]}, {aabb[1], aabb[3], aabb[5]}};
    }
    int called = 0;
    dSpaceCollide(space, &called, count);
    ASSERT_EQ(colliders::aabb_overlap<double>(bounds[0], bounds[1]), called == 1) << "case " << i;
    overlaps += called;
    touching +=
        called == 1 && (bounds[0].max.x == bounds[1].min.x || bounds[1].max.x == bounds[0].min.x);
  }
  EXPECT_GT(overlaps, kCases / 10);
  EXPECT_LT(overlaps, kCases * 9 / 10);
  EXPECT_GT(touching, 1000);
  dSpaceDestroy(space);
}

}  // namespace
}  // namespace harpoon
