#pragma once

// The exact comparison with a square root that takes no root, for binary32.
//
// For b >= 0, RN(sqrt(a)) > b exactly when a > (b + ulp(b)/2)^2: the root rounds to a float above b
// only from beyond the midpoint between b and its successor, and no root is such a midpoint (its
// square would need 49 bits). b + ulp(b)/2 has 25 bits and its square 50, so double holds both.

#include <bit>
#include <cstdint>

namespace harpoon::colliders {

/// sqrt(a) > b, with the correctly rounded binary32 root. False if a is negative or either is NaN.
inline bool sqrt_greater(float a, float b) {
  if (b < 0) return a >= 0;
  const std::uint32_t exponent = std::bit_cast<std::uint32_t>(b) >> 23 & 0xff;
  const std::uint64_t half_ulp_exponent = (exponent ? exponent : 1) + 1023 - 127 - 24;
  const double middle = static_cast<double>(b) + std::bit_cast<double>(half_ulp_exponent << 52);
  return static_cast<double>(a) > middle * middle;
}

}  // namespace harpoon::colliders
