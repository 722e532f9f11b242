#pragma once

// Whether the calling thread computes as Harpoon does: round to nearest, subnormals kept. A program
// that set another mode gets contacts in its own mode, from libode's collider.

#include <cfenv>

namespace harpoon::ode {

[[nodiscard]] inline bool computes_by_default_rules() {
#if defined(__SSE2__)
  constexpr unsigned kRoundingAndFlushing = 0xE040;  // rounding control, FTZ, DAZ
  return (__builtin_ia32_stmxcsr() & kRoundingAndFlushing) == 0;
#else
  return std::fegetround() == FE_TONEAREST;
#endif
}

}  // namespace harpoon::ode
