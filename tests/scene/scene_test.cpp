// Scene against the collider on all pairs, over random histories: whatever happened before, a frame
// is what detect finds.

#include <gtest/gtest.h>

#include <string>

#include "harpoon/scene.hpp"
#include "scene/brute_force.hpp"
#include "scene/worlds.hpp"

namespace harpoon::testing {
namespace {

constexpr std::uint64_t kSeed = 77001;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kMovingBodies = 100;  // unoptimised kernels are slow
#else
constexpr int kMovingBodies = 250;
#endif

template <class Real>
class SceneTest : public ::testing::Test {
 protected:
  static SceneOf<Real> scene(unsigned threads = 1) {
    auto made = SceneOf<Real>::make({.threads = threads});
    EXPECT_TRUE(made.ok());
    return std::move(made.value());
  }
  static std::span<const SphereOf<Real>> view(const std::vector<SphereOf<Real>>& s) { return s; }
  static std::vector<BodyContactOf<Real>> copy(const Result<FrameOf<Real>>& frame) {
    EXPECT_TRUE(frame.ok());
    return {frame->contacts.begin(), frame->contacts.end()};
  }
  static void shake(std::vector<SphereOf<Real>>& spheres, Dice& dice, double part) {
    for (auto& s : spheres) {
      const double step = static_cast<double>(s.r) * part;
      s.x += static_cast<Real>(dice.uniform(-step, step));
      s.y += static_cast<Real>(dice.uniform(-step, step));
      s.z += static_cast<Real>(dice.uniform(-step, step));
    }
  }
};
using Reals = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SceneTest, Reals);

TYPED_TEST(SceneTest, MovingWorldsEqualBruteForceInEveryFrame) {
  using Real = TypeParam;
  int searched = 0;
  int reused = 0;
  for (const World world : kWorlds) {
    for (const double part : {0.0, 0.001, 0.02, 0.3}) {
      Dice dice(kSeed);
      auto spheres = WorldMaker<Real>(kSeed + 5).make(world, kMovingBodies);
      auto scene = this->scene(part == 0.02 ? 2 : 1);
      for (int frame = 0; frame < 14; ++frame) {
        ASSERT_FALSE(scene.set_bodies(BodiesOf<Real>(this->view(spheres))));
        const auto result = scene.detect();
        ASSERT_TRUE(same_bits(this->copy(result), brute_force(this->view(spheres))))
            << "world " << static_cast<int>(world) << " part " << part << " frame " << frame;
        (result->searched ? searched : reused) += 1;
        this->shake(spheres, dice, part);
      }
    }
  }
  EXPECT_GT(searched, 100);
  EXPECT_GT(reused, 200);
}

// At a tenth of the radius a frame, a list lasts two frames more: it is made, and it is exact.
TYPED_TEST(SceneTest, FastBodiesHaveAListWhereItServesAFrame) {
  using Real = TypeParam;
  Dice dice(kSeed);
  auto spheres = WorldMaker<Real>(kSeed + 6).make(World::packed, kMovingBodies);
  auto scene = this->scene();
  int reused = 0;
  for (int frame = 0; frame < 30; ++frame) {
    ASSERT_FALSE(scene.set_bodies(BodiesOf<Real>(this->view(spheres))));
    const auto result = scene.detect();
    ASSERT_TRUE(same_bits(this->copy(result), brute_force(this->view(spheres)))) << frame;
    reused += result->searched ? 0 : 1;
    this->shake(spheres, dice, 0.06);
  }
  EXPECT_GT(reused, 8);
}

// A margin for one huge body would list nearly all pairs of a crowd of small, fast ones.
TYPED_TEST(SceneTest, AListThatIsTooLongIsGivenUp) {
  using Real = TypeParam;
  constexpr int kCrowd = 600;
  Dice dice(kSeed);
  std::vector<SphereOf<Real>> spheres(kCrowd, {0, 0, 0, Real(0.1)});
  for (auto& s : spheres) {
    s.x = static_cast<Real>(dice.uniform(-4, 4));
    s.y = static_cast<Real>(dice.uniform(-4, 4));
    s.z = static_cast<Real>(dice.uniform(-4, 4));
  }
  spheres[7] = {0, 0, 130, 100};
  auto scene = this->scene();
  for (int frame = 0; frame < 12; ++frame) {
    ASSERT_FALSE(scene.set_bodies(BodiesOf<Real>(this->view(spheres))));
    const auto result = scene.detect();
    ASSERT_TRUE(same_bits(this->copy(result), brute_force(this->view(spheres)))) << frame;
    EXPECT_TRUE(result->searched) << frame;
    for (auto& s : spheres) s.x += static_cast<Real>(dice.uniform(-1, 1));
  }
}

TYPED_TEST(SceneTest, RandomHistoriesEqualBruteForce) {
  using Real = TypeParam;
  int operations[6] = {};
  for (std::uint64_t round = 0; round < 12; ++round) {
    Dice dice(kSeed + round);
    auto scene = this->scene();
    std::vector<SphereOf<Real>> spheres;  // by id; a removed body has radius -1
    std::vector<std::uint32_t> category, collide, owner;
    std::vector<Rest> rest;
    const auto someone = [&] {
      return static_cast<std::uint32_t>(dice.integer(0, static_cast<int>(spheres.size()) - 1));
    };
    const auto sphere_now = [&] {
      return sphere<Real>(dice.uniform(0, 6), dice.uniform(0, 6), dice.uniform(0, 6),
                          dice.uniform(0, 0.6));
    };
    for (int step = 0; step < 120; ++step) {
      const int what = spheres.empty() ? 0 : dice.integer(0, 5);
      ++operations[what];
      const std::uint32_t id = spheres.empty() ? 0 : someone();
      const bool there = !spheres.empty() && spheres[id].r >= 0;
      if (what <= 1) {
        BodyRules rules;
        if (dice.one_in(2)) {
          rules.category = static_cast<std::uint32_t>(dice.integer(0, 3));
          rules.collide = static_cast<std::uint32_t>(dice.integer(0, 3));
          rules.owner = static_cast<std::uint32_t>(dice.integer(0, 4));
          rules.rest = static_cast<Rest>(dice.integer(0, 2));
        }
        const SphereOf<Real> s = sphere_now();
        const auto added = scene.add(s, rules);
        ASSERT_TRUE(added.ok());
        const auto lowest_free = static_cast<std::size_t>(
            std::find_if(spheres.begin(), spheres.end(), [](auto& b) { return b.r < 0; }) -
            spheres.begin());
        ASSERT_EQ(*added, lowest_free);
        if (*added == spheres.size()) {
          spheres.emplace_back();
          category.emplace_back();
          collide.emplace_back();
          owner.emplace_back();
          rest.emplace_back();
        }
        spheres[*added] = s;
        category[*added] = rules.category;
        collide[*added] = rules.collide;
        owner[*added] = rules.owner;
        rest[*added] = rules.rest;
      } else if (what == 2) {
        ASSERT_EQ(!scene.remove(id), there);
        spheres[id].r = -1;
      } else if (what == 3) {
        const SphereOf<Real> s = sphere_now();
        ASSERT_EQ(!scene.move(id, s), there);
        if (there) spheres[id] = s;
      } else if (what == 4) {
        SphereOf<Real> s = spheres[id];
        s.x += static_cast<Real>(0.004);
        ASSERT_EQ(!scene.move(id, s), there);
        if (there) spheres[id] = s;
      } else {
        ASSERT_EQ(!scene.set_rules(id, {1, 1, 0, Rest::asleep}), there);
        if (there) {
          category[id] = collide[id] = 1;
          owner[id] = 0;
          rest[id] = Rest::asleep;
        }
      }
      const Filters filters{category, collide, owner, rest};
      ASSERT_TRUE(same_bits(this->copy(scene.detect()), brute_force(this->view(spheres), filters)))
          << "round " << round << " step " << step << " operation " << what;
    }
  }
  for (const int count : operations) EXPECT_GT(count, 100);
}

TYPED_TEST(SceneTest, NothingMovedCostsNothingAndKeepsTheFrame) {
  using Real = TypeParam;
  const auto spheres = WorldMaker<Real>(kSeed).make(World::packed, 400);
  auto scene = this->scene();
  ASSERT_FALSE(scene.set_bodies(BodiesOf<Real>(this->view(spheres))));
  const auto first = scene.detect();
  const auto contacts = this->copy(first);
  EXPECT_TRUE(first->changed);
  EXPECT_TRUE(first->searched);
  ASSERT_FALSE(scene.set_bodies(BodiesOf<Real>(this->view(spheres))));
  const auto second = scene.detect();
  EXPECT_FALSE(second->changed);
  EXPECT_FALSE(second->searched);
  EXPECT_TRUE(same_bits(this->copy(second), contacts));
}

TYPED_TEST(SceneTest, InvalidBodiesAreNamedAndFreeIdsAreNot) {
  using Real = TypeParam;
  auto scene = this->scene();
  for (int k = 0; k < 4; ++k) ASSERT_TRUE(scene.add({Real(k), 0, 0, Real(0.6)}).ok());
  ASSERT_FALSE(scene.remove(0));
  ASSERT_FALSE(scene.move(2, {std::numeric_limits<Real>::quiet_NaN(), 0, 0, 1}));
  const auto frame = scene.detect();
  ASSERT_TRUE(frame.ok());
  EXPECT_EQ(std::vector<std::uint32_t>(frame->excluded.begin(), frame->excluded.end()),
            std::vector<std::uint32_t>{2});
  EXPECT_TRUE(frame->contacts.empty());
  EXPECT_EQ(scene.size(), 3U);
  EXPECT_EQ(scene.remove(0)->code, Errc::invalid_index);
  EXPECT_EQ(scene.remove(9)->code, Errc::invalid_index);
}

TYPED_TEST(SceneTest, MoreContactsThanTheLimitAreCountedAndNotKept) {
  using Real = TypeParam;
  constexpr std::uint64_t kCoincident = 700;
  constexpr std::uint64_t kContacts = kCoincident * (kCoincident - 1) / 2;
  std::vector<SphereOf<Real>> spheres(kCoincident, {1, 2, 3, Real(0.5)});
  for (const unsigned threads : {1U, 2U}) {
    auto scene = this->scene(threads);
    for (int frame = 0; frame < 4; ++frame) {  // with and without a list of nearby pairs
      ASSERT_FALSE(scene.set_bodies(BodiesOf<Real>(this->view(spheres))));
      scene.limit_contacts(kContacts - 1);
      for (int again = 0; again < 2; ++again) {
        const auto refused = scene.detect();
        ASSERT_FALSE(refused.ok());
        EXPECT_EQ(refused.error().code, Errc::capacity);
        EXPECT_EQ(refused.error().needed, kContacts);
      }
      scene.limit_contacts(kContacts);
      EXPECT_EQ(scene.detect()->contacts.size(), kContacts) << frame;
      for (auto& s : spheres) s.x += Real(0.001);
    }
  }
}

TYPED_TEST(SceneTest, CoincidentBodiesDoNotRunAway) {
  using Real = TypeParam;
  EXPECT_EQ(default_contact_limit(0), 1U << 24);
  EXPECT_EQ(default_contact_limit(1U << 20), 1U << 26);
  constexpr std::uint64_t kCoincident = 6000;  // 18 million contacts
  auto scene = this->scene();
  const std::vector<SphereOf<Real>> spheres(kCoincident, {1, 2, 3, Real(0.5)});
  ASSERT_FALSE(scene.set_bodies(BodiesOf<Real>(this->view(spheres))));
  const auto refused = scene.detect();
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, Errc::capacity);
  EXPECT_EQ(refused.error().needed, kCoincident * (kCoincident - 1) / 2);
}

TYPED_TEST(SceneTest, EmptyScene) {
  auto scene = this->scene();
  EXPECT_TRUE(scene.detect()->contacts.empty());
  ASSERT_FALSE(scene.set_bodies({}));
  EXPECT_TRUE(scene.detect()->contacts.empty());
}

}  // namespace
}  // namespace harpoon::testing
