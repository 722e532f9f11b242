#pragma once

// Runs the cells of one operand, Verilated, over ranges of operands and compares with the host.

#include <cmath>
#include <cstdint>

#include "Vfp_unary.h"
#include "hls/cells.hpp"
#include "rtl/floats.hpp"
#include "verilated.h"

namespace harpoon::test {

inline constexpr std::uint64_t kRecipLatency = hls::cell_of(hls::Op::recip).latency;
inline constexpr std::uint64_t kSqrtLatency = hls::cell_of(hls::Op::sqrt).latency;

/// Numbers of results that are not the host's, and an operand of the last one.
struct Differences {
  std::uint64_t recip = 0, sqrt = 0, checked = 0;
  std::uint32_t example = 0;
};

/// Checks operands begin..end-1 with a model of its own, so that threads may share the work.
inline Differences check_range(std::uint64_t begin, std::uint64_t end) {
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

}  // namespace harpoon::test
