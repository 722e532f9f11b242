#include "bench/lattice.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace harpoon::bench {
namespace {

TEST(Lattice, SphereCountsOfThePapersDiamonds) {
  EXPECT_EQ(diamond_sphere_count(0), 1U);
  EXPECT_EQ(diamond_sphere_count(2), 25U);
  EXPECT_EQ(diamond_sphere_count(3), 63U);
  EXPECT_EQ(diamond_sphere_count(10), 1561U);
  EXPECT_EQ(diamond_sphere_count(30), 37881U);
}

TEST(Lattice, FormulaCountsThePoints) {
  for (unsigned h = 0; h <= 12; ++h) {
    EXPECT_EQ(diamond_points(h, 1).size(), diamond_sphere_count(h)) << "hMax " << h;
  }
}

TEST(Lattice, PointsAreDistinctInsideTheDiamondAndSpacedAsAsked) {
  const double spacing = 0.25;
  const std::vector<Point> points = diamond_points(4, spacing);
  EXPECT_EQ(std::set<Point>(points.begin(), points.end()).size(), points.size());
  double farthest = 0;
  for (const Point& p : points) {
    const double norm = std::abs(p[0]) + std::abs(p[1]) + std::abs(p[2]);
    EXPECT_LE(norm, 4 * spacing);
    farthest = std::max(farthest, norm);
    for (const double x : p) {
      EXPECT_EQ(x / spacing, std::round(x / spacing));
    }
  }
  EXPECT_EQ(farthest, 4 * spacing);
}

}  // namespace
}  // namespace harpoon::bench
