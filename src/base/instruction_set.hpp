#pragma once

// The instruction sets that Highway's kernels are compiled for, by public name, and the choice of
// one of them for a call. Shared by all files with kernels; knows nothing of what they compute.

#include <hwy/targets.h>

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace harpoon {

/// Targets that this build holds and this machine runs, as Highway's bits: the lowest is widest.
std::int64_t usable_targets() noexcept;

/// The field's name of an instruction set where Highway's differs: its fallback target is compiled
/// for the architecture's baseline (on x86-64 that is SSE2), its AVX3 is AVX-512. Static storage.
std::string_view name_of_target(std::int64_t target) noexcept;

/// The usable target of that name, the widest for an empty name; 0 when there is none.
std::int64_t find_target(std::string_view name) noexcept;

/// Calls a function of a HWY_DISPATCH_TABLE for one of the usable targets.
template <class Function, std::size_t kSize>
auto call_for_target(const Function (&table)[kSize], std::int64_t target) {
#if (HWY_TARGETS & (HWY_TARGETS - 1)) == 0
  static_cast<void>(target);  // the only one
  return table[0]();
#else
  hwy::ChosenTarget chosen;
  chosen.Update(target);
  return table[chosen.GetIndex()]();
#endif
}

}  // namespace harpoon
