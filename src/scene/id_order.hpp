#pragma once

// Candidates in ascending order of ids: counted by the lower id, then each run sorted by the
// higher.

#include <cstdint>
#include <optional>
#include <span>

#include "harpoon/error.hpp"
#include "scene/buffer.hpp"
#include "scene/search.hpp"

namespace harpoon::scene {

struct IdOrder {
  Buffer& list;
  Buffer& starts;
};

/// Merges the lists into `out`, whose memory is `memory.list`: i has the lower id. `bodies` is one
/// more than the largest id.
std::optional<Error> order_by_ids(const std::uint32_t* ids, std::size_t bodies,
                                  std::span<const TaskList> lists, const IdOrder& memory,
                                  Candidates& out) noexcept;

}  // namespace harpoon::scene
