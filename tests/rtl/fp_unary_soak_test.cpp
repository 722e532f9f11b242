// The cells of one operand, Verilated, against the host's FPU on all 2^32 operands. A quarter of an
// hour of processor time: a soak test.

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

#include "rtl/fp_unary.hpp"

namespace harpoon {
namespace {

TEST(FpUnary, EqualTheHostOnAllOperands) {
  constexpr std::uint64_t kAll = std::uint64_t{1} << 32;
  const std::uint64_t count = std::max(1U, std::thread::hardware_concurrency());
  std::vector<test::Differences> parts(count);
  std::vector<std::thread> threads;
  for (std::uint64_t t = 0; t < count; ++t) {
    threads.emplace_back(
        [&, t] { parts[t] = test::check_range(kAll * t / count, kAll * (t + 1) / count); });
  }
  for (std::thread& thread : threads) thread.join();
  std::uint64_t checked = 0;
  for (const test::Differences& part : parts) {
    EXPECT_EQ(part.recip, 0U) << "for one at " << std::hex << part.example;
    EXPECT_EQ(part.sqrt, 0U) << "for one at " << std::hex << part.example;
    checked += part.checked;
  }
  EXPECT_EQ(checked, kAll);
}

}  // namespace
}  // namespace harpoon
