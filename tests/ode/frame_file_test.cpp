#include "ode/frame_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/random.hpp"

namespace harpoon::ode {
namespace {

CollisionFrame some_frame() {
  CollisionFrame frame;
  frame.kind = geom_class::kHashSpace;
  frame.min_level = -3;
  frame.max_level = 10;
  frame.difference = "one line about it";
  test::Random random(3);
  for (std::uint32_t k = 0; k < 50; ++k) {
    FrameGeom geom;
    geom.body = k / 2;
    geom.category = ~std::uint64_t{0};
    geom.collide = 1;
    for (int axis = 0; axis < 3; ++axis) {
      geom.bounds[2 * axis] = random.between(-2, 2);
      geom.bounds[2 * axis + 1] = geom.bounds[2 * axis] + random.unit();
    }
    frame.geoms.push_back(geom);
  }
  frame.geoms[7].bounds[3] = std::numeric_limits<double>::infinity();
  frame.geoms[8].bounds[0] = std::numeric_limits<double>::quiet_NaN();
  frame.stock = {{1, 2}, {49, 0}};
  return frame;
}

TEST(FrameFile, ComesBackToTheLastBit) {
  const CollisionFrame frame = some_frame();
  const Result<CollisionFrame> back = parse_frame(to_text(frame));
  ASSERT_TRUE(back.ok()) << back.error().message;
  EXPECT_EQ(to_text(*back), to_text(frame));
  EXPECT_EQ(back->geoms.size(), 50u);
  EXPECT_EQ(back->geoms[3].bounds[1], frame.geoms[3].bounds[1]);
  EXPECT_TRUE(std::isnan(back->geoms[8].bounds[0]));
  const Result<std::vector<IndexPair>> pairs = search_again(*back);
  ASSERT_TRUE(pairs.ok());
  EXPECT_GT(pairs->size(), 5u);
}

TEST(FrameFile, DamagedTextIsAnErrorOrAnotherFrameButNeverWorse) {
  const std::string text = to_text(some_frame());
  test::Random random(9);
  int errors = 0;
  for (int k = 0; k < 3000; ++k) {
    std::string damaged = text;
    damaged[random.below(damaged.size())] = "0123456789 \n-x.ae"[random.below(17)];
    if (random.below(4) == 0) damaged.resize(random.below(damaged.size()));
    const Result<CollisionFrame> back = parse_frame(damaged);
    errors += back.ok() ? 0 : 1;
    if (back.ok()) (void)search_again(*back);
  }
  EXPECT_GT(errors, 300);
  EXPECT_FALSE(parse_frame("").ok());
  EXPECT_FALSE(parse_frame("something else\n").ok());
}

}  // namespace
}  // namespace harpoon::ode
