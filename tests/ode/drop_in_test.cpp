// The drop-in against stock libode, in one process: this program is linked to libharpoon_ode before
// libode, as a preload would have it, and reaches stock through libode's own handle.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string_view>

#include "ode/twin_world.hpp"

namespace harpoon::test {
namespace {

/// How many scenes of each kind of space. The soak asks for more.
std::uint64_t scenes() {
  static const std::uint64_t count = [] {
    const char* const wanted = std::getenv("HARPOON_TEST_SCENES");
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    const int usual = 12;
#else
    const int usual = 200;
#endif
    return static_cast<std::uint64_t>(wanted == nullptr ? usual : std::atoi(wanted));
  }();
  return count;
}
constexpr int kSteps = 100;

class Ode : public ::testing::Environment {
 public:
  void SetUp() override {
    // Small spaces too, which otherwise are libode's.
    ::setenv("HARPOON_MIN_GEOMS", "12", 1);
    ::setenv("HARPOON_STATS", "1", 1);
    dInitODE2(0);
    dAllocateODEDataForThread(static_cast<unsigned>(dAllocateMaskAll));
  }
  void TearDown() override { dCloseODE(); }
};
const ::testing::Environment* const kOde = ::testing::AddGlobalTestEnvironment(new Ode);

/// Whether this libode lets callbacks change the spaces that are being collided: a variant of it.
bool is_unlocked() {
  const char* const unlocked = std::getenv("HARPOON_TEST_UNLOCKED");
  return unlocked != nullptr && std::string_view(unlocked) == "1";
}

WorldPlan plan_of(std::uint64_t seed, SpaceKind kind) {
  Random random(seed * 7919);
  WorldPlan plan;
  plan.kind = kind;
  plan.geoms = static_cast<std::uint32_t>(random.below(16) == 0 ? 300 + random.below(200)
                                                                : 3 + random.below(70));
  plan.lattice = random.below(2) == 0;
  plan.spheres_only = random.below(4) == 0;
  plan.extent = plan.geoms > 200 ? 9 : 3;
  plan.all_enabled = random.below(3) == 0;
  plan.toggles_in_callbacks = !plan.all_enabled && random.below(3) == 0;
  plan.nested_calls = random.below(4) == 0;
  plan.user_class = random.below(5) == 0;
  plan.few_movers = random.below(3) == 0;
  plan.space_within = random.below(6) == 0;
  plan.others = 4 + static_cast<std::uint32_t>(random.below(4) == 0 ? random.below(60) : 0);
  if (random.below(8) == 0) plan.others = plan.geoms;
  plan.hash_others = random.below(2) == 0;
  plan.changes_in_callbacks = is_unlocked() && random.below(4) != 0;
  // A stock SAP space that is collided again in a callback walks on over the geoms of that call.
  if (plan.changes_in_callbacks && kind == SpaceKind::sap) plan.nested_calls = false;
  return plan;
}

struct Seen {
  std::uint64_t callbacks = 0, contacts = 0, toggled = 0, added = 0, removed = 0, nested = 0;
  std::uint64_t between_spaces = 0, moved_between = 0, changed_in_callbacks = 0;
  void take(const World& world) {
    callbacks += world.callbacks;
    contacts += world.contacts;
    toggled += world.toggled;
    added += world.added;
    removed += world.removed;
    nested += world.nested;
    between_spaces += world.between_spaces;
    moved_between += world.moved_between;
    changed_in_callbacks += world.changed_in_callbacks;
  }
};

/// Runs one scene in both worlds. False after the first difference.
bool run_scene(std::uint64_t seed, const WorldPlan& plan, Seen& seen) {
  World stock(stock_ode(), plan, seed), ours(linked_ode(), plan, seed);
  const int steps = plan.geoms > 200 ? kSteps / 10 : kSteps;
  for (int step = 0; step < steps; ++step) {
    stock.change();
    ours.change();
    for (World* world : {&stock, &ours}) {
      if (step % 4 == 1) {
        world->collide_with_others();
        world->change();
      }
      world->collide();
      if (step % 3 == 0) world->collide_with_others();
    }
    const auto expected = stock.take_trace(), got = ours.take_trace();
    if (expected != got) {
      const auto at = std::mismatch(expected.begin(), expected.end(), got.begin(), got.end()).first;
      ADD_FAILURE() << "seed " << seed << ", kind " << static_cast<int>(plan.kind) << ", step "
                    << step << ", " << plan.geoms << " geoms: traces of " << expected.size()
                    << " and " << got.size() << " words differ at word " << at - expected.begin();
      return false;
    }
  }
  seen.take(ours);
  return true;
}

void run_scenes(SpaceKind kind) {
  Seen seen;
  for (std::uint64_t seed = 1; seed <= scenes(); ++seed) {
    ASSERT_TRUE(run_scene(seed, plan_of(seed, kind), seen));
  }
  EXPECT_GT(seen.callbacks, 1000 * scenes());
  EXPECT_GT(seen.contacts, 100 * scenes());
  EXPECT_GT(seen.toggled, 10 * scenes());
  EXPECT_GT(seen.added, scenes());
  EXPECT_GT(seen.removed, scenes());
  EXPECT_GT(seen.nested, kind == SpaceKind::sap && is_unlocked() ? scenes() / 4 : scenes());
  EXPECT_GT(seen.between_spaces, 10 * scenes());
  EXPECT_GT(seen.moved_between, scenes() / 2);
  EXPECT_GE(seen.changed_in_callbacks, is_unlocked() ? 100 * scenes() : 0);
  std::cout << scenes() << " scenes: " << seen.callbacks << " callbacks, " << seen.contacts
            << " contacts, " << seen.nested << " nested calls\n";
}

/// Runs scenes in a process of its own, whose line of statistics the caller looks at.
void run_and_exit(SpaceKind kind) {
  Seen seen;
  bool same = true;
  for (std::uint64_t seed = 1; seed <= std::min<std::uint64_t>(scenes() / 2, 16); ++seed) {
    WorldPlan plan = plan_of(seed, kind);
    plan.few_movers = true;
    plan.all_enabled = seed % 2 == 0;
    plan.toggles_in_callbacks = false;
    same = run_scene(seed, plan, seen) && same;
  }
  std::exit(same ? 0 : 1);
}

TEST(DropInDeathTest, ScenesReachEveryWayToAnswer) {
  for (const SpaceKind kind : {SpaceKind::simple, SpaceKind::hash, SpaceKind::sap}) {
    EXPECT_EXIT(run_and_exit(kind), ::testing::ExitedWithCode(0),
                "[1-9][0-9]+ searched, [1-9][0-9]+ updated, [1-9][0-9]+ unchanged.*"
                "[1-9][0-9]{2,} scanned, [1-9][0-9]+ of two spaces");
  }
  EXPECT_EXIT(run_and_exit(SpaceKind::quadtree), ::testing::ExitedWithCode(0),
              "[1-9][0-9]+ unchanged, [1-9][0-9]+ recorded");
}

TEST(DropIn, SimpleSpacesAreStock) {
  run_scenes(SpaceKind::simple);
}
TEST(DropIn, HashSpacesAreStock) {
  run_scenes(SpaceKind::hash);
}
TEST(DropIn, SapSpacesAreStock) {
  run_scenes(SpaceKind::sap);
}
TEST(DropIn, QuadtreeSpacesAreStock) {
  run_scenes(SpaceKind::quadtree);
}

using Pairs = std::vector<std::pair<dGeomID, dGeomID>>;

void note(void* pairs, dGeomID o1, dGeomID o2) {
  static_cast<Pairs*>(pairs)->emplace_back(o1, o2);
}

/// A SAP space whose axes are all x is recorded and replayed. What is replayed has no bounds, and
/// dSpaceCollide2 needs those of all geoms.
TEST(DropIn, ARecordedSpaceCanBeScanned) {
  const dSpaceID space = dSweepAndPruneSpaceCreate(nullptr, 0);
  for (int k = 0; k < 40; ++k) dGeomSetPosition(dCreateSphere(space, 0.3), 0.5 * k, 0, 0);
  for (int k = 0; k < 3; ++k) dGeomSetPosition(dCreateSphere(space, 0.3), 0, 5.0 + k, 0);
  const dGeomID ray = dCreateRay(nullptr, 30);
  dGeomRaySet(ray, 0, 4, 0, 0, 1, 0);
  const auto scan = [&](const StockOde& ode) {
    Pairs pairs;
    ode.space_collide2(reinterpret_cast<dGeomID>(space), ray, &pairs, &note);
    return pairs;
  };
  const Pairs expected = scan(stock_ode());
  EXPECT_EQ(expected.size(), 3u);
  EXPECT_EQ(scan(linked_ode()), expected);
  Pairs first, again;
  for (int call = 0; call < 4; ++call) {
    again.clear();
    dSpaceCollide(space, &again, &note);
    if (call == 0) first = again;
    EXPECT_EQ(again, first);
    EXPECT_EQ(scan(linked_ode()), expected) << "after call " << call;
  }
  EXPECT_GE(first.size(), 39u);
  dGeomDestroy(ray);
  dSpaceDestroy(space);
}

}  // namespace
}  // namespace harpoon::test
