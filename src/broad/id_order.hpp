#pragma once

// Candidates in ascending order of ids. They are first parted by ranges of the lower id, then each
// part is counted by it and each run sorted by the higher: parts fit a cache and are shared between
// threads.

#include <cstdint>
#include <optional>
#include <span>

#include "base/buffer.hpp"
#include "broad/search.hpp"
#include "harpoon/error.hpp"

namespace harpoon::broad {

/// What an ordering needs, and the memory of its result.
struct IdOrderMemory {
  Buffer list;  ///< the result
  Buffer parted, ordered, starts, counts;

  [[nodiscard]] std::size_t bytes() const noexcept {
    return bytes_of(list, parted, ordered, starts, counts);
  }
};

/// Merges the lists into `out`, whose memory is `memory.list`; i is the body of the lower id.
/// `bodies` is one more than the largest id. Throws std::bad_alloc only.
std::optional<Error> order_by_ids(const Means& means, const std::uint32_t* ids, std::size_t bodies,
                                  std::span<const TaskList> lists, IdOrderMemory& memory,
                                  Candidates& out);

/// The same with ids, not sorted positions, as the result.
std::optional<Error> ids_in_order(const Means& means, const std::uint32_t* ids, std::size_t bodies,
                                  std::span<const TaskList> lists, IdOrderMemory& memory,
                                  Candidates& out);

}  // namespace harpoon::broad
