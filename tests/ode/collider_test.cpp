// The public interface, with libode's own functions as a statically linked program has them.

#include <gtest/gtest.h>
#include <ode/ode.h>
// After ODE's headers, which it takes its functions from.
#include "harpoon/ode.hpp"

#include <cstring>

#include "support/random.hpp"

namespace harpoon::ode {
namespace {

static_assert(sizeof(dContactGeom) == sizeof(ContactGeomOf<dReal>));
static_assert(offsetof(dContactGeom, side2) == offsetof(ContactGeomOf<dReal>, side2));

struct Gathered {
  std::vector<ContactGeomOf<dReal>> contacts;
  ColliderOf<dReal>* collider = nullptr;  ///< null: by libode

  static void near(void* data, dGeomID o1, dGeomID o2) {
    auto& self = *static_cast<Gathered*>(data);
    ContactGeomOf<dReal> found[8] = {};
    const int count =
        self.collider != nullptr
            ? self.collider->collide(o1, o2, 8, found, sizeof found[0])
            : dCollide(o1, o2, 8, reinterpret_cast<dContactGeom*>(found), sizeof found[0]);
    self.contacts.insert(self.contacts.end(), found, found + count);
  }
};

bool same(std::span<const ContactGeomOf<dReal>> a, std::span<const ContactGeomOf<dReal>> b) {
  return a.size() == b.size() &&
         std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) {
           return std::memcmp(x.pos, y.pos, 3 * sizeof(dReal)) == 0 &&
                  std::memcmp(x.normal, y.normal, 3 * sizeof(dReal)) == 0 &&
                  std::memcmp(&x.depth, &y.depth, sizeof(dReal)) == 0 && x.g1 == y.g1 &&
                  x.g2 == y.g2;
         });
}

struct ColliderTest : ::testing::Test {
  void SetUp() override { dInitODE2(0); }
  void TearDown() override { dCloseODE(); }
};

TEST_F(ColliderTest, ContactsOfASpaceAreThoseOfOdesCallbacks) {
  const dVector3 center = {0, 0, 0, 0}, extents = {8, 8, 8, 0};
  dSpaceID spaces[] = {dSimpleSpaceCreate(nullptr), dHashSpaceCreate(nullptr),
                       dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_ZYX),
                       dQuadTreeSpaceCreate(nullptr, center, extents, 4)};
  Result<ColliderOf<dReal>> collider = ColliderOf<dReal>::make(linked_libode());
  ASSERT_TRUE(collider.ok());
  for (const dSpaceID space : spaces) {
    test::Random random(11);
    std::vector<dGeomID> geoms;
    for (int k = 0; k < 400; ++k) {
      geoms.push_back(k % 2 == 0 ? dCreateSphere(space, 0.6) : dCreateBox(space, 0.9, 0.8, 0.7));
    }
    for (int step = 0; step < 5; ++step) {
      for (const dGeomID geom : geoms) {
        dGeomSetPosition(geom, random.between(-4, 4), random.between(-4, 4), random.between(-4, 4));
      }
      Gathered stock, ours;
      ours.collider = &*collider;
      dSpaceCollide(space, &stock, &Gathered::near);
      collider->space_collide(space, &ours, &Gathered::near);
      EXPECT_GT(stock.contacts.size(), 300u);
      EXPECT_TRUE(same(stock.contacts, ours.contacts)) << dSpaceGetClass(space);
      const auto all = collider->contacts(space, 8);
      ASSERT_TRUE(all.ok());
      EXPECT_TRUE(same(stock.contacts, *all)) << dSpaceGetClass(space);
    }
    collider->destroying(space);
    dSpaceDestroy(space);
  }
}

TEST_F(ColliderTest, BadArgumentsAreErrors) {
  LibodeOf<dReal> incomplete = linked_libode();
  incomplete.geom_get_aabb = nullptr;
  const auto none = ColliderOf<dReal>::make(incomplete);
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().code, Errc::invalid_argument);
  Result<ColliderOf<dReal>> collider = ColliderOf<dReal>::make(linked_libode());
  EXPECT_FALSE(collider->contacts(nullptr, 1).ok());
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  EXPECT_FALSE(collider->contacts(space, 0).ok());
  EXPECT_EQ(collider->contacts(space, 1)->size(), 0u);
  dSpaceDestroy(space);
}

}  // namespace
}  // namespace harpoon::ode
