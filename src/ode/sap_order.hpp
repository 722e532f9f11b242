#pragma once

// The order of a sweep-and-prune space's callbacks.
//
// dxSAPSpace sorts the lower bounds on its first axis, rounded to float, with a radix sort that
// goes on from the ranks of the call before: among equal bounds the previous order stays, reversed
// for negative ones. So the order depends on history, and a space is followed from its creation on.
// A geom is paired with those after it whose lower bound does not exceed its upper one (as floats)
// and that overlap on the other axes. Geoms unbounded on the first axis come last: each with those
// after it, then with every bounded geom, without any test of bounds.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ode/candidates.hpp"
#include "ode/mirror.hpp"
#include "ode/pair_merge.hpp"
#include "ode/row_order.hpp"
#include "ode/sap_sweep.hpp"

namespace harpoon::ode {

template <class Real>
class SapOrder {
 public:
  /// `axis_order` is that of dSweepAndPruneSpaceCreate.
  explicit SapOrder(int axis_order);

  [[nodiscard]] int axis_order() const { return axes_[0] | axes_[1] << 2 | axes_[2] << 4; }
  /// Whether the axes are three different ones: others are left to libode.
  [[nodiscard]] bool usable() const;

  /// Whether libode's own sweep is the fastest way, which makes no mirror first, and the last
  /// call's order is one that it finds by itself, whatever it knows of the calls before.
  [[nodiscard]] bool is_for_libode() const { return is_for_libode_; }

  /// Whether libode's own sweep would have next to nothing to do: from some of a clean space's
  /// geoms. `count` is that of all.
  [[nodiscard]] bool is_sparse(const GeomReader<Real>& reader, dxSpace* space, int count) const;

  /// Whether the mirror has one order only, whatever that of the call before was. Throws
  /// std::bad_alloc.
  [[nodiscard]] bool finds_one_order(const Mirror<Real>& mirror);

  /// How many of the mirror's geoms are sorted: the number that libode's history hangs on.
  [[nodiscard]] std::size_t sorted_geoms(const Mirror<Real>& mirror) const;

  /// Appends all pairs of the mirror to `out` in the space's order, and takes over the ranks: to be
  /// called once for each call that the space would have seen. Errors: as `CandidateFinder::find`.
  [[nodiscard]] std::optional<Error> append(const Mirror<Real>& mirror,
                                            CandidateFinder<Real>& finder, RowOrder& rows,
                                            std::vector<IndexPair>& out);

  /// Whether two geoms are sorted ones whose bounds overlap as the space compares them.
  [[nodiscard]] bool overlap(const Mirror<Real>& mirror, std::uint32_t i, std::uint32_t j) const;
  /// Does what `append` does where `pairs` are those of the call before and only the geoms of fresh
  /// slots have changed since. `fresh` are the pairs that these have now. Throws std::bad_alloc.
  void update(const Mirror<Real>& mirror, const SlotChange& change,
              std::span<const IndexPair> fresh, RowOrder& rows, std::vector<IndexPair>& pairs);

 private:
  /// Splits the mirror into geoms bounded and unbounded on the first axis.
  void split(const Mirror<Real>& mirror);
  /// Brings `ranks_` from the last call's order to that of `lows_`.
  void sort();
  [[nodiscard]] bool is_sorted() const;
  [[nodiscard]] bool sort_by_insertion();
  void sort_by_radix();
  void reverse_negative_runs();
  void sweep(const Mirror<Real>& mirror, std::vector<IndexPair>& out);
  [[nodiscard]] bool sweep_in_lanes(const Mirror<Real>& mirror, std::vector<IndexPair>& out);
  [[nodiscard]] std::optional<Error> search(const Mirror<Real>& mirror,
                                            CandidateFinder<Real>& finder, RowOrder& rows,
                                            std::vector<IndexPair>& out);
  /// Takes note of the order of sorted geoms and how many pairs there are of them.
  void note_sorted(std::size_t pairs);
  /// Notes which geom has which rank.
  void number_geoms(const Mirror<Real>& mirror);
  /// Appends pairs of sorted geoms, in any order and orientation, in the space's order.
  void append_by_rank(std::span<const IndexPair> pairs, RowOrder& rows,
                      std::vector<IndexPair>& out) const;
  /// Whether geoms that stayed as they were follow each other as in `sorted_geoms_`.
  [[nodiscard]] bool keeps_order(const SlotChange& change) const;
  void append_unbounded(const Mirror<Real>& mirror, std::vector<IndexPair>& out) const;

  /// What the sweep reads of a geom.
  struct Sorted {
    Real low1, high1, low2, high2;
    float low0, high0;
    std::uint32_t geom;
  };

  int axes_[3];
  SapSweep<Real> lanes_;
  std::vector<Sorted> sorted_;
  std::vector<std::uint32_t> bounded_, unbounded_;  ///< geoms of the mirror
  std::vector<float> lows_, highs_;                 ///< of `bounded_`
  std::vector<std::uint32_t> ranks_;                ///< positions in `bounded_`, sorted
  std::vector<std::uint64_t> keys_, keys_scratch_;
  std::vector<BoundsBox<Real>> rounded_;
  std::vector<std::uint8_t> skip_;
  std::vector<std::uint32_t> rank_of_geom_;  ///< of sorted ones
  std::vector<std::uint32_t> sorted_geoms_;  ///< by rank, of the last call
  std::size_t sorted_pairs_ = 0;             ///< the first of the last call's pairs
  std::vector<IndexPair> both_;
  std::vector<PlacedPair> placed_;
  bool is_for_libode_ = false;
};

}  // namespace harpoon::ode
