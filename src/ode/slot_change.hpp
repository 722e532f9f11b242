#pragma once

// What an update did to the slots of a mirror, so that whatever is kept by slot can follow: pairs
// by asking where a slot's geom is now, arrays by moving their elements along.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace harpoon::ode {

struct SlotChange {
  static constexpr std::uint32_t kGone = UINT32_MAX;

  /// Slots that hold another geom or other bounds than before, ascending.
  std::vector<std::uint32_t> fresh;
  /// The slots that their geoms had, ascending.
  std::vector<std::uint32_t> vacated;
  /// Where the geoms of the first old slots are now, kGone for vacated ones. Those behind stayed.
  std::vector<std::uint32_t> new_slots;

  [[nodiscard]] std::uint32_t now(std::uint32_t old) const {
    return old < new_slots.size() ? new_slots[old] : old;
  }
  [[nodiscard]] bool is_fresh(std::uint32_t slot) const {
    return std::binary_search(fresh.begin(), fresh.end(), slot);
  }

  /// The geoms of the vacated slots have gone to the front, in whatever order. Throws
  /// std::bad_alloc.
  void bring_to_front() {
    const auto count = static_cast<std::uint32_t>(vacated.size());
    fresh.resize(count);
    for (std::uint32_t k = 0; k < count; ++k) fresh[k] = k;
    new_slots.resize(count == 0 ? 0 : std::size_t{vacated.back()} + 1);
    std::uint32_t slot = 0;
    for (std::uint32_t k = 0; k < count; ++k) {
      for (; slot < vacated[k]; ++slot) new_slots[slot] = slot + (count - k);
      new_slots[slot++] = kGone;
    }
  }

  /// The geoms of the vacated slots have changed places among themselves. Throws std::bad_alloc.
  void keep_in_place() {
    fresh = vacated;
    new_slots.resize(vacated.empty() ? 0 : std::size_t{vacated.back()} + 1);
    for (std::uint32_t slot = 0; slot < new_slots.size(); ++slot) new_slots[slot] = slot;
    for (const std::uint32_t slot : vacated) new_slots[slot] = kGone;
  }

  /// Moves the elements of all other slots to where their geoms are now; what is in fresh slots
  /// afterwards has no meaning.
  template <class Element>
  void apply_to(std::vector<Element>& elements) const {
    if (fresh == vacated) return;
    const auto at = [&](std::size_t slot) {
      return elements.begin() + static_cast<std::ptrdiff_t>(slot);
    };
    const std::size_t count = vacated.size();
    for (std::size_t k = count; k-- > 0;) {
      const std::size_t begin = k == 0 ? 0 : std::size_t{vacated[k - 1]} + 1;
      const std::size_t end = vacated[k];
      std::move_backward(at(begin), at(end), at(end + (count - k)));
    }
  }
};

}  // namespace harpoon::ode
