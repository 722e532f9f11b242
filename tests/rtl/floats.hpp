#pragma once

// Binary32 numbers for the RTL's tests: random ones with a liking for what is special, and
// comparison with every NaN alike.

#include <array>
#include <bit>
#include <cstdint>

#include "support/random.hpp"

namespace harpoon::test {

inline float as_float(std::uint32_t bits) {
  return std::bit_cast<float>(bits);
}
inline std::uint32_t as_bits(float number) {
  return std::bit_cast<std::uint32_t>(number);
}

inline bool is_nan(std::uint32_t bits) {
  return (bits & 0x7fffffffU) > 0x7f800000U;
}
inline bool is_subnormal(std::uint32_t bits) {
  return (bits & 0x7f800000U) == 0 && (bits & 0x007fffffU) != 0;
}
inline bool is_infinite(std::uint32_t bits) {
  return (bits & 0x7fffffffU) == 0x7f800000U;
}
inline bool is_zero(std::uint32_t bits) {
  return (bits & 0x7fffffffU) == 0;
}

/// The same number, or two NaNs.
inline bool same(std::uint32_t a, std::uint32_t b) {
  return a == b || (is_nan(a) && is_nan(b));
}

inline std::uint32_t random_word(Random& random) {
  return static_cast<std::uint32_t>(random.bits() >> 32);
}

/// Uniform in [0, bound) but for 2^-32; without the division of Random::below, for 10^7 vectors.
inline std::uint32_t random_below(Random& random, std::uint32_t bound) {
  return static_cast<std::uint32_t>((std::uint64_t{random_word(random)} * bound) >> 32);
}

/// In [-1, 1], all bits of the significand random.
inline float random_unit(Random& random) {
  return static_cast<float>(static_cast<std::int32_t>(random_word(random))) * 0x1p-31F;
}

/// Any float; one in eight has a special exponent (0, 1, 254, 255), one in eight few bits set.
inline std::uint32_t any_float(Random& random) {
  std::uint32_t bits = random_word(random);
  const std::uint32_t kind = random_below(random, 8);
  constexpr std::array<std::uint32_t, 4> kExponents{0, 1, 254, 255};
  if (kind == 0) bits = (bits & 0x807fffffU) | kExponents[random_below(random, 4)] << 23;
  if (kind == 1)
    bits = (bits & 0xff800000U) | (random_word(random) & 1U) << random_below(random, 23);
  return bits;
}

}  // namespace harpoon::test
