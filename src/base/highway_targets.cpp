// Highway's functions that we use and that are not in its headers, for x86. Its shared library
// measures the clock while it is loaded, by an instruction that not every machine has: valgrind's
// for one. So Harpoon does without it. Private to the library, so that a program may have Highway's
// own beside it.

#include <hwy/targets.h>

#if HWY_ARCH_X86

#include <cpuid.h>

#include <cstdlib>

namespace hwy {
namespace {

bool has_bit(unsigned leaf, unsigned bit_of_ecx) {
  unsigned eax = 0, ebx = 0, ecx = 0, edx = 0;
  return __get_cpuid(leaf, &eax, &ebx, &ecx, &edx) != 0 && (ecx >> bit_of_ecx & 1) != 0;
}

/// What Highway lets the compiler use under each name; the operating system must keep the
/// registers.
std::int64_t find_targets() {
  __builtin_cpu_init();
  std::int64_t targets = HWY_SCALAR | HWY_EMU128;
  if (!__builtin_cpu_supports("ssse3")) return targets;
  targets |= HWY_SSSE3;
  if (!__builtin_cpu_supports("sse4.1") || !__builtin_cpu_supports("sse4.2") ||
      !__builtin_cpu_supports("pclmul") || !__builtin_cpu_supports("aes")) {
    return targets;
  }
  targets |= HWY_SSE4;
  constexpr unsigned kFeatures = 1, kF16c = 29, kExtendedFeatures = 0x80000001, kLzcnt = 5;
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") ||
      !__builtin_cpu_supports("bmi") || !__builtin_cpu_supports("bmi2") ||
      !has_bit(kFeatures, kF16c) || !has_bit(kExtendedFeatures, kLzcnt)) {
    return targets;
  }
  targets |= HWY_AVX2;
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512cd")) {
    targets |= HWY_AVX3;
  }
  return targets;
}

}  // namespace

std::int64_t SupportedTargets() {
  static const std::int64_t kTargets = find_targets();
  return kTargets;
}

ChosenTarget& GetChosenTarget() {
  static ChosenTarget chosen;
  return chosen;
}

/// Where an assertion of Highway's fails, which only builds with sanitizers have.
void Abort(const char*, int, const char*, ...) {
  std::abort();
}

}  // namespace hwy

#endif
