// The cells of one operand, Verilated, against the host's FPU on all significands: of all subnormal
// numbers, of both parities of the exponent, on which a root depends, and of the exponents whose
// reciprocals are subnormal. Between exponents of the same kind the cells do nothing but add; that,
// and all else, is in the soak test over all 2^32 operands.

#include <gtest/gtest.h>

#include "rtl/fp_unary.hpp"

namespace harpoon {
namespace {

TEST(FpUnary, EqualTheHostOnAllSignificands) {
  constexpr std::uint64_t kSignificands = std::uint64_t{1} << 23;
  for (const std::uint64_t exponent : {0U, 127U, 128U, 253U, 254U}) {
    const test::Differences found =
        test::check_range(exponent * kSignificands, (exponent + 1) * kSignificands);
    EXPECT_EQ(found.recip, 0U) << "exponent " << exponent << ", for one at " << found.example;
    EXPECT_EQ(found.sqrt, 0U) << "exponent " << exponent << ", for one at " << found.example;
    EXPECT_EQ(found.checked, kSignificands);
  }
}

}  // namespace
}  // namespace harpoon
