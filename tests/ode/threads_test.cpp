// Several threads, each with a space of its own, as libode allows; the thread sanitizer looks on.

#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <thread>

#include "ode/twin_world.hpp"

namespace harpoon::test {
namespace {

constexpr std::size_t kThreads = 8;
constexpr int kSteps = 40;

WorldPlan plan_of(std::size_t thread) {
  WorldPlan plan;
  plan.kind = static_cast<SpaceKind>(thread % 4);
  plan.geoms = 120;
  // libode keeps state of its own for all threads in some shapes, and a cache of poses whose atomic
  // exchange the sanitizer does not see.
  plan.spheres_only = true;
  plan.keeps_geoms = true;
  plan.few_movers = thread >= 4;
  plan.others = 0;
  return plan;
}

std::vector<std::uint64_t> run(World& world) {
  std::vector<std::uint64_t> trace;
  for (int step = 0; step < kSteps; ++step) {
    world.change();
    world.collide();
    const std::vector<std::uint64_t> seen = world.take_trace();
    trace.insert(trace.end(), seen.begin(), seen.end());
  }
  return trace;
}

TEST(Threads, EachSeesWhatItSeesAlone) {
  ::setenv("HARPOON_MIN_GEOMS", "12", 1);
  dInitODE2(0);
  std::vector<std::vector<std::uint64_t>> expected(kThreads), got(kThreads);
  std::vector<std::unique_ptr<World>> worlds;
  for (std::size_t k = 0; k < kThreads; ++k) {
    World stock(stock_ode(), plan_of(k), k + 1);
    expected[k] = run(stock);
    worlds.push_back(std::make_unique<World>(linked_ode(), plan_of(k), k + 1));
  }
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < kThreads; ++k) {
    threads.emplace_back([&, k] { got[k] = run(*worlds[k]); });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t k = 0; k < kThreads; ++k) {
    EXPECT_GT(expected[k].size(), 1000u);
    EXPECT_EQ(got[k], expected[k]) << "thread " << k;
  }
  worlds.clear();
  dCloseODE();
}

}  // namespace
}  // namespace harpoon::test
