#pragma once

// From a mirror to its pairs in the order of its kind of space. Holds the scratch memory of one
// space.

#include <optional>
#include <vector>

#include "ode/candidates.hpp"
#include "ode/hash_order.hpp"
#include "ode/options.hpp"
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

  /// After `find_hash`: the geoms that libode would abort on, a byte per geom.
  [[nodiscard]] std::span<const std::uint8_t> stray() const { return hash_.stray(); }

 private:
  explicit PairSearch(CandidateFinder<Real> finder) : finder_(std::move(finder)) {}

  CandidateFinder<Real> finder_;
  HashOrder<Real> hash_;
  RowOrder rows_;
};

}  // namespace harpoon::ode
