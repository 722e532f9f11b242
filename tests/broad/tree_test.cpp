// Trees alone, on all worlds: each body is in one leaf, every pair that touches is found once, and
// neither threads nor the order of bodies in memory change what is found.

#include "broad/tree.hpp"

#include <gtest/gtest.h>

#include "base/float_environment.hpp"
#include "broad/search.hpp"
#include "scene/brute_force.hpp"
#include "scene/odd_worlds.hpp"

namespace harpoon::testing {
namespace {

constexpr std::uint64_t kSeed = 60601;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kScenes = 2;
#else
constexpr int kScenes = 20;
#endif

template <class Real>
class TreeTest : public ::testing::Test {
 protected:
  /// Pairs of ids that the trees of the spheres find, before any collider, in their order.
  std::vector<IndexPair> near_pairs(const std::vector<SphereOf<Real>>& spheres,
                                    Executor* executor) {
    const FloatEnvironment environment;
    const broad::Means means{{executor}, broad::find_kernels("")};
    broad::Source<Real> source = {};
    if (const SphereOf<Real>* const s = spheres.data(); s != nullptr) {
      source = {&s->x, &s->y, &s->z, &s->r, sizeof *s, spheres.size()};
    }
    broad::Ordered<Real, Real> ordered;
    EXPECT_FALSE(broad::order_in_trees(means, source, 0, order_, trees_, ordered));
    check(ordered, spheres.size());
    broad::SearchMemory memory;
    const broad::PairFilter filter{Filters{}};
    EXPECT_FALSE(broad::search(means, ordered, {}, filter, 1U << 30, memory));
    EXPECT_FALSE(memory.gave_up);
    std::vector<IndexPair> pairs;
    for (std::size_t l = 0; l < memory.used; ++l) {
      const broad::Candidates& list = memory.lists[l].list;
      for (std::size_t p = 0; p < list.count; ++p) {
        const auto [a, b] = std::minmax(ordered.ids[list.i[p]], ordered.ids[list.j[p]]);
        pairs.push_back({a, b});
      }
    }
    return pairs;
  }

 private:
  /// Trees part the sorted positions, and those the ids.
  static void check(const broad::Ordered<Real, Real>& ordered, std::size_t bodies) {
    ASSERT_EQ(ordered.bodies, bodies);
    std::vector<bool> seen(bodies);
    std::size_t position = 0;
    for (std::size_t t = 0; t < ordered.tree_count; ++t) {
      ASSERT_EQ(ordered.trees[t].begin, position);
      position = ordered.trees[t].end;
    }
    ASSERT_EQ(position, bodies);
    for (std::size_t p = 0; p < bodies; ++p) {
      ASSERT_FALSE(seen[ordered.ids[p]]);
      seen[ordered.ids[p]] = true;
    }
  }

  broad::OrderMemory order_;
  broad::TreeMemory trees_;
};
using Reals = ::testing::Types<float, double>;
TYPED_TEST_SUITE(TreeTest, Reals);

bool same(const std::vector<IndexPair>& a, const std::vector<IndexPair>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](IndexPair x, IndexPair y) { return x.g1 == y.g1 && x.g2 == y.g2; });
}

template <class Real>
std::vector<IndexPair> touching(const std::vector<SphereOf<Real>>& spheres) {
  std::vector<IndexPair> pairs;
  for (const auto& c : brute_force(std::span<const SphereOf<Real>>(spheres))) {
    pairs.push_back({c.g1, c.g2});
  }
  return pairs;
}

TYPED_TEST(TreeTest, FindsWhatTouchesInEveryWorld) {
  using Real = TypeParam;
  std::size_t pairs = 0;
  const auto compare = [&](const std::vector<SphereOf<Real>>& spheres, std::uint64_t seed) {
    const auto expected = touching(spheres);
    pairs += expected.size();
    ASSERT_TRUE(same(sorted_by_ids(this->near_pairs(spheres, nullptr)), expected))
        << "seed " << seed;
  };
  for (int scene = 0; scene < kScenes; ++scene) {
    for (const World world : kWorlds) {
      const std::uint64_t seed = kSeed + static_cast<std::uint64_t>(scene);
      Dice dice(seed);
      compare(WorldMaker<Real>(seed).make(world, dice.integer(1, 700)), seed);
    }
  }
  for (const OddWorld odd : kOddWorlds) compare(OddWorldMaker<Real>(kSeed).make(odd, 900), kSeed);
  EXPECT_GT(pairs, 1000U * kScenes);
}

TYPED_TEST(TreeTest, OneOrderForAnyThreads) {
  using Real = TypeParam;
  Executor two(2, {});
  for (const OddWorld odd : kOddWorlds) {
    const auto spheres = OddWorldMaker<Real>(kSeed).make(odd, 6000);
    const auto expected = this->near_pairs(spheres, nullptr);
    EXPECT_TRUE(same(this->near_pairs(spheres, &two), expected)) << static_cast<int>(odd);
  }
}

TYPED_TEST(TreeTest, ScalesBeyondEachOtherAreParted) {
  using Real = TypeParam;
  // Bodies at powers of two, as many as the type has: each cell of the curve holds them all but
  // one.
  std::vector<SphereOf<Real>> spheres;
  const int lowest = sizeof(Real) == 4 ? -40 : -400;
  for (int exponent = lowest; exponent < -lowest; ++exponent) {
    const Real at = std::ldexp(Real(1), exponent);
    for (int k = 0; k < 3; ++k) spheres.push_back({at, -at, at, at / 4});
  }
  EXPECT_TRUE(same(sorted_by_ids(this->near_pairs(spheres, nullptr)), touching(spheres)));
  EXPECT_TRUE(this->near_pairs({}, nullptr).empty());
  EXPECT_EQ(this->near_pairs(std::vector<SphereOf<Real>>(300, {1, 1, 1, 1}), nullptr).size(),
            300U * 299 / 2);
}

}  // namespace
}  // namespace harpoon::testing
