// How often a Scene searches for bodies of a given speed, as docs/scene.md says: a promise about
// cost that no comparison of contacts sees.

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "harpoon/scene.hpp"

namespace harpoon {
namespace {

constexpr int kFrames = 60;

// Of kFrames frames in which every body goes straight on by `step` of its radius.
int searches_at(float step) {
  constexpr std::size_t kBodies = 2000;
  std::mt19937 engine(1);
  std::uniform_real_distribution<float> place(0, 50);
  std::normal_distribution<float> normal;
  std::vector<Sphere> spheres;
  std::vector<Sphere> ways;
  for (std::size_t i = 0; i < kBodies; ++i) {
    spheres.push_back({place(engine), place(engine), place(engine), 1});
    const float x = normal(engine);
    const float y = normal(engine);
    const float z = normal(engine);
    const float length = std::sqrt(x * x + y * y + z * z);
    ways.push_back({x / length * step, y / length * step, z / length * step, 0});
  }
  Result<Scene> scene = Scene::make({.threads = 1});
  int searches = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    for (std::size_t i = 0; i < kBodies; ++i) {
      spheres[i].x += ways[i].x;
      spheres[i].y += ways[i].y;
      spheres[i].z += ways[i].z;
    }
    EXPECT_FALSE(scene->set_bodies(Bodies(spheres)));
    const auto result = scene->detect();
    EXPECT_TRUE(result);
    searches += result->searched ? 1 : 0;
  }
  return searches;
}

TEST(MovingBodies, AreSearchedEverySeventhFrameOrLessOftenUpToAThirtiethOfTheRadius) {
  for (const float step : {0.01F, 0.02F, 1 / 31.0F}) {
    EXPECT_LE(searches_at(step), kFrames / 7 + 2) << step;
  }
}

TEST(MovingBodies, AreSearchedEverySecondFrameAtMostUpToAQuarter) {
  EXPECT_GT(searches_at(0.1F), kFrames / 7 + 2);
  for (const float step : {0.1F, 0.2F, 0.24F}) {
    EXPECT_LE(searches_at(step), kFrames / 2 + 2) << step;
  }
}

TEST(MovingBodies, AreSearchedInEveryFrameBeyondAQuarter) {
  for (const float step : {0.26F, 0.5F}) {
    EXPECT_EQ(searches_at(step), kFrames) << step;
  }
}

}  // namespace
}  // namespace harpoon
