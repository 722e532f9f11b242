// Every allocation of the drop-in fails once, in every kind of call: the callbacks are those of
// stock, all of them, whether the failure comes before the first callback or between two. libode's
// own allocations are not tried: it throws where it has no memory, with the drop-in or without.

#include <gtest/gtest.h>
#include <ode/ode.h>

#include <array>
#include <cstdlib>
#include <functional>
#include <ostream>
#include <vector>

#include "ode/twin_world.hpp"
#include "support/failing_allocations.hpp"

namespace harpoon::test {
namespace {

constexpr int kGeoms = 220;
constexpr std::size_t kMostEvents = 1 << 16;

/// A space of spheres and boxes in a row, each of which touches its neighbours, and what callbacks
/// saw of it.
class Scenery {
 public:
  Scenery(const StockOde& ode, SpaceKind kind) : ode_(ode), kind_(kind) {
    const dVector3 center = {0, 0, 0, 0}, extents = {2, 200, 2, 0};
    switch (kind) {
      case SpaceKind::simple:
        space_ = dSimpleSpaceCreate(nullptr);
        break;
      case SpaceKind::hash:
        space_ = dHashSpaceCreate(nullptr);
        break;
      case SpaceKind::sap:
        space_ = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
        break;
      case SpaceKind::quadtree:
        space_ = dQuadTreeSpaceCreate(nullptr, center, extents, 4);
        break;
    }
    others_ = dSimpleSpaceCreate(nullptr);
    for (int k = 0; k < kGeoms; ++k) {
      geoms_.push_back(k % 5 == 0 ? dCreateBox(space_, 0.8, 0.8, 0.8) : dCreateSphere(space_, 0.4));
      place(k, 0);
    }
    for (int k = 0; k < 6; ++k) {
      geoms_.push_back(dCreateSphere(others_, 3));
      place(kGeoms + k, 30.0 * k - 0.6 * (kGeoms + k));
    }
    for (std::size_t k = 0; k < geoms_.size(); ++k) {
      dGeomSetData(geoms_[k], reinterpret_cast<void*>(k));
    }
  }
  ~Scenery() {
    dSpaceDestroy(others_);
    dSpaceDestroy(space_);
  }
  Scenery(const Scenery&) = delete;
  Scenery& operator=(const Scenery&) = delete;

  /// No two at the same x: among equal bounds the order of a SAP space hangs on all calls before,
  /// and libode does not know of those that it was not asked.
  void place(int k, double by) {
    dGeomSetPosition(geoms_[static_cast<std::size_t>(k)], 0.1 * (k % 3) + 1e-4 * k, 0.6 * k + by,
                     0);
  }
  void move_some(int step) {
    for (int k = 3; k < kGeoms; k += 31) place(k, 0.05 * step);
  }
  void collide() { ode_.space_collide(space_, this, &near); }
  void scan() {
    for (int k = 0; k < 3; ++k)
      ode_.space_collide2(as_geom(space_), geoms_[kGeoms + k], this, &near);
  }
  void scan_spaces() { ode_.space_collide2(as_geom(others_), as_geom(space_), this, &near); }
  /// From now on callbacks disable a geom now and then, and enable it again.
  void toggle() { toggles_ = true; }

  [[nodiscard]] std::vector<std::uint64_t> events() const {
    return {events_.begin(), events_.begin() + static_cast<std::ptrdiff_t>(count_)};
  }
  [[nodiscard]] SpaceKind kind() const { return kind_; }

 private:
  static dGeomID as_geom(dSpaceID space) { return reinterpret_cast<dGeomID>(space); }
  static void near(void* scenery, dGeomID o1, dGeomID o2) {
    static_cast<Scenery*>(scenery)->on_near(o1, o2);
  }
  void on_near(dGeomID o1, dGeomID o2) {
    const auto first = reinterpret_cast<std::uintptr_t>(dGeomGetData(o1));
    const auto second = reinterpret_cast<std::uintptr_t>(dGeomGetData(o2));
    dContactGeom contacts[4];
    const int found = ode_.collide(o1, o2, 4, contacts, sizeof(dContactGeom));
    note(first << 32 | second << 8 | static_cast<std::uint64_t>(found));
    if (!toggles_) return;
    if (count_ % 16 == 5) ode_.geom_disable(geoms_[(first + 9) % kGeoms]);
    if (count_ % 16 == 12) ode_.geom_enable(geoms_[(first + 9) % kGeoms]);
  }
  void note(std::uint64_t event) {
    if (count_ < events_.size()) events_[count_++] = event;
  }

  const StockOde& ode_;
  const SpaceKind kind_;
  dSpaceID space_ = nullptr, others_ = nullptr;
  std::vector<dGeomID> geoms_;
  bool toggles_ = false;
  std::size_t count_ = 0;
  std::vector<std::uint64_t> events_ = std::vector<std::uint64_t>(kMostEvents);
};

/// What is done before, and the call one of whose allocations fails.
struct Case {
  const char* name;
  std::function<void(Scenery&)> before, call;
};

std::ostream& operator<<(std::ostream& out, const Case& a_case) {
  return out << a_case.name;
}

std::vector<Case> cases() {
  const auto nothing = [](Scenery&) {};
  const auto collide = [](Scenery& s) { s.collide(); };
  const auto twice = [](Scenery& s) {
    s.collide();
    s.collide();
  };
  const auto collide_and_move = [](Scenery& s) {
    s.collide();
    s.collide();
    s.move_some(1);
  };
  return {
      {"first call", nothing, collide},
      {"few have moved", collide_and_move, collide},
      {"nothing has moved", twice, collide},
      {"callbacks toggle", [](Scenery& s) { s.toggle(); }, collide},
      {"scan", nothing, [](Scenery& s) { s.scan(); }},
      {"scan after a move", collide_and_move, [](Scenery& s) { s.scan(); }},
      {"two spaces", nothing, [](Scenery& s) { s.scan_spaces(); }},
      {"two spaces, callbacks toggle", [](Scenery& s) { s.toggle(); },
       [](Scenery& s) { s.scan_spaces(); }},
      {"moves", twice,
       [](Scenery& s) {
         s.move_some(2);
         s.collide();
       }},
  };
}

/// Goes on for two more frames, in which nothing fails.
void go_on(Scenery& scenery) {
  for (int step = 3; step < 5; ++step) {
    scenery.collide();
    scenery.move_some(step);
    scenery.scan();
    scenery.scan_spaces();
  }
}

std::vector<std::uint64_t> stock_events(const Case& a_case, SpaceKind kind) {
  Scenery stock(stock_ode(), kind);
  a_case.before(stock);
  a_case.call(stock);
  go_on(stock);
  return stock.events();
}

/// Returns how many allocations there were to fail.
int fail_each(const Case& a_case, SpaceKind kind) {
  const std::vector<std::uint64_t> expected = stock_events(a_case, kind);
  EXPECT_GT(expected.size(), 100U);
  for (int n = 0;; ++n) {
    Scenery ours(linked_ode(), kind);
    a_case.before(ours);
    fail_allocation(n);
    a_case.call(ours);
    const bool failed = allocation_has_failed();
    go_on(ours);
    EXPECT_EQ(ours.events(), expected) << a_case << ", allocation " << n;
    if (!failed || ours.events() != expected) return n;
  }
}

void fail_all(SpaceKind kind) {
  int allocations = 0;
  for (const Case& a_case : cases()) {
    // A hash space that is handed over allocates memory of its own.
    const bool stock_allocates = kind == SpaceKind::hash && a_case.name == cases()[3].name;
    if (!stock_allocates) allocations += fail_each(a_case, kind);
  }
  EXPECT_GT(allocations, 20);
}

TEST(OdeOutOfMemory, SimpleSpaces) {
  fail_all(SpaceKind::simple);
}
TEST(OdeOutOfMemory, HashSpaces) {
  fail_all(SpaceKind::hash);
}
TEST(OdeOutOfMemory, SapSpaces) {
  fail_all(SpaceKind::sap);
}
TEST(OdeOutOfMemory, QuadtreeSpaces) {
  fail_all(SpaceKind::quadtree);
}

class Ode : public ::testing::Environment {
 public:
  void SetUp() override {
    ::setenv("HARPOON_MIN_GEOMS", "2", 1);
    dInitODE2(0);
    // The engine is made at the first call.
    Scenery first(linked_ode(), SpaceKind::hash);
    first.collide();
  }
  void TearDown() override { dCloseODE(); }
};
const ::testing::Environment* const kOde = ::testing::AddGlobalTestEnvironment(new Ode);

}  // namespace
}  // namespace harpoon::test
