#pragma once

// The sweep of a sweep-and-prune space in lanes: each geom, in sorted order, against those behind
// it whose lower bound on the first axis does not exceed its upper one. Bounds on the other axes
// are compared in binary32, rounded outwards, and exactly where that does not tell.

#include <cstdint>
#include <span>
#include <vector>

#include "ode/mirror.hpp"

namespace harpoon::ode {

template <class Real>
class SapSweep {
 public:
  /// `axis1` and `axis2` are those besides the first.
  SapSweep(int axis1, int axis2) : low1_(2 * axis1), low2_(2 * axis2) {}

  /// The geoms `bounded[rank]` for each of `ranks`, in sorted order; `lows` and `highs` are the
  /// bounds of `bounded` on the first axis as the space rounds them. No bound is NaN, none
  /// inverted. Throws std::bad_alloc.
  void assign(const Mirror<Real>& mirror, std::span<const std::uint32_t> ranks,
              const std::uint32_t* bounded, const float* lows, const float* highs);

  /// How many geoms a geom is compared with, about: from some of them.
  [[nodiscard]] std::size_t mean_partners() const;
  /// Whether no two lower bounds on the first axis are the same: then there is one order only,
  /// whatever that of the call before was.
  [[nodiscard]] bool has_one_order() const;
  /// Appends the pairs that overlap and pass the mirror's filters, in the space's order.
  /// O(geoms x partners). Throws std::bad_alloc.
  void append(const Mirror<Real>& mirror, std::vector<IndexPair>& out);

 private:
  [[nodiscard]] bool overlap(const Real* a, const Real* b) const {
    return (static_cast<int>(a[low1_ + 1] >= b[low1_]) &
            static_cast<int>(b[low1_ + 1] >= a[low1_]) &
            static_cast<int>(a[low2_ + 1] >= b[low2_]) &
            static_cast<int>(b[low2_ + 1] >= a[low2_])) != 0;
  }

  int low1_, low2_;  ///< places in bounds
  std::vector<std::uint32_t> geoms_;
  /// Of the first axis, then lows and highs of the others; some more elements than geoms.
  std::vector<float> low0_, high0_, lows1_, highs1_, lows2_, highs2_;
  std::size_t count_ = 0;
  std::vector<IndexPair> found_;  ///< as long as it ever was
};

}  // namespace harpoon::ode
