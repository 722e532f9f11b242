// What a search costs, in pairs tested, over worlds that spoil broad phases: bodies far away, huge
// and tiny among usual ones, and worlds without a scale. A time would say less and fail by chance.

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>

#include "harpoon/scene.hpp"
#include "scene/brute_force.hpp"
#include "scene/odd_worlds.hpp"

namespace harpoon::testing {
namespace {

constexpr std::uint64_t kSeed = 424242;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kMany = 3000;  // unoptimised kernels are slow
constexpr int kFew = 700;
constexpr std::array kCounts = {1, 33};
#else
constexpr int kMany = 8000;  // all pairs are 4,000 tests a body
constexpr int kFew = 500;
constexpr std::array kCounts = {1, 33, 1000};
#endif
/// Tests for each body of any world, and for each contact.
constexpr std::uint64_t kTestsPerBody = 512;
constexpr std::uint64_t kTestsPerContact = 8;
/// Tests for each body of a usual world with strays that touch nothing.
constexpr std::uint64_t kTestsWithStrays = 80;

template <class Real>
std::span<const SphereOf<Real>> view(const std::vector<SphereOf<Real>>& spheres) {
  return spheres;
}

template <class Real>
BoundsOf<Real> view(const std::vector<Box<Real>>& boxes) {
  return {boxes[0].data(), boxes.size()};
}

struct World {
  std::string name;
  bool usual;  ///< but for strays that touch hardly anything
};

template <class Real>
class CostTest : public ::testing::Test {
 protected:
  using Spheres = std::vector<SphereOf<Real>>;

  void SetUp() override {
    auto made = Workspace::make({.threads = 1});
    ASSERT_TRUE(made.ok());
    workspace_ = std::make_unique<Workspace>(std::move(made.value()));
  }

  /// Calls visit(world, spheres) for all of them, of about so many bodies.
  template <class Visit>
  static void each_world(int bodies, const Visit& visit) {
    std::uint64_t seed = kSeed;
    for (const bool packed : {false, true}) {
      for (const Strays strays : kStrays) {
        for (const int count : kCounts) {
          OddWorldMaker<Real> maker(++seed);
          Spheres spheres = maker.usual(bodies, packed);
          const double distance = std::pow(10.0, 3 + 12 * static_cast<double>(seed % 7) / 6);
          const int added = std::min(count, bodies / 20);
          maker.add(spheres, strays, strays == Strays::none ? 0 : added, distance);
          const bool usual = strays != Strays::sizes && strays != Strays::beside;
          visit(World{std::string(packed ? "packed" : "gas") + " strays " +
                          std::to_string(static_cast<int>(strays)) + " count " +
                          std::to_string(added) + " distance " + std::to_string(distance) +
                          " seed " + std::to_string(seed),
                      usual},
                spheres);
        }
      }
    }
    for (const OddWorld odd : kOddWorlds) {
      ++seed;
      const std::string name =
          "odd world " + std::to_string(static_cast<int>(odd)) + " seed " + std::to_string(seed);
      visit(World{name, false}, OddWorldMaker<Real>(seed).make(odd, bodies));
    }
  }

  static std::uint64_t most_tests(const World& world, std::size_t bodies, std::uint64_t contacts) {
    return (world.usual ? kTestsWithStrays : kTestsPerBody) * bodies + kTestsPerContact * contacts;
  }

  std::unique_ptr<Workspace> workspace_;
};
using Reals = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CostTest, Reals);

TYPED_TEST(CostTest, SpheresOfAnyWorldTakeFewTests) {
  using Real = TypeParam;
  this->each_world(kMany, [&](const World& world, const std::vector<SphereOf<Real>>& spheres) {
    const auto report = count_contacts(*this->workspace_, BodiesOf<Real>(view(spheres)));
    ASSERT_TRUE(report.ok()) << world.name;
    EXPECT_LE(report->tests, this->most_tests(world, spheres.size(), report->contacts))
        << world.name << ": " << report->tests / spheres.size() << " tests a body, "
        << report->contacts << " contacts";
  });
}

TYPED_TEST(CostTest, BoxesOfAnyWorldTakeFewTests) {
  using Real = TypeParam;
  this->each_world(kMany, [&](const World& world, const std::vector<SphereOf<Real>>& spheres) {
    const auto boxes = bounds_of(spheres);
    // Far from the origin in float, a body's bounds are points or those of many others.
    const auto report = overlap_pairs(*this->workspace_, view(boxes), std::span<IndexPair>());
    const std::uint64_t pairs = report.ok() ? report->contacts : report.error().needed;
    if (report.ok()) {
      EXPECT_LE(report->tests, this->most_tests(world, boxes.size(), pairs)) << world.name;
      return;
    }
    if (pairs > 40 * boxes.size()) return;  // nothing to save
    std::vector<IndexPair> out(pairs);
    const auto again = overlap_pairs(*this->workspace_, view(boxes), std::span(out));
    ASSERT_TRUE(again.ok()) << world.name;
    EXPECT_LE(again->tests, this->most_tests(world, boxes.size(), pairs))
        << world.name << ": " << again->tests / boxes.size() << " tests a box, " << pairs
        << " pairs";
  });
}

TYPED_TEST(CostTest, FramesOfAnyWorldTakeFewTests) {
  using Real = TypeParam;
  this->each_world(kMany, [&](const World& world, std::vector<SphereOf<Real>> spheres) {
    auto scene = SceneOf<Real>::make({.threads = 1});
    ASSERT_TRUE(scene.ok());
    for (int frame = 0; frame < 2; ++frame) {
      ASSERT_FALSE(scene->set_bodies(BodiesOf<Real>(view(spheres))));
      const auto found = scene->detect();
      ASSERT_TRUE(found.ok()) << world.name;
      // A search with a margin may be begun and given up before the one that counts.
      EXPECT_LE(found->tests, 2 * this->most_tests(world, spheres.size(), found->contacts.size()))
          << world.name << " frame " << frame;
      for (auto& s : spheres) s.x += s.r / 64;
    }
  });
}

TYPED_TEST(CostTest, OddWorldsEqualBruteForce) {
  using Real = TypeParam;
  std::uint64_t contacts = 0;
  this->each_world(kFew, [&](const World& world, const std::vector<SphereOf<Real>>& spheres) {
    const auto expected = brute_force(view(spheres));
    contacts += expected.size();
    std::vector<BodyContactOf<Real>> out(expected.size());
    const auto report = detect(*this->workspace_, BodiesOf<Real>(view(spheres)), std::span(out));
    ASSERT_TRUE(report.ok()) << world.name << ": " << report.error().message;
    ASSERT_TRUE(same_bits(sorted_by_ids(out), expected)) << world.name;
    const auto boxes = bounds_of(spheres);
    const auto overlaps = overlapping(boxes);
    std::vector<IndexPair> pairs(overlaps.size());
    const auto found = overlap_pairs(*this->workspace_, view(boxes), std::span(pairs));
    ASSERT_TRUE(found.ok()) << world.name << ": " << found.error().message;
    pairs = sorted_by_ids(pairs);
    ASSERT_TRUE(std::equal(pairs.begin(), pairs.end(), overlaps.begin(), overlaps.end(),
                           [](IndexPair a, IndexPair b) { return a.g1 == b.g1 && a.g2 == b.g2; }))
        << world.name;
  });
  EXPECT_GT(contacts, 10000U);
}

// Bodies of two sizes that touch far beyond the world, each pair beside it along two axes: there
// the larger one is looked for where it is, however coarse float is along the third.
TYPED_TEST(CostTest, PairsFarAwayAreFoundBesideTheWorld) {
  using Real = TypeParam;
  for (const double far : {1e5, 1e9, 1e12}) {
    Dice dice(kSeed);
    std::vector<SphereOf<Real>> spheres;
    const auto at = [&] { return dice.uniform(0, 60); };
    for (int k = 0; k < 2000; ++k) {
      spheres.push_back(sphere<Real>(at(), at(), at(), k % 20 == 0 ? 3 : 0.3));
    }
    for (int k = 0; k < 60; ++k) {
      std::array<double, 3> p = {at(), at(), at()};
      p[static_cast<std::size_t>(k) % 3] = k % 2 == 0 ? far : -far;
      spheres.push_back(sphere<Real>(p[0], p[1], p[2], 3));
      spheres.push_back(sphere<Real>(p[0] + 0.2, p[1] + 1, p[2] - 0.5, 0.3));
    }
    const auto expected = brute_force(view(spheres));
    std::vector<BodyContactOf<Real>> out(expected.size());
    const auto report = detect(*this->workspace_, BodiesOf<Real>(view(spheres)), std::span(out));
    ASSERT_TRUE(report.ok()) << report.error().message;
    EXPECT_TRUE(same_bits(sorted_by_ids(out), expected)) << far;
  }
}

// A settled bed and one body that fell off the table and never stopped, at any distance.
TYPED_TEST(CostTest, ABodyFarAwayCostsNothing) {
  using Real = TypeParam;
  const double farthest = sizeof(Real) == 4 ? 1e18 : 1e150;
  OddWorldMaker<Real> maker(kSeed);
  auto spheres = maker.usual(kMany, false);
  const auto alone = count_contacts(*this->workspace_, BodiesOf<Real>(view(spheres)));
  ASSERT_TRUE(alone.ok());
  spheres.push_back({3, 3, 0, Real(0.5)});
  for (double distance = 1e3; distance <= farthest; distance *= 1e3) {
    spheres.back().z = static_cast<Real>(-distance);
    const auto report = count_contacts(*this->workspace_, BodiesOf<Real>(view(spheres)));
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report->contacts, alone->contacts) << distance;
    EXPECT_LE(report->tests, 2 * alone->tests + 2 * spheres.size()) << distance;
  }
}

// Grains and one larger sphere of any size whose surface is at any distance.
TYPED_TEST(CostTest, AMoonOfAnySizeCostsFewTests) {
  using Real = TypeParam;
  OddWorldMaker<Real> maker(kSeed);
  auto spheres = maker.usual(kMany, false);
  const auto alone = count_contacts(*this->workspace_, BodiesOf<Real>(view(spheres)));
  ASSERT_TRUE(alone.ok());
  const double side = std::cbrt(kMany * 10.5);
  spheres.emplace_back();
  for (double radius = 0.5; radius < 1e6; radius *= 10) {
    for (double distance = 1e2; distance < 1e9; distance *= 10) {
      spheres.back() = sphere<Real>(side + distance + radius, 1, 2, radius);
      const auto report = count_contacts(*this->workspace_, BodiesOf<Real>(view(spheres)));
      ASSERT_TRUE(report.ok());
      EXPECT_EQ(report->contacts, alone->contacts) << radius << " at " << distance;
      EXPECT_LE(report->tests, 4 * alone->tests + 3 * spheres.size())
          << radius << " at " << distance;
    }
  }
}

// Rods and plates with sides 1 to 100, in all directions.
TYPED_TEST(CostTest, LongBoxesTakeFewTests) {
  using Real = TypeParam;
  for (const int directions : {1, 3}) {
    for (const bool plates : {false, true}) {
      Dice dice(kSeed);
      std::vector<Box<Real>> boxes;
      const double side = (plates ? 40 : 25) * std::cbrt(kMany);
      for (int k = 0; k < kMany; ++k) {
        const int axis = dice.integer(0, directions - 1);
        Box<Real> box;
        for (std::size_t a = 0; a < 3; ++a) {
          const double low = dice.uniform(0, side);
          const bool is_long = (static_cast<int>(a) == axis) != plates;
          box[2 * a] = static_cast<Real>(low);
          box[2 * a + 1] = static_cast<Real>(low + (is_long ? 100 : 1));
        }
        boxes.push_back(box);
      }
      std::vector<IndexPair> out(std::size_t{kMany} * 200);
      const auto report = overlap_pairs(*this->workspace_, view(boxes), std::span(out));
      ASSERT_TRUE(report.ok()) << report.error().message;
      EXPECT_LE(report->tests, 700 * boxes.size() + 8 * report->contacts)
          << "directions " << directions << " plates " << plates << " tests "
          << report->tests / boxes.size() << " pairs " << report->contacts / boxes.size();
    }
  }
}

}  // namespace
}  // namespace harpoon::testing
