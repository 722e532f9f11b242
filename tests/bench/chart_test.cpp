#include "bench/chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace harpoon::bench {
namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Chart, PutsPointsWhereTheAxesSay) {
  Chart chart;
  chart.x = {0, 200, false};
  chart.y = {1e-4, 1, true};
  chart.caption = "step; metres";
  chart.lines = {{"median", {{0, 1e-4}, {100, 1e-2}, {200, 1}}}, {"nothing", {}}};
  const std::string svg = to_svg(chart);
  // The plot lies between x = 56 and 510, y = 320 (below) and 16.
  EXPECT_TRUE(contains(svg, "points=\"56.0,320.0 283.0,168.0 510.0,16.0 \"")) << svg;
  EXPECT_TRUE(contains(svg, ">median</tspan>"));
  EXPECT_FALSE(contains(svg, "nothing"));
  EXPECT_TRUE(contains(svg, ">step; metres</text>"));
  EXPECT_EQ(std::count(svg.begin(), svg.end(), '<'), std::count(svg.begin(), svg.end(), '>'));
}

TEST(Chart, MarksLongAxesByDecadesShortOnesFiner) {
  Chart chart;
  chart.x = {0, 190, false};
  chart.y = {1e-9, 1, true};
  const std::string long_axis = to_svg(chart);
  for (const char* mark : {">0<", ">50<", ">150<", ">10^-9<", ">10^-1<", ">10^0<"}) {
    EXPECT_TRUE(contains(long_axis, mark)) << mark;
  }
  EXPECT_FALSE(contains(long_axis, ">200<"));
  chart.y = {10, 1000, true};
  const std::string short_axis = to_svg(chart);
  for (const char* mark : {">10<", ">20<", ">500<", ">1000<"}) {
    EXPECT_TRUE(contains(short_axis, mark)) << mark;
  }
  EXPECT_FALSE(contains(short_axis, ">2000<"));
}

TEST(Chart, DecadesHoldBothValues) {
  const ChartAxis axis = decades_around(3e-5, 0.2);
  EXPECT_DOUBLE_EQ(axis.low, 1e-5);
  EXPECT_DOUBLE_EQ(axis.high, 1);
  const ChartAxis one = decades_around(10, 10);
  EXPECT_DOUBLE_EQ(one.low, 10);
  EXPECT_DOUBLE_EQ(one.high, 100);
}

}  // namespace
}  // namespace harpoon::bench
