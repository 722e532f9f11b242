#pragma once

// The last stage of the stateless doors: candidates of the search become the caller's output, in
// the order asked for. What a door writes is its sink:
//   capacity()                  how many fit
//   write(list, begin, end, at) writes those of the list's [begin, end) that count, from `at` on;
//                               returns their number
//   move(from, count, to)       moves what was written

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "harpoon/scene.hpp"
#include "scene/id_order.hpp"
#include "scene/workspace.hpp"

namespace harpoon::scene {

class StopWatch {
 public:
  double lap_ns() noexcept {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double, std::nano> lap = now - last_;
    last_ = now;
    return lap.count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Candidates [begin, end) as pairs of ids, the lower first.
inline std::size_t write_pairs(const std::uint32_t* ids, const Candidates& list, std::size_t begin,
                               std::size_t end, IndexPair* out) noexcept {
  for (std::size_t p = begin; p < end; ++p) {
    const std::uint32_t a = ids[list.i[p]];
    const std::uint32_t b = ids[list.j[p]];
    *out++ = {std::min(a, b), std::max(a, b)};
  }
  return end - begin;
}

/// Writes the lists one after the other. Returns the number written.
template <class Sink>
std::optional<Error> write_lists(const Means& means, std::span<TaskList> lists, const Sink& sink,
                                 std::uint64_t& written) {
  if (lists.size() == 1) {
    written = sink.write(lists[0].list, 0, lists[0].list.count, 0);
    return std::nullopt;
  }
  std::vector<std::size_t> starts(lists.size());
  std::vector<std::size_t> counts(lists.size());
  for (std::size_t t = 1; t < lists.size(); ++t) {
    starts[t] = starts[t - 1] + lists[t - 1].list.count;
  }
  if (auto error = means.run(lists.size(), [&](std::size_t t) {
        counts[t] = sink.write(lists[t].list, 0, lists[t].list.count, starts[t]);
      })) {
    return error;
  }
  written = 0;
  for (std::size_t t = 0; t < lists.size(); ++t) {
    if (written != starts[t] && counts[t] != 0) sink.move(starts[t], counts[t], written);
    written += counts[t];
  }
  return std::nullopt;
}

/// Searches the ordered bodies and writes what is found, unless it does not fit: then
/// `report.contacts` is the number needed. Ids are below `id_count`.
template <class Real, class Cull, class Sink>
std::optional<Error> find_and_write(Workspace::State& state, const Means& means,
                                    const Ordered<Real, Cull>& bodies, const SearchRule& rule,
                                    const Filters& filters, const Sink& sink, ContactOrder order,
                                    std::size_t id_count, StopWatch& watch, DetectReport& report) {
  const PairFilter filter(filters);
  if (auto error = search(means, bodies, rule, filter, sink.capacity(), state.search)) {
    return error;
  }
  const std::span<TaskList> lists(state.search.lists.data(), state.search.used);
  std::uint64_t dropped = 0;
  for (const TaskList& task : lists) {
    report.tests += task.tests;
    dropped += task.dropped;
  }
  report.times.search_ns = watch.lap_ns();
  if (dropped != 0) {
    report.contacts = dropped;
    return std::nullopt;
  }
  std::optional<Error> error;
  if (order == ContactOrder::space) {
    error = write_lists(means, lists, sink, report.contacts);
  } else {
    const IdOrder by_id{state.by_id, state.by_id_starts};
    Candidates list;
    error = order_by_ids(bodies.ids, id_count, lists, by_id, list);
    if (!error) report.contacts = sink.write(list, 0, list.count, 0);
  }
  report.times.contacts_ns = watch.lap_ns();
  return error;
}

/// The report, or the error of an output too small.
inline Result<DetectReport> checked(DetectReport report, std::uint64_t capacity) {
  if (report.contacts <= capacity) return report;
  return Error{
      Errc::capacity,
      fmt::format("{} contacts and room for {}; enlarge the output", report.contacts, capacity),
      report.contacts};
}

}  // namespace harpoon::scene
