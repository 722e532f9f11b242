#include "ode/pair_search.hpp"

#include "ode/simple_order.hpp"

namespace harpoon::ode {
namespace {

/// Beyond this many geoms the bitmap of a stock hash space overflows an int and the program aborts.
constexpr std::uint32_t kMostGeomsOfStockHash = 131071;

/// Bounds that are no boxes: pairs of these are found in other ways.
template <class Real>
bool has_odd(const Mirror<Real>& mirror) {
  return (mirror.all_traits & (kIsNan | kIsInverted)) != 0;
}

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

template <class Real>
template <class Overlap>
void PairSearch<Real>::find_fresh(Mirror<Real>& mirror, const SlotChange& change,
                                  const Overlap& overlap) {
  const PackedBounds<Real>& packed = mirror.packed();
  fresh_.clear();
  for (const std::uint32_t slot : change.fresh) {
    mirror.near.clear();
    packed.append_near(mirror.bounds[slot], mirror.near);
    for (const std::uint32_t other : mirror.near) {
      const bool is_new = other > slot || (other < slot && !change.is_fresh(other));
      if (is_new && overlap(slot, other) && mirror.counts(slot, other)) {
        fresh_.push_back({slot, other});
      }
    }
  }
}

template <class Real>
bool PairSearch<Real>::update_simple(Mirror<Real>& mirror, const SlotChange& change,
                                     std::vector<IndexPair>& pairs) {
  if (has_odd(mirror)) return false;
  find_fresh(mirror, change,
             [&](std::uint32_t i, std::uint32_t j) { return mirror.overlap(i, j); });
  placed_.clear();
  for (const auto& [i, j] : fresh_) {
    const IndexPair pair = i < j ? IndexPair{i, j} : IndexPair{j, i};
    placed_.push_back({{pair.g1, pair.g2}, pair});
  }
  keep_unchanged(change, pairs);
  insert_in_order(
      pairs, placed_, [](const IndexPair& pair) { return pair.g1; },
      [](const IndexPair& pair) { return pair.g2; });
  return true;
}

template <class Real>
bool PairSearch<Real>::update_sap(Mirror<Real>& mirror, const SlotChange& change,
                                  SapOrder<Real>& sap, std::vector<IndexPair>& pairs) {
  if (has_odd(mirror)) return false;
  find_fresh(mirror, change,
             [&](std::uint32_t i, std::uint32_t j) { return sap.overlap(mirror, i, j); });
  sap.update(mirror, change, fresh_, rows_, pairs);
  return true;
}

template <class Real>
bool PairSearch<Real>::update_hash(Mirror<Real>& mirror, const SlotChange& change, int min_level,
                                   int max_level, Policy policy, Found& found,
                                   std::vector<IndexPair>& pairs) {
  // Which pairs stock misses is not kept, so there may be none.
  if (has_odd(mirror) || found.stock_aborts || found.missed_by_stock != 0) return false;
  if (!hash_.update(mirror, change, min_level, max_level)) return false;
  find_fresh(mirror, change,
             [&](std::uint32_t i, std::uint32_t j) { return mirror.overlap(i, j); });
  using Outcome = typename HashOrder<Real>::Found;
  placed_.clear();
  for (const IndexPair& either : fresh_) {
    const IndexPair pair = hash_.oriented(either);
    std::uint64_t key = 0;
    const Outcome outcome = hash_.key_of(pair, key);
    if (outcome == Outcome::missed) ++found.missed_by_stock;
    if (outcome == Outcome::yes || (outcome == Outcome::missed && policy == Policy::fixed)) {
      placed_.push_back({{hash_.row_of(pair), key}, pair});
    }
  }
  keep_unchanged(change, pairs);
  insert_in_order(
      pairs, placed_, [&](const IndexPair& pair) { return hash_.row_of(pair); },
      [&](const IndexPair& pair) {
        std::uint64_t key = 0;
        (void)hash_.key_of(pair, key);
        return key;
      });
  return true;
}

template class PairSearch<float>;
template class PairSearch<double>;

}  // namespace harpoon::ode
