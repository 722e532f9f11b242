#include "broad/id_order.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/out_of_memory.hpp"

namespace harpoon::broad {
namespace {

/// Candidates that a part should hold.
constexpr std::size_t kPartCandidates = 8192;
constexpr std::size_t kMaxParts = 512;

/// A candidate by its ids.
struct IdPair {
  std::uint32_t low, high;

  static IdPair of(std::uint32_t low, std::uint32_t high, std::uint32_t, std::uint32_t) noexcept {
    return {low, high};
  }
  void write(Candidates& out, std::uint32_t at) const noexcept {
    out.i[at] = low;
    out.j[at] = high;
  }
};

/// A candidate by its ids, with the sorted positions of the same bodies.
struct PlacedPair {
  std::uint32_t low, high, i, j;

  static PlacedPair of(std::uint32_t low, std::uint32_t high, std::uint32_t i,
                       std::uint32_t j) noexcept {
    return {low, high, i, j};
  }
  void write(Candidates& out, std::uint32_t at) const noexcept {
    out.i[at] = i;
    out.j[at] = j;
  }
};

/// One ordering under way. `Pair` is what is carried through it.
template <class Pair>
class IdSorter {
 public:
  IdSorter(const Means& means, const std::uint32_t* ids, std::size_t bodies,
           std::span<const TaskList> lists, IdOrderMemory& memory) noexcept
      : means_(means), ids_(ids), bodies_(bodies), lists_(lists), memory_(memory) {}

  std::optional<Error> run(Candidates& out) {
    std::size_t count = 0;
    for (const TaskList& task : lists_) count += task.list.count;
    if (count > std::numeric_limits<std::uint32_t>::max()) {
      return Error{Errc::batch_too_large, "pairs > 2^32-1"};
    }
    const std::size_t wanted = std::clamp<std::size_t>(count / kPartCandidates, 1, kMaxParts);
    while ((bodies_ >> shift_) >= wanted && shift_ < 31) ++shift_;
    parts_ = (bodies_ >> shift_) + 1;
    if (!reserve(count)) return out_of_memory();
    out.i = memory_.list.as<std::uint32_t>();
    out.j = out.i + count + kSlack;
    out.count = out.capacity = count;
    if (auto error = part()) return error;
    return means_.run(parts_, [&](std::size_t part) { order(part, out); });
  }

 private:
  bool reserve(std::size_t count) noexcept {
    return memory_.list.reserve(2 * (count + kSlack) * sizeof(std::uint32_t)) &&
           memory_.parted.reserve((count + 1) * sizeof(Pair)) &&
           memory_.ordered.reserve((count + 1) * sizeof(Pair)) &&
           memory_.starts.reserve((parts_ << shift_) * sizeof(std::uint32_t)) &&
           memory_.counts.reserve((lists_.size() + 1) * (parts_ + 1) * sizeof(std::uint32_t));
  }

  template <class Visit>
  void each_pair(const Candidates& list, const Visit& visit) const {
    for (std::size_t p = 0; p < list.count; ++p) {
      const std::uint32_t i = list.i[p];
      const std::uint32_t j = list.j[p];
      const bool ascending = ids_[i] < ids_[j];
      visit(ascending ? Pair::of(ids_[i], ids_[j], i, j) : Pair::of(ids_[j], ids_[i], j, i));
    }
  }

  [[nodiscard]] std::uint32_t* counts_of(std::size_t list) const noexcept {
    return memory_.counts.as<std::uint32_t>() + list * parts_;
  }
  /// First candidate of each part, and the end of the last.
  [[nodiscard]] std::uint32_t* part_starts() const noexcept { return counts_of(lists_.size()); }

  std::optional<Error> part() {
    if (auto error = means_.run(lists_.size(), [&](std::size_t l) {
          std::uint32_t* const counts = counts_of(l);
          std::fill(counts, counts + parts_, 0U);
          each_pair(lists_[l].list, [&](const Pair& pair) { ++counts[pair.low >> shift_]; });
        })) {
      return error;
    }
    std::uint32_t position = 0;
    for (std::size_t part = 0; part < parts_; ++part) {
      part_starts()[part] = position;
      for (std::size_t l = 0; l < lists_.size(); ++l) {
        position += std::exchange(counts_of(l)[part], position);
      }
    }
    part_starts()[parts_] = position;
    return means_.run(lists_.size(), [&](std::size_t l) {
      std::uint32_t* const next = counts_of(l);
      auto* const parted = memory_.parted.as<Pair>();
      each_pair(lists_[l].list,
                [&](const Pair& pair) { parted[next[pair.low >> shift_]++] = pair; });
    });
  }

  void order(std::size_t part, Candidates& out) const {
    const std::uint32_t begin = part_starts()[part];
    const std::uint32_t end = part_starts()[part + 1];
    if (begin == end) return;
    const auto* const parted = memory_.parted.as<Pair>();
    auto* const ordered = memory_.ordered.as<Pair>();
    const std::size_t ids = std::size_t{1} << shift_;
    std::uint32_t* const next = memory_.starts.as<std::uint32_t>() + part * ids;
    const auto first_id = static_cast<std::uint32_t>(part * ids);
    std::fill(next, next + ids, 0U);
    for (std::uint32_t p = begin; p < end; ++p) ++next[parted[p].low - first_id];
    std::uint32_t position = begin;
    for (std::size_t id = 0; id < ids; ++id) position += std::exchange(next[id], position);
    for (std::uint32_t p = begin; p < end; ++p)
      ordered[next[parted[p].low - first_id]++] = parted[p];
    for (std::uint32_t run = begin; run < end;) {
      const std::uint32_t run_end = next[ordered[run].low - first_id];
      if (run_end - run > 1) {
        std::sort(ordered + run, ordered + run_end,
                  [](const Pair& a, const Pair& b) { return a.high < b.high; });
      }
      for (; run < run_end; ++run) ordered[run].write(out, run);
    }
  }

  const Means& means_;
  const std::uint32_t* ids_;
  std::size_t bodies_;
  std::span<const TaskList> lists_;
  IdOrderMemory& memory_;
  std::uint32_t shift_ = 0;
  std::size_t parts_ = 1;
};

}  // namespace

std::optional<Error> order_by_ids(const Means& means, const std::uint32_t* ids, std::size_t bodies,
                                  std::span<const TaskList> lists, IdOrderMemory& memory,
                                  Candidates& out) {
  return IdSorter<PlacedPair>(means, ids, bodies, lists, memory).run(out);
}

std::optional<Error> ids_in_order(const Means& means, const std::uint32_t* ids, std::size_t bodies,
                                  std::span<const TaskList> lists, IdOrderMemory& memory,
                                  Candidates& out) {
  return IdSorter<IdPair>(means, ids, bodies, lists, memory).run(out);
}

}  // namespace harpoon::broad
