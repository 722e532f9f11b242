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

TEST(Stats, UndisturbedTimesReachFromTheFastestToTheFastestSeenAgain) {
  // Parts of three: their minima are 4, 2, 9, 3.
  const Summary summary =
      summarize(std::vector<double>{5, 4, 6, 2, 900, 7, 10, 9, 11, 3, 800, 700});
  EXPECT_EQ(summary.undisturbed().low, 2);
  EXPECT_EQ(summary.undisturbed().high, 3);
  EXPECT_DOUBLE_EQ(summary.undisturbed().width(), 0.5);
  // A single fast time is not enough to be believed.
  const Summary once = summarize(std::vector<double>{1, 8, 8, 8});
  EXPECT_EQ(once.undisturbed().low, 1);
  EXPECT_EQ(once.undisturbed().high, 8);
  EXPECT_EQ(summarize(std::vector<double>{3}).undisturbed().high, 3);
  EXPECT_EQ(summarize(std::vector<double>{3, 4}).undisturbed().high, 4);
}

TEST(Stats, QuotientsOfRangesHoldAllQuotients) {
  const Range ratio = ratio_of({2, 3}, {4, 8});
  EXPECT_DOUBLE_EQ(ratio.low, 0.25);
  EXPECT_DOUBLE_EQ(ratio.high, 0.75);
}

TEST(Stats, LineThroughPointsOnALine) {
  const LineFit fit = fit_line(std::vector<double>{1, 2, 4}, std::vector<double>{5, 7, 11});
  EXPECT_NEAR(fit.slope, 2, 1e-12);
  EXPECT_NEAR(fit.intercept, 3, 1e-12);
  EXPECT_NEAR(fit.explained, 1, 1e-12);
  EXPECT_NEAR(fit.residual, 0, 1e-12);
}

TEST(Stats, ALineStaysWhereAFewPointsAreAnywhere) {
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 1; i <= 20; ++i) {
    x.push_back(i);
    y.push_back(i % 5 == 0 ? 1000.0 * i : 3.0 + 2 * i);
  }
  const LineFit fit = fit_line(x, y);
  EXPECT_NEAR(fit.slope, 2, 0.2);
  EXPECT_GT(fit.explained, 0.99);
}

TEST(Stats, ACurveAndScatterAreNoLine) {
  std::vector<double> x;
  std::vector<double> square;
  std::vector<double> scatter;
  for (int i = 1; i <= 40; ++i) {
    x.push_back(i);
    square.push_back(i * i);
    scatter.push_back(i % 2 == 0 ? 0 : 3);
  }
  EXPECT_LT(fit_line(x, square).explained, 0.96);
  EXPECT_LT(fit_line(x, scatter).explained, 0.5);
  EXPECT_EQ(fit_line(x, std::vector<double>(40, 7)).explained, 1);
}

}  // namespace
}  // namespace harpoon::bench
