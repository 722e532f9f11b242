#pragma once

// The last stage of the stateless doors: what the search found becomes the caller's output, in the
// order asked for. What a door writes is its sink:
//   capacity()                  how many fit
//   write(list, begin, end, at) writes the list's [begin, end) from `at` on

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "broad/id_order.hpp"
#include "harpoon/scene.hpp"
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

/// Pairs of ids as the output, the lower first.
struct PairSink {
  const std::uint32_t* ids;
  std::span<IndexPair> out;

  [[nodiscard]] std::uint64_t capacity() const noexcept { return out.size(); }
  void write(const broad::Candidates& list, std::size_t begin, std::size_t end,
             std::size_t at) const noexcept {
    for (std::size_t p = begin; p < end; ++p) {
      const std::uint32_t a = ids[list.i[p]];
      const std::uint32_t b = ids[list.j[p]];
      out[at++] = {std::min(a, b), std::max(a, b)};
    }
  }
};

/// Fewest records of a piece of work.
inline constexpr std::size_t kPieceRecords = 2048;

/// Writes the lists one after the other; `written` becomes the number of records.
template <class Sink>
std::optional<Error> write_lists(const broad::Means& means,
                                 std::span<const broad::Candidates> lists, const Sink& sink,
                                 std::uint64_t& written) {
  std::vector<std::size_t> starts = {0};
  for (const broad::Candidates& list : lists) starts.push_back(starts.back() + list.count);
  written = starts.back();
  const auto write = [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t l = 0; begin < end; ++l) {
      const std::size_t stop = std::min(end, starts[l + 1]);
      if (stop <= begin) continue;
      sink.write(lists[l], begin - starts[l], stop - starts[l], begin);
      begin = stop;
    }
  };
  return means.run_pieces(starts.back(), kPieceRecords, write);
}

/// Searches the ordered bodies and writes what is found, unless it does not fit: then
/// `report.contacts` is the number needed. Ids are below `id_count`. Nothing is written where the
/// search gives up, which `state.search` says.
template <class Real, class Cull, class Sink>
std::optional<Error> find_and_write(Workspace::State& state, const broad::Means& means,
                                    const broad::Ordered<Real, Cull>& bodies,
                                    const broad::SearchRule& rule, const Filters& filters,
                                    const Sink& sink, ContactOrder order, std::size_t id_count,
                                    StopWatch& watch, DetectReport& report) {
  const broad::PairFilter filter(filters);
  if (auto error = broad::search(means, bodies, rule, filter, sink.capacity(), state.search)) {
    return error;
  }
  report.tests += state.search.tests();
  report.times.search_ns += watch.lap_ns();
  if (state.search.gave_up) return std::nullopt;
  const std::span<broad::TaskList> lists(state.search.lists.data(), state.search.used);
  if (const std::uint64_t dropped = state.search.dropped(); dropped != 0) {
    report.contacts = dropped;
    return std::nullopt;
  }
  std::vector<broad::Candidates> ordered;
  if (order == ContactOrder::space) {
    for (const broad::TaskList& task : lists) ordered.push_back(task.list);
  } else {
    ordered.emplace_back();
    if (auto error =
            broad::order_by_ids(means, bodies.ids, id_count, lists, state.by_id, ordered[0])) {
      return error;
    }
  }
  auto error = write_lists(means, ordered, sink, report.contacts);
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
