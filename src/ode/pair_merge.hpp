#pragma once

// Puts a few new pairs into a long sequence that is in order already: for spaces of which few geoms
// have moved. What the order is the caller says, as a place for each pair.

#include <algorithm>
#include <compare>
#include <cstdint>
#include <vector>

#include "harpoon/records.hpp"
#include "ode/slot_change.hpp"

namespace harpoon::ode {

/// Where a pair stands among all pairs of a space. Places of different pairs differ.
struct Place {
  std::uint64_t row, key;
  auto operator<=>(const Place&) const = default;
};

struct PlacedPair {
  Place place;
  IndexPair pair;
};

/// Drops the pairs of geoms in vacated slots and renames the others' slots.
inline void keep_unchanged(const SlotChange& change, std::vector<IndexPair>& pairs) {
  std::size_t kept = 0;
  for (const IndexPair pair : pairs) {
    const std::uint32_t first = change.now(pair.g1), second = change.now(pair.g2);
    pairs[kept] = {first, second};
    kept += first != SlotChange::kGone && second != SlotChange::kGone ? 1 : 0;
  }
  pairs.resize(kept);
}

/// Inserts `added`, in any order, into `pairs`, which are in order. `row_of(pair)` and
/// `key_of(pair)` give a pair's place; the key is asked for within its row only. O(pairs + added
/// log pairs). Throws std::bad_alloc; `pairs` is then unchanged.
template <class RowOf, class KeyOf>
void insert_in_order(std::vector<IndexPair>& pairs, std::vector<PlacedPair>& added,
                     const RowOf& row_of, const KeyOf& key_of) {
  std::sort(added.begin(), added.end(),
            [](const PlacedPair& a, const PlacedPair& b) { return a.place < b.place; });
  const auto is_before = [&](const IndexPair& pair, const Place& place) {
    const std::uint64_t row = row_of(pair);
    return row != place.row ? row < place.row : key_of(pair) < place.key;
  };
  // From the back: each stretch between two of the new ones moves once.
  std::size_t end = pairs.size();
  pairs.resize(pairs.size() + added.size());
  for (std::size_t left = added.size(); left > 0; --left) {
    const auto last = pairs.begin() + static_cast<std::ptrdiff_t>(end);
    const auto at = std::lower_bound(pairs.begin(), last, added[left - 1].place, is_before);
    std::move_backward(at, last, last + static_cast<std::ptrdiff_t>(left));
    end = static_cast<std::size_t>(at - pairs.begin());
    pairs[end + left - 1] = added[left - 1].pair;
  }
}

}  // namespace harpoon::ode
