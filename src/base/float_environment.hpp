#pragma once

// The floating-point environment of the numeric contract: round to nearest even, subnormals kept,
// no traps. Every entry into arithmetic code, on every thread, holds one of these.

#include <cfenv>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace harpoon {

/// Sets the contract's environment for its lifetime and then restores what the thread had, its
/// exception flags included. The compiler does not know that arithmetic depends on the environment,
/// so constructor and destructor are barriers for memory: operands must be loaded and results
/// stored, through pointers the compiler cannot see behind, between the two.
class FloatEnvironment {
 public:
  FloatEnvironment() noexcept {
#if defined(__SSE2__)
    saved_ = _mm_getcsr();
    // Writing the register is slow, and most callers already run in the contract's environment.
    if ((saved_ & ~kFlags) != kAllMasked) _mm_setcsr(kAllMasked);
#else
    std::feholdexcept(&saved_);
    std::fesetenv(FE_DFL_ENV);
#endif
    asm volatile("" ::: "memory");
  }
  ~FloatEnvironment() {
    asm volatile("" ::: "memory");
#if defined(__SSE2__)
    if (_mm_getcsr() != saved_) _mm_setcsr(saved_);
#else
    std::fesetenv(&saved_);
#endif
  }
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

 private:
#if defined(__SSE2__)
  static constexpr unsigned kAllMasked = 0x1F80;  // nearest even, no FTZ, no DAZ, no flags
  static constexpr unsigned kFlags = 0x003F;
  unsigned saved_;
#else
  std::fenv_t saved_;
#endif
};

}  // namespace harpoon
