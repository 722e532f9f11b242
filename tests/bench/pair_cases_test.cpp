#include "bench/pair_cases.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/algorithm1.hpp"
#include "bench/indexed_scene.hpp"

namespace harpoon::bench {
namespace {

constexpr std::uint64_t kSeed = 20;

template <class Real>
void expect_every_case() {
  int flows[4] = {};
  int close_calls = 0;
  int non_finite = 0;
  for (const SpherePairOf<Real>& pair : hard_pairs<Real>(kSeed, 8000, false)) {
    const ContactOf<Real> contact = algorithm1(pair);
    ++flows[static_cast<int>(contact.flow())];
    const Real sum = pair.s1.r + pair.s2.r;
    close_calls += contact.flow() == Flow::real && std::abs(contact.depth) <= sum * Real(1e-6);
    non_finite += std::isfinite(pair.s1.x + pair.s2.x) ? 0 : 1;
  }
  EXPECT_GT(flows[static_cast<int>(Flow::fake)], 1000);
  EXPECT_GT(flows[static_cast<int>(Flow::grazing)], 1000);
  EXPECT_GT(flows[static_cast<int>(Flow::real)], 1000);
  EXPECT_GT(close_calls, 200);
  EXPECT_GT(non_finite, 200);
}

TEST(HardPairs, ReachEveryFlowAndEveryKindInBothPrecisions) {
  expect_every_case<float>();
  expect_every_case<double>();
}

TEST(HardPairs, FinitePairsSuitAnOracleThatRefusesTheRest) {
  for (const SpherePairF64& pair : hard_pairs<double>(kSeed, 8000, true)) {
    for (const SphereF64& s : {pair.s1, pair.s2}) {
      ASSERT_TRUE(std::isfinite(s.x) && std::isfinite(s.y) && std::isfinite(s.z));
      ASSERT_TRUE(std::isfinite(s.r) && s.r >= 0);
    }
  }
}

TEST(HardPairs, SameSeedSamePairs) {
  const auto a = hard_pairs<float>(kSeed, 100, true);
  const auto b = hard_pairs<float>(kSeed, 100, true);
  const auto c = hard_pairs<float>(kSeed + 1, 100, true);
  EXPECT_EQ(a[42].s1.x, b[42].s1.x);
  EXPECT_NE(a[42].s1.x, c[42].s1.x);
}

TEST(IndexedScene, EveryPairIsOfTheType) {
  EXPECT_EQ(make_indexed_scene(PairType::real, 1000, 5000, kSeed).hit_share, 1);
  EXPECT_EQ(make_indexed_scene(PairType::grazing, 1000, 5000, kSeed).hit_share, 1);
  EXPECT_EQ(make_indexed_scene(PairType::fake, 1000, 5000, kSeed).hit_share, 0);
  EXPECT_NEAR(make_indexed_scene(PairType::mixed, 1000, 5000, kSeed).hit_share, 0.5, 0.05);
}

TEST(IndexedScene, PairsAreOfTwoSpheresThatExist) {
  const IndexedScene scene = make_indexed_scene(PairType::mixed, 3, 1000, kSeed);
  for (const IndexPair& pair : scene.pairs) {
    ASSERT_NE(pair.g1, pair.g2);
    ASSERT_LT(pair.g1, 3U);
    ASSERT_LT(pair.g2, 3U);
  }
  EXPECT_EQ(convert<float>(scene.spheres).size(), 3U);
}

}  // namespace
}  // namespace harpoon::bench
