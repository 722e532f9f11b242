#pragma once

// The order of a hash space's callbacks, and which pairs the hash space misses.
//
// dxHashSpace puts each geom into cells of size 2^level, level being the smallest that holds its
// largest extent, and takes the geoms in list order. Each looks into its own cells and then, level
// by level, into those of larger ones around it; x, y, z ascending, and in a cell at those first
// that were put there last. So a row is sorted by (level, first common cell, descending partner).
// Geoms above the highest level are compared with all others at the end.
//
// The defect: a cell's bucket is (base(level, x, y) + z) mod size in unsigned arithmetic, counted
// up from the geom's lowest z. Where base + lowest z is negative it wraps, and the geom's cells in
// that column lie in other buckets than those of a geom for which it does not: the two are not
// found.

#include <cstdint>
#include <span>
#include <vector>

#include "ode/mirror.hpp"
#include "ode/pair_merge.hpp"
#include "ode/row_order.hpp"

namespace harpoon::ode {

template <class Real>
class HashOrder {
 public:
  /// Discretises the mirror's bounds. Afterwards `stray` marks the geoms that libode would abort
  /// on, and `skip` those of them that take part in nothing, NaN; the others are compared with all.
  void prepare(const Mirror<Real>& mirror, int min_level, int max_level);
  [[nodiscard]] std::span<const std::uint8_t> stray() const { return stray_; }
  [[nodiscard]] bool has_stray() const { return has_stray_; }
  [[nodiscard]] std::span<const std::uint8_t> skip() const {
    return has_nan_ ? std::span<const std::uint8_t>(skip_) : std::span<const std::uint8_t>();
  }

  /// Appends the pairs to `out` in the hash space's order. Those that the hash space misses are
  /// left out when `as_stock`. Returns how many it misses.
  std::size_t append(std::span<const IndexPair> pairs, bool as_stock, RowOrder& rows,
                     std::vector<IndexPair>& out);

  /// After `prepare` or another update: follows a change of the mirror. False when there are strays
  /// now: everything is to be prepared anew. Throws std::bad_alloc; the same.
  [[nodiscard]] bool update(const Mirror<Real>& mirror, const SlotChange& change, int min_level,
                            int max_level);
  /// Turns a pair into o1 and o2.
  [[nodiscard]] IndexPair oriented(IndexPair pair) const {
    const std::int32_t level1 = cells_[pair.g1].level, level2 = cells_[pair.g2].level;
    const bool swap = level1 != level2 ? level2 < level1 : pair.g2 < pair.g1;
    return swap ? IndexPair{pair.g2, pair.g1} : pair;
  }
  enum class Found : std::uint8_t { yes, missed, never };
  /// Whether a hash space finds an oriented pair, and where it stands in its order: the row first.
  [[nodiscard]] std::uint64_t row_of(IndexPair oriented) const;
  Found key_of(IndexPair oriented, std::uint64_t& key) const;

 private:
  /// A geom's cells at its own level; `level` is kBig for those compared with all.
  struct Cells {
    std::int32_t level;
    std::int32_t low[3], high[3];
  };
  static constexpr std::int32_t kBig = INT32_MAX;

  bool discretise(const BoundsBox<Real>& box, int min_level, int max_level, Cells& cells);
  /// The key of a pair of which neither is big, `first` being the one whose row it is in.
  Found small_key_of(std::uint32_t first, std::uint32_t second, std::uint64_t& key) const;

  std::vector<Cells> cells_;
  std::vector<std::uint8_t> stray_, skip_;
  std::vector<KeyedPair> big_;
  bool has_stray_ = false, has_nan_ = false;
  int scale_level_ = INT32_MIN;  ///< whose cells' reciprocal size is in hand
  Real scale_ = 0;
};

}  // namespace harpoon::ode
