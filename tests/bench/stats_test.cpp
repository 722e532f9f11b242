#include "bench/stats.hpp"

#include <gtest/gtest.h>

namespace harpoon::bench {
namespace {

TEST(Stats, MedianOfOddAndEvenCounts) {
  EXPECT_EQ(summarize(std::vector<double>{9, 1, 5}).median, 5);
  EXPECT_EQ(summarize(std::vector<double>{9, 1, 5, 7}).median, 6);
}

TEST(Stats, PercentilesInterpolate) {
  const std::vector<double> values = {10, 0, 8, 2, 6, 4, 1, 3, 5, 7, 9};  // 0 to 10
  EXPECT_DOUBLE_EQ(quantile_of(values, 0.1), 1);
  EXPECT_DOUBLE_EQ(quantile_of(values, 0.9), 9);
  EXPECT_DOUBLE_EQ(quantile_of(values, 0.25), 2.5);
  EXPECT_DOUBLE_EQ(quantile_of(values, 1), 10);
}

TEST(Stats, SummaryOfOneValueAndOfNone) {
  const Summary one = summarize(std::vector<double>{3});
  EXPECT_EQ(one.median, 3);
  EXPECT_EQ(one.min, 3);
  EXPECT_EQ(one.low, 3);
  EXPECT_EQ(one.high, 3);
  EXPECT_EQ(one.samples, 1U);
  EXPECT_EQ(summarize({}).samples, 0U);
}

TEST(Stats, AnOutlierMovesTheHighOnly) {
  const Summary summary = summarize(std::vector<double>{1, 1, 1, 1, 1, 1, 1, 1, 1, 1000});
  EXPECT_EQ(summary.median, 1);
  EXPECT_EQ(summary.min, 1);
  EXPECT_GT(summary.high, 1);
}

TEST(Stats, LineThroughPointsOnALine) {
  const LineFit fit = fit_line(std::vector<double>{1, 2, 4}, std::vector<double>{5, 7, 11});
  EXPECT_NEAR(fit.slope, 2, 1e-12);
  EXPECT_NEAR(fit.intercept, 3, 1e-12);
  EXPECT_NEAR(fit.r_squared, 1, 1e-12);
}

TEST(Stats, ScatterLowersTheExplainedShare) {
  const LineFit fit = fit_line(std::vector<double>{0, 1, 2, 3}, std::vector<double>{0, 3, 0, 3});
  EXPECT_NEAR(fit.r_squared, 0.2, 1e-12);
}

}  // namespace
}  // namespace harpoon::bench
