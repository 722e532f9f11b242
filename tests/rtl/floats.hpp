#pragma once

// Binary32 numbers for the RTL's tests: random ones with a liking for what is special, and
// comparison with every NaN alike.

#include <array>
#include <bit>
#include <cstdint>

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

/// xorshift128+: fast enough not to be what a test of 10^7 vectors waits for.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_{seed ^ 0x9e3779b97f4a7c15U, 0xd1b54a32d192ed03U} {
    for (int i = 0; i < 8; ++i) next();
  }

  std::uint64_t next() {
    std::uint64_t a = state_[0];
    const std::uint64_t b = state_[1];
    state_[0] = b;
    a ^= a << 23;
    state_[1] = a ^ b ^ (a >> 17) ^ (b >> 26);
    return state_[1] + b;
  }
  std::uint32_t word() { return static_cast<std::uint32_t>(next() >> 32); }
  std::uint32_t below(std::uint32_t bound) {
    return static_cast<std::uint32_t>((static_cast<std::uint64_t>(word()) * bound) >> 32);
  }
  /// In [-1, 1), all bits of the significand random.
  float unit() { return static_cast<float>(static_cast<std::int32_t>(word())) * 0x1p-31F; }

 private:
  std::array<std::uint64_t, 2> state_;
};

/// Any float; one in eight has a special exponent (0, 1, 254, 255), one in eight few bits set.
inline std::uint32_t any_float(Random& random) {
  std::uint32_t bits = random.word();
  const std::uint32_t kind = random.below(8);
  constexpr std::array<std::uint32_t, 4> kExponents{0, 1, 254, 255};
  if (kind == 0) bits = (bits & 0x807fffffU) | kExponents[random.below(4)] << 23;
  if (kind == 1) bits = (bits & 0xff800000U) | (random.word() & 1U) << random.below(23);
  return bits;
}

}  // namespace harpoon::test
