#include "ode/sap_order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <utility>

namespace harpoon::ode {
namespace {

/// A geom that is compared with so many others on average is found faster by a search.
constexpr std::size_t kMostPartners = 256;
/// With fewer, as in a chain along the first axis, libode's sweep has next to nothing to do.
constexpr std::size_t kFewestPartners = 8;
/// By which the number of others is estimated before all geoms have been read.
constexpr std::size_t kSampleGeoms = 256;
/// How far geoms may be from their places in the order of the call before.
constexpr std::size_t kMovesOfAGeom = 8;

/// Bits whose unsigned order is that of the floats.
std::uint32_t ordered_bits(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return (bits >> 31) != 0 ? ~bits : bits | 0x80000000u;
}

}  // namespace

template <class Real>
SapOrder<Real>::SapOrder(int axis_order)
    : axes_{axis_order & 3, (axis_order >> 2) & 3, (axis_order >> 4) & 3},
      lanes_(axes_[1], axes_[2]) {}

template <class Real>
bool SapOrder<Real>::usable() const {
  unsigned seen = 0;
  for (const int axis : axes_) seen |= 1u << axis;
  return seen == 0b111;
}

template <class Real>
std::size_t SapOrder<Real>::sorted_geoms(const Mirror<Real>& mirror) const {
  const int high = 2 * axes_[0] + 1;
  return static_cast<std::size_t>(
      std::count_if(mirror.bounds.begin(), mirror.bounds.end(), [&](const BoundsBox<Real>& box) {
        return box.v[high] != std::numeric_limits<Real>::infinity();
      }));
}

template <class Real>
void SapOrder<Real>::split(const Mirror<Real>& mirror) {
  const int low = 2 * axes_[0];
  const std::size_t count = mirror.size();
  bounded_.resize(count);
  lows_.resize(count);
  highs_.resize(count);
  unbounded_.clear();
  std::uint32_t* const bounded = bounded_.data();
  float *const lows = lows_.data(), *const highs = highs_.data();
  std::size_t found = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Real* box = mirror.bounds[i].v;
    if (box[low + 1] == std::numeric_limits<Real>::infinity()) {
      unbounded_.push_back(i);
      continue;
    }
    bounded[found] = i;
    lows[found] = static_cast<float>(box[low]);
    highs[found] = static_cast<float>(box[low + 1]);
    ++found;
  }
  bounded_.resize(found);
  lows_.resize(found);
  highs_.resize(found);
}

template <class Real>
bool SapOrder<Real>::is_sparse(const GeomReader<Real>& reader, dxSpace* space, int count) const {
  const int low = 2 * axes_[0];
  std::array<std::array<Real, 2>, kSampleGeoms> sample;
  const int samples = std::min(count, static_cast<int>(kSampleGeoms));
  for (int k = 0; k < samples; ++k) {
    const auto at = static_cast<std::int64_t>(k) * count / samples;
    BoundsBox<Real> box;
    reader.read_bounds(reader.ode.space_get_geom(space, static_cast<int>(at)), box);
    sample[static_cast<std::size_t>(k)] = {box.v[low], box.v[low + 1]};
  }
  std::int64_t overlaps = 0;
  for (int j = 1; j < samples; ++j) {
    const auto& b = sample[static_cast<std::size_t>(j)];
    for (int i = 0; i < j; ++i) {
      const auto& a = sample[static_cast<std::size_t>(i)];
      overlaps += static_cast<int>(a[0] <= b[1]) & static_cast<int>(b[0] <= a[1]);
    }
  }
  // Of all pairs of geoms as many overlap as of those of the sample.
  const double pairs = 0.5 * samples * (samples - 1);
  return static_cast<double>(overlaps) / pairs * count / 2 < kFewestPartners;
}

template <class Real>
bool SapOrder<Real>::finds_one_order(const Mirror<Real>& mirror) {
  split(mirror);
  std::vector<float> sorted = lows_;
  std::sort(sorted.begin(), sorted.end());
  return (mirror.all_traits & kIsNan) == 0 &&
         std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end();
}

template <class Real>
bool SapOrder<Real>::is_sorted() const {
  for (std::size_t i = 1; i < ranks_.size(); ++i) {
    if (lows_[ranks_[i]] < lows_[ranks_[i - 1]]) return false;
  }
  return true;
}

/// Where the order is nearly that of the call before. False when it is not; what has been done by
/// then was stable.
template <class Real>
bool SapOrder<Real>::sort_by_insertion() {
  std::size_t moves_left = kMovesOfAGeom * keys_.size();
  for (std::size_t i = 1; i < keys_.size(); ++i) {
    const std::uint64_t key = keys_[i];
    std::size_t place = i;
    for (; place > 0 && keys_[place - 1] >> 32 > key >> 32 && moves_left > 0; --place) {
      keys_[place] = keys_[place - 1];
      --moves_left;
    }
    keys_[place] = key;
  }
  return moves_left > 0;
}

template <class Real>
void SapOrder<Real>::sort_by_radix() {
  const std::size_t count = keys_.size();
  keys_scratch_.resize(count);
  std::array<std::array<std::uint32_t, 256>, 4> starts{};
  for (const std::uint64_t key : keys_) {
    for (std::size_t pass = 0; pass < 4; ++pass) ++starts[pass][key >> (32 + 8 * pass) & 255];
  }
  for (std::size_t pass = 0; pass < 4; ++pass) {
    auto& start = starts[pass];
    if (std::find(start.begin(), start.end(), count) != start.end()) continue;  // one byte for all
    std::uint32_t next = 0;
    for (std::uint32_t& s : start) next += std::exchange(s, next);
    for (const std::uint64_t key : keys_) {
      keys_scratch_[start[key >> (32 + 8 * pass) & 255]++] = key;
    }
    keys_.swap(keys_scratch_);
  }
}

/// Runs of one negative value come out reversed, as libode's last pass does it.
template <class Real>
void SapOrder<Real>::reverse_negative_runs() {
  constexpr std::uint64_t kPositive = std::uint64_t{1} << 63;
  for (std::size_t begin = 0; begin < keys_.size() && keys_[begin] < kPositive;) {
    std::size_t end = begin + 1;
    while (end < keys_.size() && keys_[end] >> 32 == keys_[begin] >> 32) ++end;
    std::reverse(keys_.begin() + static_cast<std::ptrdiff_t>(begin),
                 keys_.begin() + static_cast<std::ptrdiff_t>(end));
    begin = end;
  }
}

template <class Real>
void SapOrder<Real>::sort() {
  // Another number of geoms: libode forgets its ranks.
  if (ranks_.size() != lows_.size()) {
    ranks_.resize(lows_.size());
    std::iota(ranks_.begin(), ranks_.end(), 0u);
  }
  if (is_sorted()) return;
  keys_.resize(ranks_.size());
  for (std::size_t i = 0; i < ranks_.size(); ++i) {
    keys_[i] = std::uint64_t{ordered_bits(lows_[ranks_[i]])} << 32 | ranks_[i];
  }
  if (!sort_by_insertion()) sort_by_radix();
  reverse_negative_runs();
  for (std::size_t i = 0; i < ranks_.size(); ++i) ranks_[i] = static_cast<std::uint32_t>(keys_[i]);
}

/// libode's own loop, step by step, so that it also gives what NaNs and inverted boxes give there.
template <class Real>
void SapOrder<Real>::sweep(const Mirror<Real>& mirror, std::vector<IndexPair>& out) {
  const std::size_t count = ranks_.size();
  const int low1 = 2 * axes_[1], low2 = 2 * axes_[2];
  sorted_.resize(count);
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t p = ranks_[k];
    const Real* const box = mirror.bounds[bounded_[p]].v;
    sorted_[k] = {box[low1], box[low1 + 1], box[low2],  box[low2 + 1],
                  lows_[p],  highs_[p],     bounded_[p]};
  }
  std::size_t running = 0, found = out.size();
  for (std::size_t k = 0; k < count; ++k) {
    const Sorted a = sorted_[k];
    while (sorted_[running++].low0 < a.low0) {
      if (running == count) break;
    }
    if (running == count) break;
    out.resize(std::max(out.size(), found + (count - running)));
    for (std::size_t partner = running; partner < count; ++partner) {
      const Sorted& b = sorted_[partner];
      if (!(b.low0 <= a.high0)) break;
      const int apart =
          static_cast<int>(!(a.high1 >= b.low1)) | static_cast<int>(!(b.high1 >= a.low1)) |
          static_cast<int>(!(a.high2 >= b.low2)) | static_cast<int>(!(b.high2 >= a.low2));
      out[found] = {a.geom, b.geom};
      found += apart == 0 && mirror.counts(a.geom, b.geom) ? 1 : 0;
    }
  }
  out.resize(found);
}

/// False when a search is faster.
template <class Real>
bool SapOrder<Real>::sweep_in_lanes(const Mirror<Real>& mirror, std::vector<IndexPair>& out) {
  lanes_.assign(mirror, ranks_, bounded_.data(), lows_.data(), highs_.data());
  const std::size_t partners = lanes_.mean_partners();
  if (partners > kMostPartners) return false;
  is_for_libode_ = partners < kFewestPartners && unbounded_.empty() && lanes_.has_one_order();
  lanes_.append(mirror, out);
  return true;
}

template <class Real>
void SapOrder<Real>::number_geoms(const Mirror<Real>& mirror) {
  rank_of_geom_.resize(mirror.size());
  for (std::uint32_t k = 0; k < ranks_.size(); ++k) rank_of_geom_[bounded_[ranks_[k]]] = k;
}

template <class Real>
void SapOrder<Real>::append_by_rank(std::span<const IndexPair> pairs, RowOrder& rows,
                                    std::vector<IndexPair>& out) const {
  rows.pairs.resize(pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::uint32_t rank1 = rank_of_geom_[pairs[k].g1], rank2 = rank_of_geom_[pairs[k].g2];
    const std::uint32_t later = std::max(rank1, rank2);
    rows.pairs[k] = {later, std::min(rank1, rank2), later};
  }
  const std::size_t begin = out.size();
  rows.append_to(out, static_cast<std::uint32_t>(ranks_.size()),
                 [](std::uint32_t rank) { return rank; });
  for (std::size_t k = begin; k < out.size(); ++k) {
    out[k] = {bounded_[ranks_[out[k].g1]], bounded_[ranks_[out[k].g2]]};
  }
}

template <class Real>
std::optional<Error> SapOrder<Real>::search(const Mirror<Real>& mirror,
                                            CandidateFinder<Real>& finder, RowOrder& rows,
                                            std::vector<IndexPair>& out) {
  const auto low = std::size_t{2} * static_cast<std::size_t>(axes_[0]);
  rounded_.assign(mirror.bounds.begin(), mirror.bounds.end());
  for (std::size_t k = 0; k < bounded_.size(); ++k) {
    rounded_[bounded_[k]].v[low] = static_cast<Real>(lows_[k]);
    rounded_[bounded_[k]].v[low + 1] = static_cast<Real>(highs_[k]);
  }
  std::span<const std::uint8_t> skip;
  if (!unbounded_.empty()) {
    skip_.assign(mirror.size(), 0);
    for (const std::uint32_t geom : unbounded_) skip_[geom] = 1;
    skip = skip_;
  }
  const Result<std::span<const IndexPair>> pairs = finder.find(mirror, rounded_, skip);
  if (!pairs) return pairs.error();

  number_geoms(mirror);
  append_by_rank(*pairs, rows, out);
  return std::nullopt;
}

template <class Real>
void SapOrder<Real>::append_unbounded(const Mirror<Real>& mirror,
                                      std::vector<IndexPair>& out) const {
  for (std::size_t m = 0; m < unbounded_.size(); ++m) {
    const std::uint32_t first = unbounded_[m];
    for (std::size_t n = m + 1; n < unbounded_.size(); ++n) {
      if (mirror.counts(first, unbounded_[n])) out.push_back({first, unbounded_[n]});
    }
    for (const std::uint32_t second : bounded_) {
      if (mirror.counts(first, second)) out.push_back({first, second});
    }
  }
}

template <class Real>
std::optional<Error> SapOrder<Real>::append(const Mirror<Real>& mirror,
                                            CandidateFinder<Real>& finder, RowOrder& rows,
                                            std::vector<IndexPair>& out) {
  const std::size_t begin = out.size();
  is_for_libode_ = false;
  split(mirror);
  if (!bounded_.empty()) {
    sort();
    constexpr std::uint8_t kOdd = kIsNan | kIsInverted;
    if ((mirror.all_traits & kOdd) != 0) {
      sweep(mirror, out);
    } else if (!sweep_in_lanes(mirror, out)) {
      if (auto error = search(mirror, finder, rows, out)) return error;
    }
  }
  note_sorted(out.size() - begin);
  append_unbounded(mirror, out);
  return std::nullopt;
}

template <class Real>
void SapOrder<Real>::note_sorted(std::size_t pairs) {
  sorted_pairs_ = pairs;
  sorted_geoms_.resize(ranks_.size());
  for (std::size_t k = 0; k < ranks_.size(); ++k) sorted_geoms_[k] = bounded_[ranks_[k]];
}

template <class Real>
bool SapOrder<Real>::overlap(const Mirror<Real>& mirror, std::uint32_t i, std::uint32_t j) const {
  constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
  const Real* const a = mirror.bounds[i].v;
  const Real* const b = mirror.bounds[j].v;
  const int low = 2 * axes_[0], high = low + 1;
  if (a[high] == kInfinity || b[high] == kInfinity) return false;
  if (static_cast<float>(a[low]) > static_cast<float>(b[high]) ||
      static_cast<float>(b[low]) > static_cast<float>(a[high])) {
    return false;
  }
  const int low1 = 2 * axes_[1], low2 = 2 * axes_[2];
  return a[low1] <= b[low1 + 1] && b[low1] <= a[low1 + 1] && a[low2] <= b[low2 + 1] &&
         b[low2] <= a[low2 + 1];
}

template <class Real>
bool SapOrder<Real>::keeps_order(const SlotChange& change) const {
  const auto is_fresh = [&](std::uint32_t slot) { return change.now(slot) == SlotChange::kGone; };
  std::size_t old = 0;
  for (const std::uint32_t rank : ranks_) {
    const std::uint32_t slot = bounded_[rank];
    if (is_fresh(slot)) continue;
    while (old < sorted_geoms_.size() && is_fresh(sorted_geoms_[old])) ++old;
    if (old == sorted_geoms_.size() || sorted_geoms_[old++] != slot) return false;
  }
  return true;
}

template <class Real>
void SapOrder<Real>::update(const Mirror<Real>& mirror, const SlotChange& change,
                            std::span<const IndexPair> fresh, RowOrder& rows,
                            std::vector<IndexPair>& pairs) {
  split(mirror);
  if (!bounded_.empty()) sort();
  number_geoms(mirror);
  pairs.resize(sorted_pairs_);
  keep_unchanged(change, pairs);
  if (keeps_order(change)) {
    const auto rank1 = [&](const IndexPair& pair) { return rank_of_geom_[pair.g1]; };
    const auto rank2 = [&](const IndexPair& pair) { return rank_of_geom_[pair.g2]; };
    placed_.clear();
    for (const auto& [i, j] : fresh) {
      const IndexPair pair =
          rank_of_geom_[i] < rank_of_geom_[j] ? IndexPair{i, j} : IndexPair{j, i};
      placed_.push_back({{rank1(pair), rank2(pair)}, pair});
    }
    insert_in_order(pairs, placed_, rank1, rank2);
  } else {
    // Equal bounds have changed places, as they do where they are negative.
    both_.assign(pairs.begin(), pairs.end());
    both_.insert(both_.end(), fresh.begin(), fresh.end());
    pairs.clear();
    append_by_rank(both_, rows, pairs);
  }
  note_sorted(pairs.size());
  append_unbounded(mirror, pairs);
}

template class SapOrder<float>;
template class SapOrder<double>;

}  // namespace harpoon::ode
