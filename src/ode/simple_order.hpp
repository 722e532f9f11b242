#pragma once

// The order of a simple space's callbacks: i < j in list order, row by row, (gi, gj).

#include <span>
#include <vector>

#include "harpoon/records.hpp"
#include "ode/row_order.hpp"

namespace harpoon::ode {

/// Appends the pairs (i < j of the mirror's order) to `out` in the simple space's order.
inline void append_in_simple_order(std::span<const IndexPair> pairs, std::uint32_t geoms,
                                   RowOrder& rows, std::vector<IndexPair>& out) {
  rows.pairs.resize(pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    rows.pairs[k] = {pairs[k].g2, pairs[k].g1, pairs[k].g2};
  }
  rows.append_to(out, geoms, [](std::uint32_t first) { return first; });
}

}  // namespace harpoon::ode
