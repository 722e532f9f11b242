#pragma once

// Puts pairs into rows: all pairs whose first geom comes first in the space, then those of the
// next, and within a row by a key. Every order rule of libode has this shape.

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "harpoon/records.hpp"

namespace harpoon::ode {

/// A pair on its way into order: `first` and `second` are o1 and o2 of the callback.
struct KeyedPair {
  std::uint64_t key;
  std::uint32_t first, second;
};

class RowOrder {
 public:
  /// Pairs to be ordered, filled by the caller.
  std::vector<KeyedPair> pairs;

  /// Appends `pairs` to `out`, by `row_of(first)` (below `rows`), then by key. Keys of a row
  /// differ. O(pairs), rows being short. Throws std::bad_alloc.
  template <class RowOf>
  void append_to(std::vector<IndexPair>& out, std::uint32_t rows, const RowOf& row_of) {
    starts_.assign(std::size_t{rows} + 1, 0);
    for (const KeyedPair& pair : pairs) ++starts_[row_of(pair.first)];
    std::uint32_t next = 0;
    for (std::uint32_t& start : starts_) next += std::exchange(start, next);
    sorted_.resize(pairs.size());
    for (const KeyedPair& pair : pairs) sorted_[starts_[row_of(pair.first)]++] = pair;
    finish(out, rows);
  }

 private:
  void finish(std::vector<IndexPair>& out, std::uint32_t rows);

  std::vector<std::uint32_t> starts_;
  std::vector<KeyedPair> sorted_;
};

}  // namespace harpoon::ode
