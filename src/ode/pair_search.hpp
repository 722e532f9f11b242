#pragma once

// From a mirror to its pairs in the order of its kind of space. Holds the scratch memory of one
// space.

#include <optional>
#include <vector>

#include "ode/candidates.hpp"
#include "ode/hash_order.hpp"
#include "ode/options.hpp"
#include "ode/pair_merge.hpp"
#include "ode/row_order.hpp"
#include "ode/sap_order.hpp"

namespace harpoon::ode {

template <class Real>
class PairSearch {
 public:
  /// Errors: as `Workspace::make`.
  static Result<PairSearch> make() noexcept;

  struct Found {
    std::size_t missed_by_stock = 0;  ///< pairs that a stock hash space would not report
    bool stock_aborts = false;        ///< stock libode would abort on this frame
  };

  /// Fills `pairs` from the mirror of a simple space, or a SAP space whose history `sap` knows.
  /// Errors: as `CandidateFinder::find`. Throws std::bad_alloc.
  Result<Found> find_simple(const Mirror<Real>& mirror, std::vector<IndexPair>& pairs);
  Result<Found> find_sap(const Mirror<Real>& mirror, SapOrder<Real>& sap,
                         std::vector<IndexPair>& pairs);
  /// The same for a hash space with these levels.
  Result<Found> find_hash(const Mirror<Real>& mirror, int min_level, int max_level, Policy policy,
                          std::vector<IndexPair>& pairs);

  /// Bring `pairs` up to date, which were found or updated for the mirror before `change`. False
  /// when they are to be found anew; `pairs` then have no meaning. Throw std::bad_alloc; the same.
  [[nodiscard]] bool update_simple(Mirror<Real>& mirror, const SlotChange& change,
                                   std::vector<IndexPair>& pairs);
  [[nodiscard]] bool update_sap(Mirror<Real>& mirror, const SlotChange& change, SapOrder<Real>& sap,
                                std::vector<IndexPair>& pairs);
  /// `found` is what `find_hash` said and is brought up to date as well.
  [[nodiscard]] bool update_hash(Mirror<Real>& mirror, const SlotChange& change, int min_level,
                                 int max_level, Policy policy, Found& found,
                                 std::vector<IndexPair>& pairs);

  /// After `find_hash`: the geoms that libode would abort on, a byte per geom.
  [[nodiscard]] std::span<const std::uint8_t> stray() const { return hash_.stray(); }

 private:
  explicit PairSearch(CandidateFinder<Real> finder) : finder_(std::move(finder)) {}

  /// Fills `fresh_` with the pairs of fresh slots that count and for which `overlap(i, j)`.
  template <class Overlap>
  void find_fresh(Mirror<Real>& mirror, const SlotChange& change, const Overlap& overlap);

  CandidateFinder<Real> finder_;
  HashOrder<Real> hash_;
  RowOrder rows_;
  std::vector<IndexPair> fresh_;
  std::vector<PlacedPair> placed_;
};

}  // namespace harpoon::ode
