#pragma once

// The machine's copy bandwidth: what a batch of pairs, which reads as many bytes as it writes, can
// reach at best. Two ways to copy, because a plain copy of large blocks reads the destination
// first.

#include <cstddef>
#include <memory>
#include <span>

#include "bench/contestant.hpp"

namespace harpoon::bench {

enum class CopyMethod : std::uint8_t {
  library,  ///< std::memcpy
  /// Stores past the caches (x86: widest streaming store, each page of the target touched ahead of
  /// it), else as `library`.
  non_temporal,
};

/// Copies `source` to `target` (equal sizes) with `threads` threads, each its own slice.
/// O(bytes). The threads are started and joined inside.
void copy_with(CopyMethod method, std::span<const std::byte> source, std::span<std::byte> target,
               unsigned threads);

/// A turn of `count` copies 32 * count bytes, read and written: the traffic of so many f32 pairs.
/// The label's device is "copy" and its format "memcpy" or "non-temporal". Buffers must outlive it.
std::unique_ptr<Contestant> make_copy_contestant(CopyMethod method,
                                                 std::span<const std::byte> source,
                                                 std::span<std::byte> target, unsigned threads);

}  // namespace harpoon::bench
