#pragma once

// Records made in parallel and written without gaps in the order of their chunks, although how many
// a chunk has is known only when they are made. A task makes a chunk in memory of its own, small
// enough for a cache; when the chunks before it have said how many they have, it knows its place
// and copies. Only those numbers pass from task to task, so nobody waits for another's copy.

#include <atomic>
#include <cstdint>
#include <cstring>
#include <optional>

#include "base/buffer.hpp"
#include "base/out_of_memory.hpp"
#include "broad/order.hpp"
#include "harpoon/error.hpp"

namespace harpoon::scene {

/// Most records of a chunk.
inline constexpr std::size_t kChunkRecords = 2048;

/// Hands out chunks and, in their order, places.
class ChunkTurns {
 public:
  std::uint32_t next_chunk() noexcept { return next_.fetch_add(1, std::memory_order_relaxed); }

  /// Where the records of `chunk` begin, once all chunks before it have taken their places.
  std::uint64_t take_place(std::uint32_t chunk, std::uint64_t records) noexcept {
    for (;;) {
      const std::uint32_t turn = turn_.load(std::memory_order_acquire);
      if (turn == chunk) break;
      turn_.wait(turn, std::memory_order_acquire);
    }
    const std::uint64_t begin = records_;
    records_ += records;
    turn_.store(chunk + 1, std::memory_order_release);
    turn_.notify_all();
    return begin;
  }

  /// Of all chunks; after the last one.
  [[nodiscard]] std::uint64_t records() const noexcept { return records_; }

 private:
  std::atomic<std::uint32_t> next_{0};
  std::atomic<std::uint32_t> turn_{0};  ///< whose place is next; guards `records_`
  std::uint64_t records_ = 0;
};

/// Writes the records of all chunks to `out`; `written` becomes their number. make(chunk, to)
/// writes those of a chunk, at most kChunkRecords, and returns their number. A chunk is only begun
/// when all before it have been, so nothing waits for what has not started, whatever runs the
/// tasks.
template <class Record, class Make>
std::optional<Error> write_in_order(const broad::Means& means, std::uint32_t chunks,
                                    Buffer& scratch, Record* out, const Make& make,
                                    std::uint64_t& written) {
  const unsigned tasks = means.threads();
  if (!scratch.reserve(tasks * kChunkRecords * sizeof(Record))) {
    return out_of_memory();
  }
  ChunkTurns turns;
  auto error = means.run(tasks, [&](std::size_t task) {
    auto* const mine = scratch.as<Record>() + task * kChunkRecords;
    for (std::uint32_t chunk; (chunk = turns.next_chunk()) < chunks;) {
      const std::size_t records = make(chunk, mine);
      const std::uint64_t begin = turns.take_place(chunk, records);
      std::memcpy(static_cast<void*>(out + begin), mine, records * sizeof(Record));
    }
  });
  written = turns.records();
  return error;
}

}  // namespace harpoon::scene
