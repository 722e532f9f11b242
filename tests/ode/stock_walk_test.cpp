// A walk as such, on a traversal of the test's own: pair by pair, to a pair, to its end, and what
// it throws.

#include "ode/stock_walk.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <new>
#include <vector>

namespace harpoon::ode {
namespace {

/// Calls back for pairs (1, 2), (2, 3) ... and notes how far it came.
struct Row {
  int pairs = 0;
  bool throws = false;
  int begun = 0;
  bool ended = false;
};

GeomPair pair_of(int k) {
  return {reinterpret_cast<dxGeom*>(static_cast<std::uintptr_t>(k) + 1),
          reinterpret_cast<dxGeom*>(static_cast<std::uintptr_t>(k) + 2)};
}

void walk_row(const void* traversal, void* data, NearCallback* callback) {
  Row& row = *static_cast<Row*>(const_cast<void*>(traversal));
  for (int k = 0; k < row.pairs; ++k) {
    ++row.begun;
    callback(data, pair_of(k).o1, pair_of(k).o2);
  }
  if (row.throws) throw std::bad_alloc();
  row.ended = true;
}

TEST(Walk, StandsStillBetweenTwoPairs) {
  Row row{.pairs = 3};
  Walk walk(&walk_row, &row, *WalkStack::take());
  EXPECT_EQ(row.begun, 0);
  GeomPair pair;
  for (int k = 0; k < 3; ++k) {
    ASSERT_TRUE(walk.next(pair));
    EXPECT_EQ(pair, pair_of(k));
    EXPECT_EQ(row.begun, k + 1);
  }
  EXPECT_FALSE(row.ended);
  EXPECT_FALSE(walk.next(pair));
  EXPECT_TRUE(row.ended);
  EXPECT_FALSE(walk.next(pair));
}

TEST(Walk, SkipsToAPair) {
  Row row{.pairs = 5};
  Walk walk(&walk_row, &row, *WalkStack::take());
  GeomPair pair;
  ASSERT_TRUE(walk.skip_to(pair_of(2)));
  ASSERT_TRUE(walk.next(pair));
  EXPECT_EQ(pair, pair_of(3));
  EXPECT_FALSE(walk.skip_to(pair_of(1)));
  EXPECT_TRUE(row.ended);
}

TEST(Walk, IsTakenToItsEnd) {
  Row row{.pairs = 4};
  {
    Walk walk(&walk_row, &row, *WalkStack::take());
    GeomPair pair;
    ASSERT_TRUE(walk.next(pair));
  }
  EXPECT_TRUE(row.ended);
  Row untouched{.pairs = 4};
  { const Walk walk(&walk_row, &untouched, *WalkStack::take()); }
  EXPECT_EQ(untouched.begun, 0);
}

TEST(Walk, HandsOnWhatIsThrown) {
  Row row{.pairs = 1, .throws = true};
  Walk walk(&walk_row, &row, *WalkStack::take());
  GeomPair pair;
  ASSERT_TRUE(walk.next(pair));
  EXPECT_THROW((void)walk.next(pair), std::bad_alloc);
  EXPECT_FALSE(walk.next(pair));
}

TEST(Walk, ManyStandSideBySide) {
  constexpr int kWalks = 12;  // more than a thread keeps stacks for
  Row rows[kWalks];
  std::vector<std::unique_ptr<Walk>> walks;
  for (Row& row : rows) {
    row.pairs = 3;
    walks.push_back(std::make_unique<Walk>(&walk_row, &row, *WalkStack::take()));
  }
  GeomPair pair;
  for (int k = 0; k < 3; ++k) {
    for (const auto& walk : walks) {
      ASSERT_TRUE(walk->next(pair));
      EXPECT_EQ(pair, pair_of(k));
    }
  }
}

}  // namespace
}  // namespace harpoon::ode
