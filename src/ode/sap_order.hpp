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
#include "ode/row_order.hpp"

namespace harpoon::ode {

template <class Real>
class SapOrder {
 public:
  /// `axis_order` is that of dSweepAndPruneSpaceCreate.
  explicit SapOrder(int axis_order);

  [[nodiscard]] int axis_order() const { return axes_[0] | axes_[1] << 2 | axes_[2] << 4; }
  /// Whether the axes are three different ones: others are left to libode.
  [[nodiscard]] bool usable() const;

  /// How many of the mirror's geoms are sorted: the number that libode's history hangs on.
  [[nodiscard]] std::size_t sorted_geoms(const Mirror<Real>& mirror) const;

  /// Appends all pairs of the mirror to `out` in the space's order, and takes over the ranks: to be
  /// called once for each call that the space would have seen. Errors: as `CandidateFinder::find`.
  [[nodiscard]] std::optional<Error> append(const Mirror<Real>& mirror,
                                            CandidateFinder<Real>& finder, RowOrder& rows,
                                            std::vector<IndexPair>& out);

 private:
  /// Splits the mirror into geoms bounded and unbounded on the first axis.
  void split(const Mirror<Real>& mirror);
  /// Brings `ranks_` from the last call's order to that of `lows_`.
  void sort();
  [[nodiscard]] bool is_sorted() const;
  void radix_sort();
  void sweep(const Mirror<Real>& mirror, std::vector<IndexPair>& out);
  [[nodiscard]] std::optional<Error> search(const Mirror<Real>& mirror,
                                            CandidateFinder<Real>& finder, RowOrder& rows,
                                            std::vector<IndexPair>& out);
  void append_unbounded(const Mirror<Real>& mirror, std::vector<IndexPair>& out) const;

  /// What the sweep reads of a geom.
  struct Sorted {
    Real low1, high1, low2, high2;
    float low0, high0;
    std::uint32_t geom;
  };

  int axes_[3];
  std::vector<Sorted> sorted_;
  std::vector<std::uint32_t> bounded_, unbounded_;  ///< geoms of the mirror
  std::vector<float> lows_, highs_;                 ///< of `bounded_`
  std::vector<std::uint32_t> ranks_;                ///< positions in `bounded_`, sorted
  std::vector<std::uint64_t> keys_, keys_scratch_;
  std::vector<BoundsBox<Real>> rounded_;
  std::vector<std::uint8_t> skip_;
  std::vector<std::uint32_t> rank_of_geom_;
};

}  // namespace harpoon::ode
