#include "bench/divergence.hpp"

#include <gtest/gtest.h>

namespace harpoon::bench {
namespace {

std::string header() {
  return std::string(kPositionsHeader) + "\n";
}

/// Three spheres at steps 0 and 10, those of step 10 moved in z.
std::string run(double first, double second, double third) {
  std::string text = header();
  for (std::size_t k = 0; k < 3; ++k) text += position_line(0, k, {0.1, static_cast<double>(k), 0});
  text += position_line(10, 0, {0, 0, first});
  text += position_line(10, 1, {0, 0, second});
  return text + position_line(10, 2, {0, 0, third});
}

std::string message_of(const std::string& a, const std::string& b) {
  const auto compared = compare_positions(a, b);
  return compared ? "no error" : compared.error().message;
}

TEST(Divergence, IsMedianAndLargestDistanceOfEachStep) {
  const auto compared = compare_positions(run(1, 2, 3), run(1.5, 2, -1));
  ASSERT_TRUE(compared) << compared.error().message;
  ASSERT_EQ(compared->size(), 2U);
  EXPECT_EQ((*compared)[0].step, 0U);
  EXPECT_EQ((*compared)[0].largest, 0);
  EXPECT_EQ((*compared)[1].step, 10U);
  EXPECT_EQ((*compared)[1].median, 0.5);
  EXPECT_EQ((*compared)[1].largest, 4);
}

TEST(Divergence, PositionsKeepEveryBit) {
  const double third = 1.0 / 3, tiny = 4.9e-324;
  const std::string text = header() + position_line(0, 0, {third, tiny, -third});
  const auto compared = compare_positions(text, header() + position_line(0, 0, {third, 0, -third}));
  ASSERT_TRUE(compared);
  EXPECT_EQ(compared->at(0).largest, tiny);
}

TEST(Divergence, NamesTheLineThatDoesNotCompare) {
  const std::string good = run(1, 2, 3);
  EXPECT_NE(message_of("x,y\n", good).find("line 1: "), std::string::npos);
  EXPECT_NE(message_of(good, header()).find("line 2: one of the runs ends"), std::string::npos);
  EXPECT_NE(message_of(good, header() + "0,0,a,0,0\n").find("line 2: this is not a position"),
            std::string::npos);
  EXPECT_NE(message_of(good, header() + "0,0,1,0,0").find("line 2: this is not a position"),
            std::string::npos);
  EXPECT_NE(message_of(good, header() + position_line(0, 0, {}) + position_line(1, 1, {}))
                .find("line 3: the runs differ"),
            std::string::npos);
}

TEST(Divergence, PlotLeavesOutWhatDoesNotPart) {
  const std::string svg = divergence_svg({{0, 0, 0}, {10, 0, 1e-6}, {20, 1e-5, 1e-4}}, "metres");
  EXPECT_NE(svg.find("largest</tspan>"), std::string::npos);
  // One point of the median, two of the largest: from 1e-6 to 1e-4 over 304 points of height.
  EXPECT_NE(svg.find("points=\"510.0,168.0 \""), std::string::npos) << svg;
  EXPECT_NE(svg.find("points=\"283.0,320.0 510.0,16.0 \""), std::string::npos) << svg;
  EXPECT_EQ(divergence_svg({{0, 0, 0}, {10, 0, 0}}, "metres").find("<polyline"), std::string::npos);
}

}  // namespace
}  // namespace harpoon::bench
