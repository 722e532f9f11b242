// The engine on libode's functions by hand, without interposition: what the order rules do where
// stock fails, and what the policies choose.

#include "ode/engine.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <ode/ode.h>

#include <algorithm>
#include <iostream>
#include <limits>

#include "support/random.hpp"

namespace harpoon::ode {
namespace {

using Pairs = std::vector<std::pair<dGeomID, dGeomID>>;

void note(void* pairs, dGeomID o1, dGeomID o2) {
  static_cast<Pairs*>(pairs)->emplace_back(o1, o2);
}

/// Without the order of calls and arguments.
Pairs as_set(Pairs pairs) {
  for (auto& [o1, o2] : pairs) {
    if (o2 < o1) std::swap(o1, o2);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

LibodeOf<double> linked_libode() {
  LibodeOf<double> ode;
  std::string_view missing;
  const bool complete = resolve(
      ode, [](const char* name) { return dlsym(RTLD_DEFAULT, name); }, missing);
  EXPECT_TRUE(complete) << missing;
  return ode;
}

struct Fixture : ::testing::Test {
  void SetUp() override { dInitODE2(0); }
  void TearDown() override { dCloseODE(); }

  std::unique_ptr<Engine> engine(Policy policy, bool verify = false) {
    Options options;
    options.policy = policy;
    options.verify = verify;
    options.changes_are_reported = false;
    options.min_geoms_simple = options.min_geoms_hash = options.min_geoms_sap = 2;
    Result<std::unique_ptr<Device>> cpu = make_cpu_device({.threads = 1});
    EXPECT_TRUE(cpu.ok());
    auto made = make_engine<double>(
        linked_libode(),
        {.options = options,
         .device = std::move(*cpu),
         .log = [this](LogLevel, std::string_view line) { lines.emplace_back(line); },
         .differs =
             [this](const std::string& text, const CollisionFrame* frame) {
               differences.push_back(text);
               if (frame != nullptr) frames.push_back(*frame);
             }});
    EXPECT_TRUE(made.ok());
    return std::move(*made);
  }

  static Pairs pairs_of(Engine& engine, dSpaceID space) {
    Pairs pairs;
    engine.space_collide(space, &pairs, &note);
    return pairs;
  }
  static Pairs stock_pairs_of(dSpaceID space) {
    Pairs pairs;
    dSpaceCollide(space, &pairs, &note);
    return pairs;
  }
  static dGeomID add_box(dSpaceID space, double x, double y, double z, double size) {
    const dGeomID box = dCreateBox(space, size, size, size);
    dGeomSetPosition(box, x, y, z);
    return box;
  }

  std::vector<std::string> lines, differences;
  std::vector<CollisionFrame> frames;
};

/// Two boxes near the origin that overlap, one of which begins below z = 0 in a cell of a bucket
/// number that wraps, the other above.
TEST_F(Fixture, APairThatAHashSpaceMissesIsReportedOnlyWhenFixed) {
  const dSpaceID space = dHashSpaceCreate(nullptr);
  add_box(space, 0.45, 0.45, 0.05, 0.8);
  add_box(space, 0.45, 0.45, 0.45, 0.8);
  ASSERT_EQ(stock_pairs_of(space).size(), 0u) << "stock finds it: the test is in vain";
  const auto compat = engine(Policy::compat), fixed = engine(Policy::fixed);
  EXPECT_EQ(pairs_of(*compat, space).size(), 0u);
  EXPECT_EQ(pairs_of(*fixed, space).size(), 1u);
  EXPECT_EQ(compat->statistics().missed_by_stock.load(), 1u);
  dSpaceDestroy(space);
}

TEST_F(Fixture, MissesOfHashSpacesAreThoseOfStock) {
  constexpr std::uint64_t kSeed = 5;
  test::Random random(kSeed);
  const auto compat = engine(Policy::compat), fixed = engine(Policy::fixed);
  std::uint64_t pairs = 0;
  for (int scene = 0; scene < 3000; ++scene) {
    const dSpaceID space = dHashSpaceCreate(nullptr);
    for (int k = 0; k < 12; ++k) {
      const double size = random.between(0.3, 0.8);
      add_box(space, random.between(0.2, 0.8), random.between(0.2, 0.8), random.between(-2, 2),
              size);
    }
    const Pairs stock = stock_pairs_of(space);
    ASSERT_EQ(pairs_of(*compat, space), stock) << "seed " << kSeed << " scene " << scene;
    const Pairs all = pairs_of(*fixed, space);
    const Pairs all_set = as_set(all), stock_set = as_set(stock);
    ASSERT_TRUE(std::includes(all_set.begin(), all_set.end(), stock_set.begin(), stock_set.end()));
    pairs += all.size() - stock.size();
    dSpaceDestroy(space);
  }
  EXPECT_EQ(compat->statistics().missed_by_stock.load(), pairs);
  EXPECT_GT(pairs, 100u);
  std::cout << pairs << " pairs that stock misses\n";
}

TEST_F(Fixture, HashSpacesLiveWhereStockAborts) {
  const dSpaceID space = dHashSpaceCreate(nullptr);
  std::vector<dGeomID> near_boxes;
  for (int k = 0; k < 60; ++k) near_boxes.push_back(add_box(space, 5 + 0.3 * k, 5, 5, 1));
  const Pairs expected = stock_pairs_of(space);
  const dGeomID nan = add_box(space, std::numeric_limits<double>::quiet_NaN(), 0, 0, 1);
  const dGeomID far_box = add_box(space, 1e15, 0, 0, 1);
  const auto compat = engine(Policy::compat);
  for (int call = 0; call < 3; ++call) {
    Pairs got = pairs_of(*compat, space);
    EXPECT_EQ(as_set(got), as_set(expected));
  }
  EXPECT_EQ(lines.size(), 2u) << "one line for each geom, once";
  // A geom that overlaps the far one is found, though stock would not have lived to say so.
  const dGeomID other = add_box(space, 1e15, 0.5, 0, 1);
  Pairs more = as_set(expected);
  more.emplace_back(std::min(far_box, other), std::max(far_box, other));
  EXPECT_EQ(as_set(pairs_of(*compat, space)), as_set(more));
  dGeomDestroy(nan);
  dSpaceDestroy(space);
}

TEST_F(Fixture, StrictLeavesToStockWhatStockAbortsOn) {
  const dSpaceID space = dHashSpaceCreate(nullptr);
  for (int k = 0; k < 60; ++k) add_box(space, 5 + 0.3 * k, 5, 5, 1);
  add_box(space, 1e15, 0, 0, 1);
  const auto strict = engine(Policy::strict);
  EXPECT_DEATH(pairs_of(*strict, space), "assertion");
  dSpaceDestroy(space);
}

TEST_F(Fixture, NanInSimpleSpacesIsAsStock) {
  const dSpaceID space = dSimpleSpaceCreate(nullptr);
  for (int k = 0; k < 100; ++k) add_box(space, 0.3 * k, 0, 0, 1);
  add_box(space, std::numeric_limits<double>::quiet_NaN(), 0, 0, 1);
  add_box(space, 3, std::numeric_limits<double>::infinity(), 0, 1);
  const Pairs stock = stock_pairs_of(space);
  EXPECT_EQ(pairs_of(*engine(Policy::compat), space), stock);
  EXPECT_GT(stock.size(), 100u);
  dSpaceDestroy(space);
}

TEST_F(Fixture, SapSpacesWithNanAreAsStock) {
  const auto compat = engine(Policy::compat);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    test::Random random(seed);
    dSpaceID spaces[2];
    std::vector<dGeomID> boxes[2];
    for (int side = 0; side < 2; ++side) {
      spaces[side] = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XZY);
    }
    compat->sap_created(spaces[1], dSAP_AXES_XZY);
    for (int k = 0; k < 300; ++k) {
      const double nan = std::numeric_limits<double>::quiet_NaN();
      const double x = random.below(50) == 0 ? nan : static_cast<double>(random.below(20)) - 10;
      const double y = random.between(-2, 2),
                   z = random.below(60) == 0 ? nan : random.between(0, 3);
      for (int side = 0; side < 2; ++side) boxes[side].push_back(add_box(spaces[side], x, y, z, 1));
    }
    for (int step = 0; step < 4; ++step) {
      Pairs pairs[2] = {stock_pairs_of(spaces[0]), pairs_of(*compat, spaces[1])};
      ASSERT_EQ(pairs[0].size(), pairs[1].size()) << "seed " << seed << " step " << step;
      std::vector<std::pair<std::ptrdiff_t, std::ptrdiff_t>> numbers[2];
      for (int side = 0; side < 2; ++side) {
        const auto number = [&](dGeomID geom) {
          return std::find(boxes[side].begin(), boxes[side].end(), geom) - boxes[side].begin();
        };
        for (const auto& [o1, o2] : pairs[side]) numbers[side].emplace_back(number(o1), number(o2));
      }
      ASSERT_EQ(numbers[0], numbers[1]) << "seed " << seed << " step " << step;
      for (int k = 0; k < 30; ++k) {
        const auto moved = random.below(300);
        const double x = static_cast<double>(random.below(20)) - 10;
        for (int side = 0; side < 2; ++side) dGeomSetPosition(boxes[side][moved], x, 0, 1);
      }
    }
    for (const dSpaceID space : spaces) dSpaceDestroy(space);
  }
}

TEST_F(Fixture, HashSpacesBeyondStocksLimitHaveAllPairs) {
  constexpr int kGeoms = 140000;
  test::Random random(3);
  const dSpaceID hash = dHashSpaceCreate(nullptr);
  const dSpaceID sap = dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ);
  for (int k = 0; k < kGeoms; ++k) {
    const double x = random.between(0, 200), y = random.between(0, 60), z = random.between(0, 60);
    for (const dSpaceID space : {hash, sap}) {
      const dGeomID ball = dCreateSphere(space, 0.5);
      dGeomSetPosition(ball, x, y, z);
      dGeomSetData(ball, reinterpret_cast<void*>(static_cast<std::uintptr_t>(k)));
    }
  }
  const auto numbers = [](const Pairs& pairs) {
    std::vector<std::pair<void*, void*>> found;
    for (const auto& [o1, o2] : pairs) {
      found.push_back(std::minmax(dGeomGetData(o1), dGeomGetData(o2)));
    }
    std::sort(found.begin(), found.end());
    return found;
  };
  const Pairs ours = pairs_of(*engine(Policy::compat), hash);
  EXPECT_GT(ours.size(), 10000u);
  EXPECT_EQ(numbers(ours), numbers(stock_pairs_of(sap)));
  dSpaceDestroy(hash);
  dSpaceDestroy(sap);
}

TEST_F(Fixture, VerificationNamesTheFirstDifference) {
  const dSpaceID space = dHashSpaceCreate(nullptr);
  for (int k = 0; k < 60; ++k) add_box(space, 5 + 0.3 * k, 5, 5, 1);
  const auto honest = engine(Policy::compat, true);
  EXPECT_GT(pairs_of(*honest, space).size(), 0u);
  EXPECT_TRUE(differences.empty());
  EXPECT_GT(honest->statistics().verified_pairs.load(), 0u);

  // An engine that is not told of changes but believes it is: it must be found out.
  Options options;
  options.verify = true;
  Result<std::unique_ptr<Device>> cpu = make_cpu_device({.threads = 1});
  auto blind = make_engine<double>(
      linked_libode(), {.options = options,
                        .device = std::move(*cpu),
                        .log = {},
                        .differs = [this](const std::string& text, const CollisionFrame* frame) {
                          differences.push_back(text);
                          if (frame != nullptr) frames.push_back(*frame);
                        }});
  (void)pairs_of(**blind, space);
  EXPECT_TRUE(differences.empty());
  dGeomSetPosition(dSpaceGetGeom(space, 7), -20, 0, 0);
  (void)pairs_of(**blind, space);
  ASSERT_EQ(differences.size(), 1u);
  EXPECT_NE(differences[0].find("hash space"), std::string::npos) << differences[0];

  // What was written down gives the same sequences again.
  ASSERT_EQ(frames.size(), 1u);
  const Result<CollisionFrame> back = parse_frame(to_text(frames[0]));
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(to_text(*back), to_text(frames[0]));
  EXPECT_EQ(back->difference, differences[0]);
  const Result<std::vector<IndexPair>> again = search_again(*back);
  ASSERT_TRUE(again.ok());
  ASSERT_EQ(again->size(), back->ours.size());
  EXPECT_NE(back->ours.size(), back->stock.size());
  for (std::size_t k = 0; k < again->size(); ++k) {
    EXPECT_EQ((*again)[k].g1, back->ours[k].g1);
    EXPECT_EQ((*again)[k].g2, back->ours[k].g2);
  }
  dSpaceDestroy(space);
}

}  // namespace
}  // namespace harpoon::ode
