#include "ode/pair_search.hpp"

#include "ode/simple_order.hpp"

namespace harpoon::ode {
namespace {

/// Beyond this many geoms the bitmap of a stock hash space overflows an int and the program aborts.
constexpr std::uint32_t kMostGeomsOfStockHash = 131071;

}  // namespace

template <class Real>
Result<PairSearch<Real>> PairSearch<Real>::make() noexcept {
  Result<CandidateFinder<Real>> finder = CandidateFinder<Real>::make();
  if (!finder) return finder.error();
  return PairSearch(std::move(*finder));
}

template <class Real>
Result<typename PairSearch<Real>::Found> PairSearch<Real>::find_simple(
    const Mirror<Real>& mirror, std::vector<IndexPair>& pairs) {
  pairs.clear();
  const auto candidates = finder_.find(mirror, mirror.bounds);
  if (!candidates) return candidates.error();
  append_in_simple_order(*candidates, mirror.size(), rows_, pairs);
  return Found{};
}

template <class Real>
Result<typename PairSearch<Real>::Found> PairSearch<Real>::find_sap(const Mirror<Real>& mirror,
                                                                    SapOrder<Real>& sap,
                                                                    std::vector<IndexPair>& pairs) {
  pairs.clear();
  if (auto error = sap.append(mirror, finder_, rows_, pairs)) return *std::move(error);
  return Found{};
}

template <class Real>
Result<typename PairSearch<Real>::Found> PairSearch<Real>::find_hash(
    const Mirror<Real>& mirror, int min_level, int max_level, Policy policy,
    std::vector<IndexPair>& pairs) {
  pairs.clear();
  hash_.prepare(mirror, min_level, max_level);
  const auto candidates = finder_.find(mirror, mirror.bounds, hash_.skip());
  if (!candidates) return candidates.error();
  Found found;
  found.stock_aborts = hash_.has_stray() || mirror.size() > kMostGeomsOfStockHash;
  found.missed_by_stock = hash_.append(*candidates, policy != Policy::fixed, rows_, pairs);
  return found;
}

template class PairSearch<float>;
template class PairSearch<double>;

}  // namespace harpoon::ode
