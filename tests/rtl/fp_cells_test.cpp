// Every floating-point cell, Verilated, against the host's FPU: 10^7 random vectors with a liking
// for special operands, and all pairs of numbers made of special exponents and few-bit fractions.
// The host computes in IEEE-754 binary32, nearest even, subnormals kept; a NaN equals any NaN.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "Vfp_cells.h"
#include "hls/cells.hpp"
#include "rtl/floats.hpp"
#include "sim/coverage.hpp"
#include "verilated.h"

namespace harpoon {
namespace {

using hls::Op;
using test::as_bits;
using test::as_float;
using test::is_infinite;
using test::is_nan;
using test::is_subnormal;
using test::is_zero;
using test::Random;

constexpr std::uint64_t kSeed = 20260308;
constexpr int kVectors = 10'000'000;

struct Operands {
  std::uint32_t a, b;
};

std::uint32_t expected(Op op, Operands in) {
  const float a = as_float(in.a);
  const float b = as_float(in.b);
  switch (op) {
    case Op::add:
      return as_bits(a + b);
    case Op::sub:
      return as_bits(a - b);
    case Op::mul:
      return as_bits(a * b);
    case Op::recip:
      return as_bits(1.0F / a);
    case Op::sqrt:
      return as_bits(std::sqrt(a));
    case Op::select:
      return (in.a & 1U) ? in.a : in.b;
    case Op::greater:
      return a > b;
    case Op::less_equal:
      return a <= b;
    default:
      return std::sqrt(a) > b;
  }
}

/// How often a cell met each class of operand and result.
struct Reached {
  int subnormal_operand = 0, nan_operand = 0, infinite_operand = 0, zero_operand = 0;
  int nan_result = 0, overflow = 0, zero_result = 0, subnormal_result = 0, normal_result = 0;
  int invalid = 0;  // a NaN from numbers
  int set = 0, clear = 0;
};

class Cells {
 public:
  Cells() = default;
  Cells(const Cells&) = delete;
  Cells& operator=(const Cells&) = delete;
  ~Cells() { sim::write_coverage(context_); }

  /// One clock cycle with these operands, then every output that has one is checked.
  void step(Operands in) {
    past_[now_ % past_.size()] = in;
    top_.a_i = in.a;
    top_.b_i = in.b;
    top_.clk_i = 0;
    top_.eval();
    top_.clk_i = 1;
    top_.eval();
    ++now_;
    check(Op::add, top_.add_o);
    check(Op::sub, top_.sub_o);
    check(Op::mul, top_.mul_o);
    check(Op::recip, top_.recip_o);
    check(Op::sqrt, top_.sqrt_o);
    check(Op::select, top_.select_o);
    check(Op::greater, top_.greater_o);
    check(Op::less_equal, top_.less_equal_o);
    check(Op::sqrt_greater, top_.sqrt_greater_o);
  }

  /// Pushes the last operands through the longest cell.
  void drain() {
    for (int i = 0; i < 64; ++i) step({0, 0});
  }

  [[nodiscard]] const Reached& reached(Op op) const {
    return reached_[static_cast<std::size_t>(op)];
  }

 private:
  void check(Op op, std::uint32_t got) {
    const auto latency = static_cast<std::uint64_t>(hls::cell_of(op).latency);
    if (now_ < latency) return;
    const Operands in = past_[(now_ - latency) % past_.size()];
    const std::uint32_t want = expected(op, in);
    const bool gives_bit = hls::cell_of(op).gives_bit;
    const bool equal = gives_bit ? got == want : test::same(got, want);
    if (!equal && ++failures_ <= 20) {
      ADD_FAILURE() << hls::cell_of(op).name << std::hex << " of " << in.a << ", " << in.b << " is "
                    << got << ", not " << want;
    }
    if (op != Op::select && !gives_bit && is_nan(got) && got != 0x7fc00000U && ++failures_ <= 20) {
      ADD_FAILURE() << hls::cell_of(op).name << std::hex << " gives the NaN " << got;
    }
    count(op, in, want);
  }

  void count(Op op, Operands in, std::uint32_t result) {
    Reached& r = reached_[static_cast<std::size_t>(op)];
    const bool one_operand = hls::cell_of(op).arguments == 1;
    const std::uint32_t b = one_operand ? as_bits(1.0F) : in.b;
    const bool any_nan = is_nan(in.a) || is_nan(b);
    const bool any_infinite = is_infinite(in.a) || is_infinite(b);
    r.subnormal_operand += is_subnormal(in.a) || is_subnormal(b);
    r.nan_operand += any_nan;
    r.infinite_operand += any_infinite;
    r.zero_operand += is_zero(in.a) || is_zero(b);
    if (hls::cell_of(op).gives_bit) {
      ++(result ? r.set : r.clear);
      return;
    }
    r.nan_result += is_nan(result);
    r.invalid += is_nan(result) && !any_nan;
    r.overflow += is_infinite(result) && !any_infinite;
    r.zero_result += is_zero(result);
    r.subnormal_result += is_subnormal(result);
    r.normal_result +=
        !is_nan(result) && !is_infinite(result) && !is_zero(result) && !is_subnormal(result);
  }

  VerilatedContext context_;
  Vfp_cells top_{&context_};
  std::array<Operands, 64> past_{};
  std::uint64_t now_ = 0;
  std::array<Reached, hls::kCells.size()> reached_{};
  int failures_ = 0;
};

constexpr std::array kNumberOps{Op::add, Op::sub, Op::mul, Op::recip, Op::sqrt};
constexpr std::array kBitOps{Op::greater, Op::less_equal, Op::sqrt_greater};

void expect_all_classes(const Cells& cells, int at_least) {
  const auto expect = [&](Op op, const char* what, int count) {
    EXPECT_GE(count, at_least) << hls::cell_of(op).name << ": " << what;
  };
  for (const Op op : kNumberOps) {
    const Reached& r = cells.reached(op);
    expect(op, "subnormal operand", r.subnormal_operand);
    expect(op, "NaN operand", r.nan_operand);
    expect(op, "infinite operand", r.infinite_operand);
    expect(op, "zero operand", r.zero_operand);
    expect(op, "NaN result", r.nan_result);
    expect(op, "zero result", r.zero_result);
    expect(op, "normal result", r.normal_result);
    if (op != Op::sqrt) {  // a root neither overflows nor underflows
      expect(op, "overflow", r.overflow);
      expect(op, "subnormal result", r.subnormal_result);
    }
    if (op != Op::recip) expect(op, "NaN from numbers", r.invalid);
  }
  for (const Op op : kBitOps) {
    const Reached& r = cells.reached(op);
    expect(op, "subnormal operand", r.subnormal_operand);
    expect(op, "NaN operand", r.nan_operand);
    expect(op, "infinite operand", r.infinite_operand);
    expect(op, "zero operand", r.zero_operand);
    expect(op, "true", r.set);
    expect(op, "false", r.clear);
  }
}

std::uint32_t with_exponent(std::uint32_t bits, std::uint32_t exponent) {
  return (bits & 0x807fffffU) | (exponent & 255U) << 23;
}
std::uint32_t exponent_of(std::uint32_t bits) {
  return bits >> 23 & 255U;
}

constexpr std::array<std::uint32_t, 8> kSpecials{0x00000000, 0x80000000, 0x7f800000, 0xff800000,
                                                 0x7fc00000, 0xffc00001, 0x00000001, 0x7f7fffff};

/// Operands whose result is likely to round, cancel, overflow, underflow or just decide.
Operands random_operands(Random& random) {
  Operands in{test::any_float(random), test::any_float(random)};
  const std::uint32_t near = test::random_below(random, 64) - 32;
  switch (test::random_below(random, 8)) {
    case 0:
    case 1:  // exponents close together: sums align
      in.b = with_exponent(in.b, exponent_of(in.a) + near);
      break;
    case 2:  // almost equal: differences cancel
      in.b = in.a + near;
      break;
    case 3:  // the product near the smallest numbers
      in.b = with_exponent(in.b, 127 - 24 + near - exponent_of(in.a));
      break;
    case 4:  // the product near the largest
      in.b = with_exponent(in.b, 127 + 254 + near / 8 - exponent_of(in.a));
      break;
    case 5: {  // a near b squared: the root comparison is close
      in.b &= 0x7fffffffU;
      in.a = as_bits(as_float(in.b) * as_float(in.b)) + test::random_below(random, 9) - 4;
      break;
    }
    case 6:
      if (test::random_below(random, 16) ==
          0) {  // nothing but special values: the invalid operations
        in = {kSpecials[test::random_below(random, kSpecials.size())],
              kSpecials[test::random_below(random, kSpecials.size())]};
      }
      break;
    default:
      break;
  }
  return in;
}

TEST(FpCells, EqualTheHostOnRandomVectors) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  Random random(kSeed);
  Cells cells;
  for (int i = 0; i < kVectors && !HasFailure(); ++i) cells.step(random_operands(random));
  cells.drain();
  expect_all_classes(cells, 1'000);
}

/// Both signs of special exponents with no, one, all leading and all trailing fraction bits.
std::vector<std::uint32_t> special_numbers() {
  std::vector<std::uint32_t> fractions{0};
  for (int bit = 0; bit < 23; ++bit) {
    fractions.push_back(1U << bit);
    fractions.push_back(0x7fffffU >> bit);
  }
  std::vector<std::uint32_t> numbers;
  for (const std::uint32_t exponent :
       {0U, 1U, 2U, 102U, 103U, 126U, 127U, 128U, 151U, 253U, 254U, 255U}) {
    for (const std::uint32_t fraction : fractions) {
      numbers.push_back(exponent << 23 | fraction);
      numbers.push_back(0x80000000U | exponent << 23 | fraction);
    }
  }
  return numbers;
}

TEST(FpCells, EqualTheHostOnAllPairsOfSpecialNumbers) {
  const std::vector<std::uint32_t> numbers = special_numbers();
  Cells cells;
  for (const std::uint32_t a : numbers) {
    for (const std::uint32_t b : numbers) cells.step({a, b});
    if (HasFailure()) break;
  }
  cells.drain();
  expect_all_classes(cells, 2);
}

}  // namespace
}  // namespace harpoon
