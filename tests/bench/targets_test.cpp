// What becomes of a measured figure. The measurement itself is run by hand: it asks how fast this
// machine is.

#include "bench/ode/targets.hpp"

#include <gtest/gtest.h>

namespace harpoon::bench {
namespace {

TEST(Targets, AreMissedOnlyWhereTheTimesAreSureOfIt) {
  EXPECT_EQ((Target{"", 7.0, {7.0, 7.0}, 7, ""}.verdict()), TargetVerdict::pass);
  EXPECT_EQ((Target{"", 7.1, {6.0, 9.0}, 7, ""}.verdict()), TargetVerdict::pass);
  EXPECT_EQ((Target{"", 6.5, {6.4, 6.6}, 7, ""}.verdict()), TargetVerdict::missed);
  EXPECT_EQ((Target{"", 6.5, {5.0, 8.0}, 7, ""}.verdict()), TargetVerdict::unsure);
}

}  // namespace
}  // namespace harpoon::bench
