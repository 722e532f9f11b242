// Packed bounds against the exact comparison, box by box.

#include "ode/packed_bounds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "support/random.hpp"

namespace harpoon::ode {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

bool overlap(const BoundsBox<double>& a, const BoundsBox<double>& b) {
  return !(a.v[0] > b.v[1] || a.v[1] < b.v[0] || a.v[2] > b.v[3] || a.v[3] < b.v[2] ||
           a.v[4] > b.v[5] || a.v[5] < b.v[4]);
}

/// Boxes, some unbounded, some that miss each other by less than binary32 can tell; `wild` ones are
/// of every scale.
BoundsBox<double> some_box(test::Random& random, bool wild) {
  constexpr double kScales[] = {1, 1, 1, 1e-310, 1e-40, 1e12, 1e39, 1e300};
  const double scale = wild ? kScales[random.below(8)] : 1;
  BoundsBox<double> box;
  for (int axis = 0; axis < 3; ++axis) {
    double low = scale * (static_cast<double>(random.below(9)) - 4);
    if (random.below(3) == 0) low += scale * 1e-9;
    const double high = low + scale * static_cast<double>(random.below(4));
    box.v[2 * axis] = random.below(40) == 0 ? -kInfinity : low;
    box.v[2 * axis + 1] = random.below(40) == 0 ? kInfinity : high;
  }
  return box;
}

TEST(PackedBounds, FindEveryOverlapAndLittleElse) {
  std::size_t overlaps = 0, tame_overlaps = 0, tame_candidates = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    test::Random random(seed);
    const bool wild = seed % 2 == 0;
    std::vector<BoundsBox<double>> boxes(1 + random.below(90));
    for (BoundsBox<double>& box : boxes) box = some_box(random, wild);
    PackedBounds<double> packed;
    packed.pack(boxes);
    for (int round = 0; round < 6; ++round) {
      for (const BoundsBox<double>& probe : boxes) {
        std::vector<std::uint32_t> near;
        packed.append_near(probe, near);
        EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
        EXPECT_TRUE(near.empty() || near.back() < boxes.size());
        for (std::uint32_t k = 0; k < boxes.size(); ++k) {
          if (!overlap(probe, boxes[k])) continue;
          ++(wild ? overlaps : tame_overlaps);
          EXPECT_TRUE(std::binary_search(near.begin(), near.end(), k)) << "seed " << seed;
        }
        if (!wild) tame_candidates += near.size();
      }
      const std::size_t changed = random.below(boxes.size());
      boxes[changed] = some_box(random, wild);
      packed.repack(boxes, changed, changed + 1);
    }
  }
  EXPECT_GT(overlaps, 20000u);
  EXPECT_GT(tame_overlaps, 20000u);
  EXPECT_GT(tame_candidates, tame_overlaps) << "none that only nearly overlap";
  EXPECT_LT(tame_candidates, tame_overlaps + tame_overlaps / 2);
}

TEST(PackedBounds, NanOverlapsEverything) {
  std::vector<BoundsBox<double>> boxes(5, {{0, 1, 0, 1, 0, 1}});
  boxes[3].v[2] = std::numeric_limits<double>::quiet_NaN();
  boxes[3].v[3] = std::numeric_limits<double>::quiet_NaN();
  PackedBounds<double> packed;
  packed.pack(boxes);
  std::vector<std::uint32_t> near;
  packed.append_near({{0, 1, 7, 8, 0, 1}}, near);
  EXPECT_EQ(near, std::vector<std::uint32_t>{3});
}

}  // namespace
}  // namespace harpoon::ode
