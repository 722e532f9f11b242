// The cells of one operand, Verilated, against the host's FPU on all 2^32 operands. Several
// minutes: a soak test.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <thread>
#include <vector>

#include "Vfp_unary.h"
#include "hls/cells.hpp"
#include "rtl/floats.hpp"
#include "verilated.h"

namespace harpoon {
namespace {

using test::as_bits;
using test::as_float;

constexpr std::uint64_t kRecipLatency = hls::cell_of(hls::Op::recip).latency;
constexpr std::uint64_t kSqrtLatency = hls::cell_of(hls::Op::sqrt).latency;

struct Differences {
  std::uint64_t recip = 0, sqrt = 0, checked = 0;
  std::uint32_t example = 0;
};

/// Checks operands begin..end-1.
Differences check_range(std::uint64_t begin, std::uint64_t end) {
  VerilatedContext context;
  Vfp_unary top{&context};
  Differences out;
  const auto differs = [&](std::uint64_t operand, std::uint32_t got, float want) {
    const bool different = !test::same(got, as_bits(want));
    if (different) out.example = static_cast<std::uint32_t>(operand);
    return different;
  };
  for (std::uint64_t i = begin; i < end + kRecipLatency - 1; ++i) {
    top.a_i = static_cast<std::uint32_t>(i);
    top.clk_i = 0;
    top.eval();
    top.clk_i = 1;
    top.eval();
    if (i + 1 >= begin + kRecipLatency) {
      const std::uint64_t operand = i + 1 - kRecipLatency;
      out.recip +=
          differs(operand, top.recip_o, 1.0F / as_float(static_cast<std::uint32_t>(operand)));
      ++out.checked;
    }
    if (i + 1 >= begin + kSqrtLatency && i + 1 - kSqrtLatency < end) {
      const std::uint64_t operand = i + 1 - kSqrtLatency;
      out.sqrt +=
          differs(operand, top.sqrt_o, std::sqrt(as_float(static_cast<std::uint32_t>(operand))));
    }
  }
  return out;
}

TEST(FpUnary, EqualTheHostOnAllOperands) {
  constexpr std::uint64_t kAll = std::uint64_t{1} << 32;
  const std::uint64_t count = std::max(1U, std::thread::hardware_concurrency());
  std::vector<Differences> parts(count);
  std::vector<std::thread> threads;
  for (std::uint64_t t = 0; t < count; ++t) {
    threads.emplace_back(
        [&, t] { parts[t] = check_range(kAll * t / count, kAll * (t + 1) / count); });
  }
  for (std::thread& thread : threads) thread.join();
  std::uint64_t checked = 0;
  for (const Differences& part : parts) {
    EXPECT_EQ(part.recip, 0U) << "for one at " << std::hex << part.example;
    EXPECT_EQ(part.sqrt, 0U) << "for one at " << std::hex << part.example;
    checked += part.checked;
  }
  EXPECT_EQ(checked, kAll);
}

}  // namespace
}  // namespace harpoon
