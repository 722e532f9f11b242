#include "bench/algorithm1.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "bench/pair_type.hpp"

namespace harpoon::bench {
namespace {

TEST(Algorithm1, Flow1GivesZeros) {
  const ContactF64 c = algorithm1(SpherePairF64{{0, 0, 0, 1}, {3, 0, 0, 1}});
  EXPECT_EQ(c.flow(), Flow::fake);
  EXPECT_EQ(c.depth, 0);
  EXPECT_EQ(c.normal[0], 0);
  EXPECT_EQ(c.pos[0], 0);
}

TEST(Algorithm1, Flow2IsAtTheFirstCentre) {
  const Contact c = algorithm1(SpherePair{{1, 2, 3, 0.5F}, {1, 2, 3, 0.25F}});
  EXPECT_EQ(c.flow(), Flow::grazing);
  EXPECT_EQ(c.pos[1], 2);
  EXPECT_EQ(c.normal[0], 1);
  EXPECT_EQ(c.normal[1], 0);
  EXPECT_EQ(c.depth, 0.75F);
}

TEST(Algorithm1, Flow3LiesMidwayInTheOverlap) {
  // Along x the spheres reach [-1, 1] and [0.5, 2.5]: the overlap is [0.5, 1].
  const ContactF64 c = algorithm1(SpherePairF64{{0, 0, 0, 1}, {1.5, 0, 0, 1}});
  EXPECT_EQ(c.flow(), Flow::real);
  EXPECT_EQ(c.depth, 0.5);
  EXPECT_NEAR(c.pos[0], 0.75, 1e-15);
  EXPECT_NEAR(c.normal[0], -1, 1e-15);  // from sphere 2 to sphere 1
}

TEST(Algorithm1, TouchingIsAContactOfDepthZero) {
  const ContactF64 c = algorithm1(SpherePairF64{{0, 0, 0, 1}, {2, 0, 0, 1}});
  EXPECT_EQ(c.flow(), Flow::real);
  EXPECT_EQ(c.depth, 0);
}

TEST(Algorithm1, AnUnknownDistanceIsNotFake) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(algorithm1(SpherePairF64{{nan, 0, 0, 1}, {0, 0, 0, 1}}).flow(), Flow::real);
}

TEST(PairType, NamesGoBothWaysAndMatchTheirFlow) {
  for (const PairType type : {PairType::fake, PairType::grazing, PairType::real, PairType::mixed}) {
    EXPECT_EQ(parse_pair_type(to_string(type)), type);
    EXPECT_EQ(matches(type, Flow::real), type == PairType::real || type == PairType::mixed);
    EXPECT_EQ(matches(type, Flow::fake), type == PairType::fake || type == PairType::mixed);
    EXPECT_EQ(matches(type, Flow::grazing), type == PairType::grazing || type == PairType::mixed);
  }
  EXPECT_FALSE(parse_pair_type("Real"));
}

}  // namespace
}  // namespace harpoon::bench
