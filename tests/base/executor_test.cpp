#include "base/executor.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cfenv>
#include <vector>

namespace harpoon {
namespace {

// oneTBB warns once in a process, so this test comes first.
TEST(Executor, MoreThreadsThanTheMachineHasPrintNothing) {
  ::testing::internal::CaptureStderr();
  Executor executor(1024, {});
  EXPECT_FALSE(executor.run(5000, [](std::size_t) {}));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Executor, RunsEveryTaskOnce) {
  for (const unsigned threads : {1u, 2u, 7u}) {
    Executor executor(threads, {});
    EXPECT_EQ(executor.threads(), threads);
    for (const std::size_t tasks : {0U, 1U, 2U, 1000U}) {
      std::vector<std::atomic<int>> ran(tasks);
      EXPECT_FALSE(executor.run(tasks, [&](std::size_t task) { ++ran[task]; }));
      for (const auto& count : ran) EXPECT_EQ(count, 1);
    }
  }
}

TEST(Executor, TakesOneThreadPerHardwareThreadByDefault) {
  EXPECT_GE(Executor(0, {}).threads(), 1u);
}

/// What the arithmetic units of this thread do; fegetround looks elsewhere on x86.
bool rounds_to_nearest() {
  volatile float one = 1;
  volatile float above_half_ulp = 0x1.8p-24F;
  return one + above_half_ulp > 1;
}

// Inside a task the contract's environment holds, on every thread, and the caller's is kept.
TEST(Executor, TasksRoundToNearest) {
  std::fesetround(FE_TOWARDZERO);
  std::atomic<int> wrong{0};
  for (const unsigned threads : {1u, 4u}) {
    Executor executor(threads, {});
    EXPECT_FALSE(executor.run(64, [&](std::size_t) {
      if (!rounds_to_nearest()) ++wrong;
    }));
    EXPECT_FALSE(rounds_to_nearest());
  }
  std::fesetround(FE_TONEAREST);
  EXPECT_EQ(wrong, 0);
}

}  // namespace
}  // namespace harpoon
