#pragma once

// The search over ordered bodies: blocks handed to tasks, candidates collected with bounded memory.

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "broad/order.hpp"
#include "harpoon/scene.hpp"

namespace harpoon::broad {

/// Decides by ids which pairs count.
class PairFilter {
 public:
  explicit PairFilter(const Filters& filters) noexcept : filters_(filters) {}
  [[nodiscard]] bool active() const noexcept {
    return !filters_.category.empty() || !filters_.owner.empty() || !filters_.rest.empty();
  }
  [[nodiscard]] bool counts(std::uint32_t a, std::uint32_t b) const noexcept {
    const auto rests = [&](std::uint32_t id) { return filters_.rest[id] != Rest::awake; };
    if (!filters_.category.empty() && (filters_.category[a] & filters_.collide[b]) == 0 &&
        (filters_.category[b] & filters_.collide[a]) == 0) {
      return false;
    }
    if (!filters_.owner.empty() && filters_.owner[a] == filters_.owner[b] &&
        filters_.owner[a] != 0) {
      return false;
    }
    return filters_.rest.empty() || !(rests(a) && rests(b));
  }

 private:
  Filters filters_;
};

/// Candidates of one task and their memory.
struct TaskList {
  Buffer memory;
  Candidates list;
  std::uint64_t tests = 0;
  std::uint64_t dropped = 0;  ///< contacts found after the limit was passed
};

/// What the search leaves behind. When `dropped` is 0 in all lists, the lists hold all pairs that
/// were asked for, filtered, in order.
struct SearchMemory {
  std::vector<TaskList> lists;
  std::size_t used = 0;             ///< lists of the latest search
  bool gave_up = false;             ///< it took too many tests: nothing is known
  std::uint64_t tests_in_vain = 0;  ///< when it gave up: those that it was given

  [[nodiscard]] std::size_t bytes() const noexcept {
    std::size_t sum = 0;
    for (const TaskList& list : lists) sum += list.memory.bytes();
    return sum;
  }

  /// Pairs tested by the latest search.
  [[nodiscard]] std::uint64_t tests() const noexcept {
    if (gave_up) return tests_in_vain;
    std::uint64_t sum = 0;
    for (std::size_t k = 0; k < used; ++k) sum += lists[k].tests;
    return sum;
  }

  [[nodiscard]] std::uint64_t dropped() const noexcept {
    std::uint64_t sum = 0;
    for (std::size_t k = 0; k < used; ++k) sum += lists[k].dropped;
    return sum;
  }
};

/// What the ordered bodies are, and which pairs of them are asked for.
struct SearchRule {
  enum class Kind : std::uint8_t {
    near_spheres,      ///< those that culling finds, contacts among them
    touching_spheres,  ///< contacts
    boxes,             ///< overlaps
  };
  Kind kind = Kind::touching_spheres;
  const BoxJudge* judge = nullptr;  ///< of boxes
  bool judge_touching = false;
};

/// Tests for each body, on average, after which a search in grids gives up: something is wrong with
/// them. Trees are never given up.
inline constexpr std::uint64_t kMostTests = 256;

/// Searches. When there are more than `limit` pairs, they are counted, not kept: then the sum of
/// `dropped` over all lists is their exact number and all lists are empty. A search for near
/// spheres ends there instead, and the sum is only beyond the limit.
template <class Real, class Cull>
std::optional<Error> search(const Means& means, const Ordered<Real, Cull>& bodies,
                            const SearchRule& rule, const PairFilter& filter, std::uint64_t limit,
                            SearchMemory& memory);

}  // namespace harpoon::broad
