#include "scene/id_order.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace harpoon::scene {
namespace {

/// The higher id and both sorted positions of a candidate.
struct Entry {
  std::uint32_t high, i, j;
};

template <class Visit>
void each_candidate(const std::uint32_t* ids, std::span<const TaskList> lists, const Visit& visit) {
  for (const TaskList& task : lists) {
    for (std::size_t p = 0; p < task.list.count; ++p) {
      const std::uint32_t i = task.list.i[p];
      const std::uint32_t j = task.list.j[p];
      if (ids[i] < ids[j]) {
        visit(ids[i], Entry{ids[j], i, j});
      } else {
        visit(ids[j], Entry{ids[i], j, i});
      }
    }
  }
}

}  // namespace

std::optional<Error> order_by_ids(const std::uint32_t* ids, std::size_t bodies,
                                  std::span<const TaskList> lists, const IdOrder& memory,
                                  Candidates& out) noexcept {
  std::size_t count = 0;
  for (const TaskList& task : lists) count += task.list.count;
  if (count > std::numeric_limits<std::uint32_t>::max()) {
    return Error{Errc::batch_too_large, "pairs > 2^32-1"};
  }
  const std::size_t entry_words = sizeof(Entry) / sizeof(std::uint32_t);
  if (!memory.starts.reserve((bodies + 1) * sizeof(std::uint32_t)) ||
      !memory.list.reserve((entry_words + 2) * (count + kSlack) * sizeof(std::uint32_t))) {
    return Error{Errc::out_of_memory, "out of memory"};
  }
  auto* const starts = memory.starts.as<std::uint32_t>();
  auto* const entries = memory.list.as<Entry>();
  std::fill(starts, starts + bodies + 1, 0U);
  each_candidate(ids, lists, [&](std::uint32_t low, const Entry&) { ++starts[low]; });
  std::uint32_t position = 0;
  for (std::size_t b = 0; b <= bodies; ++b) position += std::exchange(starts[b], position);
  each_candidate(ids, lists,
                 [&](std::uint32_t low, const Entry& e) { entries[starts[low]++] = e; });
  out.i = memory.list.as<std::uint32_t>() + entry_words * (count + kSlack);
  out.j = out.i + count + kSlack;
  out.count = out.capacity = count;
  std::uint32_t begin = 0;
  for (std::size_t b = 0; b < bodies; ++b) {
    const std::uint32_t end = starts[b];
    if (end - begin > 1) {
      std::sort(entries + begin, entries + end,
                [](const Entry& a, const Entry& c) { return a.high < c.high; });
    }
    for (std::uint32_t p = begin; p < end; ++p) {
      out.i[p] = entries[p].i;
      out.j[p] = entries[p].j;
    }
    begin = end;
  }
  return std::nullopt;
}

}  // namespace harpoon::scene
