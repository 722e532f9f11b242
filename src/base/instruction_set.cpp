#include "base/instruction_set.hpp"

namespace harpoon {

std::int64_t usable_targets() noexcept {
  return hwy::SupportedTargets() & HWY_TARGETS;
}

std::string_view name_of_target(std::int64_t target) noexcept {
  if (target == HWY_EMU128 || target == HWY_SCALAR) {
    return HWY_ARCH_X86 != 0 ? "SSE2" : "baseline";
  }
  if (target == HWY_AVX3) return "AVX-512";
  return hwy::TargetName(target);
}

std::int64_t find_target(std::string_view name) noexcept {
  for (std::int64_t rest = usable_targets(); rest != 0; rest &= rest - 1) {
    const std::int64_t target = rest & -rest;
    if (name.empty() || name == name_of_target(target)) return target;
  }
  return 0;
}

}  // namespace harpoon
