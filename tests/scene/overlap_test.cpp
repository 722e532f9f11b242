// overlap_pairs against all pairs of boxes compared in the caller's numbers.

#include <gtest/gtest.h>

#include <numeric>
#include <string>

#include "harpoon/scene.hpp"
#include "scene/brute_force.hpp"
#include "scene/worlds.hpp"

namespace harpoon::testing {
namespace {

constexpr std::uint64_t kSeed = 20251122;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kScenesOfWorld = 3;  // unoptimised kernels are slow; the release run has them all
constexpr int kManyBoxes = 700;
const std::vector<std::string> kSomeSets = {""};
#else
constexpr int kScenesOfWorld = 130;  // x 8 worlds x 2 precisions > 2,000
constexpr int kManyBoxes = 9000;
const std::vector<std::string> kSomeSets = cpu_instruction_sets();
#endif

Workspace workspace(unsigned threads, const std::string& instruction_set = {}) {
  auto made = Workspace::make({.threads = threads, .instruction_set = instruction_set});
  EXPECT_TRUE(made.ok());
  return std::move(made.value());
}

template <class Real>
BoundsOf<Real> view(const std::vector<Box<Real>>& boxes) {
  return {boxes.empty() ? nullptr : boxes[0].data(), boxes.size()};
}

template <class Real>
std::vector<IndexPair> run(Workspace& workspace, const BoundsOf<Real>& boxes, std::size_t capacity,
                           ContactOrder order = ContactOrder::space) {
  std::vector<IndexPair> out(capacity);
  const auto report = overlap_pairs(workspace, boxes, std::span(out), order);
  EXPECT_TRUE(report.ok()) << report.error().message;
  if (!report.ok()) return {};
  out.resize(report->contacts);
  return out;
}

bool same(const std::vector<IndexPair>& a, const std::vector<IndexPair>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](IndexPair x, IndexPair y) { return x.g1 == y.g1 && x.g2 == y.g2; });
}

template <class Real>
class OverlapTest : public ::testing::Test {};
using Reals = ::testing::Types<float, double>;
TYPED_TEST_SUITE(OverlapTest, Reals);

TYPED_TEST(OverlapTest, EqualsAllPairsInEveryWorld) {
  using Real = TypeParam;
  std::vector<Workspace> workspaces;
  for (const std::string& name : cpu_instruction_sets()) {
    workspaces.push_back(workspace(1, name));
  }
  std::array<int, kBoxKinds> seen = {};
  std::size_t turn = 0;
  for (const World world : kWorlds) {
    std::uint64_t pairs = 0;
    for (int scene = 0; scene < kScenesOfWorld; ++scene) {
      const std::uint64_t seed =
          kSeed + static_cast<std::uint64_t>(scene) * 8 + static_cast<std::uint64_t>(world);
      Dice dice(seed);
      // The smallest worlds have no grid.
      const int count = dice.one_in(4) ? dice.integer(0, 130) : dice.integer(150, 700);
      const auto spheres = WorldMaker<Real>(seed).make(world, count);
      const int odd = dice.one_in(3) ? 0 : dice.integer(1, 60);
      const auto boxes = boxes_around(spheres, seed + 1, odd, seen);
      const auto expected = overlapping(boxes);
      pairs += expected.size();
      Workspace& means = workspaces[turn++ % workspaces.size()];
      const auto got = run(means, view(boxes), expected.size());
      ASSERT_TRUE(same(sorted_by_ids(got), expected))
          << "world " << static_cast<int>(world) << " seed " << seed << " boxes " << boxes.size()
          << " expected " << expected.size() << " got " << got.size();
    }
    EXPECT_GT(pairs, 8U * kScenesOfWorld) << "world " << static_cast<int>(world) << " is vacuous";
  }
  for (const int count : seen) EXPECT_GT(count, kScenesOfWorld);
}

TYPED_TEST(OverlapTest, OneResultForThreadsInstructionSetsAndStrides) {
  using Real = TypeParam;
  std::array<int, kBoxKinds> seen = {};
  for (const World world : kWorlds) {
    const auto spheres = WorldMaker<Real>(kSeed + 7).make(
        world, world == World::point ? kManyBoxes / 12 : kManyBoxes);
    const auto boxes = boxes_around(spheres, kSeed, 5, seen);
    const std::size_t room = overlapping(boxes).size() + 5;
    Workspace first = workspace(1);
    const auto expected = run(first, view(boxes), room);
    EXPECT_EQ(expected.size() + 5, room);
    for (const unsigned threads : {1U, 2U, 3U, 8U}) {
      for (const std::string& name : kSomeSets) {
        Workspace means = workspace(threads, name);
        EXPECT_TRUE(same(run(means, view(boxes), room), expected))
            << "world " << static_cast<int>(world) << " threads " << threads << " " << name;
      }
    }
    struct Geom {
      double tag;
      Box<Real> box;
      int mark;
    };
    std::vector<Geom> geoms;
    for (const auto& b : boxes) geoms.push_back({1, b, 2});
    const BoundsOf<Real> strided(geoms[0].box.data(), geoms.size(), sizeof(Geom));
    EXPECT_TRUE(same(run(first, strided, room), expected));
    EXPECT_TRUE(same(run(first, view(boxes), room, ContactOrder::ids), sorted_by_ids(expected)));
  }
}

TYPED_TEST(OverlapTest, FiltersAsForContacts) {
  using Real = TypeParam;
  std::array<int, kBoxKinds> seen = {};
  for (std::size_t scene = 0; scene < 12; ++scene) {
    const auto spheres = WorldMaker<Real>(kSeed).make(kWorlds[scene % kWorlds.size()], 500);
    const auto boxes = boxes_around(spheres, kSeed, 10, seen);
    Dice dice(kSeed + scene);
    std::vector<std::uint32_t> category, collide, owner;
    std::vector<Rest> rest;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      category.push_back(static_cast<std::uint32_t>(dice.integer(0, 7)));
      collide.push_back(static_cast<std::uint32_t>(dice.integer(0, 7)));
      owner.push_back(static_cast<std::uint32_t>(dice.integer(0, 9)));
      rest.push_back(static_cast<Rest>(dice.integer(0, 2)));
    }
    auto bounds = view(boxes);
    if (scene % 2 == 0) {
      bounds.filters.category = category;
      bounds.filters.collide = collide;
    }
    if (scene % 3 == 0) bounds.filters.owner = owner;
    if (scene % 4 < 2) bounds.filters.rest = rest;
    const auto expected = overlapping(boxes, bounds.filters);
    EXPECT_FALSE(expected.empty());
    Workspace means = workspace(1);
    EXPECT_TRUE(same(sorted_by_ids(run(means, bounds, expected.size())), expected));
  }
}

TYPED_TEST(OverlapTest, ReportsInvalidBoxes) {
  using Real = TypeParam;
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  std::vector<Box<Real>> boxes(100, Box<Real>{0, 1, 0, 1, 0, 1});
  std::vector<std::uint32_t> excluded;
  for (std::size_t k = 0; k < 6; ++k) {
    boxes[7 * k + 3][k] = nan;
    boxes[7 * k + 5][k] = k % 2 == 0 ? Real(2) : Real(-1);
    excluded.push_back(static_cast<std::uint32_t>(7 * k + 3));
    excluded.push_back(static_cast<std::uint32_t>(7 * k + 5));
  }
  Workspace means = workspace(1);
  const auto expected = overlapping(boxes);
  EXPECT_EQ(expected.size(), 88U * 87U / 2);
  std::vector<IndexPair> out(expected.size());
  const auto report = overlap_pairs(means, view(boxes), std::span(out));
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->excluded, excluded);
  EXPECT_TRUE(same(sorted_by_ids(out), expected));
}

/// What an ODE program holds: many bodies, a plane, a ground box and some far away.
TYPED_TEST(OverlapTest, PlanesAndGroundsDoNotSpoilTheGrid) {
  using Real = TypeParam;
  const Real infinity = std::numeric_limits<Real>::infinity();
  std::array<int, kBoxKinds> seen = {};
  const auto spheres = WorldMaker<Real>(kSeed).make(World::packed, kManyBoxes);
  auto boxes = boxes_around(spheres, kSeed, 0, seen);
  Workspace means = workspace(1);
  std::vector<IndexPair> out(200000);
  const auto alone = overlap_pairs(means, view(boxes), std::span(out));
  ASSERT_TRUE(alone.ok());
  boxes.push_back({-infinity, infinity, -infinity, infinity, -infinity, 0});
  boxes.push_back({-10000, 10000, -10000, 10000, -100, 0});
  boxes.push_back({-infinity, infinity, -infinity, infinity, -infinity, infinity});
  boxes.push_back({Real(1e12), Real(1e12), 0, 1, 0, 1});
  const auto report = overlap_pairs(means, view(boxes), std::span(out));
  ASSERT_TRUE(report.ok());
  EXPECT_TRUE(report->excluded.empty());
  EXPECT_GT(report->contacts, alone->contacts + kManyBoxes);
  EXPECT_LT(report->tests, alone->tests + 6 * boxes.size());
}

/// Boxes of side 1 on average, about ten to every one's neighbourhood, but long along some axes:
/// infinite to one side or both, nowhere but at infinity, or much longer than the world is wide.
template <class Real>
std::vector<Box<Real>> long_boxes(std::array<bool, 3> is_long, bool infinite, int count,
                                  std::uint64_t seed) {
  const Real infinity = std::numeric_limits<Real>::infinity();
  Dice dice(seed);
  int axes = 3;
  for (const bool l : is_long) axes -= l ? 1 : 0;
  const double width = axes == 2 ? std::sqrt(count) : count;
  std::vector<Box<Real>> boxes;
  for (int i = 0; i < count; ++i) {
    Box<Real> b;
    const bool ordinary = dice.one_in(50);
    const int ends = dice.integer(0, 9);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double low = dice.uniform(0, width);
      b[2 * axis] = static_cast<Real>(low);
      b[2 * axis + 1] = static_cast<Real>(low + dice.uniform(0, 2));
      if (!is_long[axis] || ordinary) continue;
      if (!infinite) {
        b[2 * axis] -= static_cast<Real>(dice.uniform(1e4, 1e6));
        b[2 * axis + 1] += static_cast<Real>(dice.uniform(1e4, 1e6));
      } else {
        if (ends != 1) b[2 * axis] = ends == 2 ? infinity : -infinity;
        if (ends != 0) b[2 * axis + 1] = ends == 3 ? -infinity : infinity;
      }
    }
    boxes.push_back(b);
  }
  return boxes;
}

TYPED_TEST(OverlapTest, AxesAlongWhichAllBoxesAreLongAreLeftOutOfTheGrid) {
  using Real = TypeParam;
  for (unsigned axes = 1; axes < 7; ++axes) {
    const std::array<bool, 3> is_long = {(axes & 1) != 0, (axes & 2) != 0, (axes & 4) != 0};
    for (const bool infinite : {false, true}) {
      const auto boxes = long_boxes<Real>(is_long, infinite, kManyBoxes / 4, kSeed + axes);
      const auto expected = overlapping(boxes);
      EXPECT_GT(expected.size(), boxes.size() / 2);
      for (const unsigned threads : {1U, 3U}) {
        Workspace means = workspace(threads);
        std::vector<IndexPair> out(expected.size());
        const auto report = overlap_pairs(means, view(boxes), std::span(out));
        ASSERT_TRUE(report.ok()) << report.error().message;
        EXPECT_TRUE(same(sorted_by_ids(out), expected)) << "axes " << axes << " " << infinite;
        EXPECT_LT(report->tests, 60 * boxes.size()) << "axes " << axes << " infinite " << infinite;
      }
    }
  }
}

TYPED_TEST(OverlapTest, TouchingIsOverlapAndAnUlpApartIsNot) {
  using Real = TypeParam;
  // Far from the middle of the world, where the search's own numbers cannot tell.
  const Real at = sizeof(Real) == 4 ? Real(1024) : Real(1024) + Real(0x1p-40);
  const Real infinity = std::numeric_limits<Real>::infinity();
  std::vector<Box<Real>> boxes;
  for (int k = 0; k < 200; ++k) {
    const Real low = static_cast<Real>(20 * k) + at;
    boxes.push_back({low - 1, low, 0, 1, 0, 1});
    boxes.push_back({k % 2 == 0 ? low : std::nextafter(low, infinity), low + 1, 0, 1, 0, 1});
  }
  Workspace means = workspace(1);
  const auto got = run(means, view(boxes), 1000);
  EXPECT_EQ(got.size(), 100U);
  EXPECT_TRUE(same(sorted_by_ids(got), overlapping(boxes)));
}

TYPED_TEST(OverlapTest, TooSmallAnOutputIsUntouchedAndTheNeedExact) {
  using Real = TypeParam;
  std::array<int, kBoxKinds> seen = {};
  for (const World world : {World::packed, World::point, World::mixed}) {
    const auto spheres =
        WorldMaker<Real>(kSeed).make(world, world == World::point ? kManyBoxes / 8 : kManyBoxes);
    const auto boxes = boxes_around(spheres, kSeed, 3, seen);
    const std::size_t needed = overlapping(boxes).size();
    for (const unsigned threads : {1U, 2U}) {
      Workspace means = workspace(threads);
      for (const std::size_t capacity : {std::size_t{0}, needed / 2, needed - 1}) {
        std::vector<IndexPair> out(capacity, IndexPair{7, 9});
        const auto report = overlap_pairs(means, view(boxes), std::span(out));
        ASSERT_FALSE(report.ok());
        EXPECT_EQ(report.error().code, Errc::capacity);
        EXPECT_EQ(report.error().needed, needed);
        EXPECT_TRUE(std::all_of(out.begin(), out.end(),
                                [](IndexPair p) { return p.g1 == 7 && p.g2 == 9; }));
      }
      EXPECT_EQ(run(means, view(boxes), needed).size(), needed);
    }
  }
}

TYPED_TEST(OverlapTest, RejectsBadArguments) {
  using Real = TypeParam;
  Workspace means = workspace(1);
  const std::vector<Box<Real>> boxes(3, Box<Real>{0, 1, 0, 1, 0, 1});
  std::vector<IndexPair> out(9);
  const BoundsOf<Real> null_array(nullptr, 3);
  const BoundsOf<Real> odd_stride(boxes[0].data(), 3, sizeof boxes[0] + 1);
  BoundsOf<Real> short_filter = view(boxes);
  const std::vector<std::uint32_t> owners(2, 1);
  short_filter.filters.owner = owners;
  for (const auto& bad : {null_array, odd_stride, short_filter}) {
    const auto report = overlap_pairs(means, bad, std::span(out));
    ASSERT_FALSE(report.ok());
    EXPECT_EQ(report.error().code, Errc::invalid_argument);
  }
  const BoundsOf<Real> too_many(boxes[0].data(), kMaxBodies + 1);
  EXPECT_EQ(overlap_pairs(means, too_many, std::span(out)).error().code, Errc::batch_too_large);
  EXPECT_EQ(run(means, BoundsOf<Real>(), 4).size(), 0U);
}

}  // namespace
}  // namespace harpoon::testing
