#include "ode/candidates.hpp"

#include <algorithm>
#include <utility>

namespace harpoon::ode {
namespace {

/// Up to this many geoms every pair is looked at: a search would cost more than it saves.
constexpr std::uint32_t kFewGeoms = 112;

/// 64 bits onto 32 such that two words that share a bit still do: a filter that lets more through.
std::uint32_t fold(unsigned long bits) {
  const auto wide = static_cast<std::uint64_t>(bits);
  return static_cast<std::uint32_t>(wide | (wide >> 32));
}

template <class Real>
bool closed_overlap(const Real* a, const Real* b) {
  return (a[0] <= b[1]) & (a[1] >= b[0]) & (a[2] <= b[3]) & (a[3] >= b[2]) & (a[4] <= b[5]) &
         (a[5] >= b[4]);
}

bool is_skipped(std::span<const std::uint8_t> skip, std::uint32_t geom) {
  return !skip.empty() && skip[geom] != 0;
}

}  // namespace

template <class Real>
Result<CandidateFinder<Real>> CandidateFinder<Real>::make() noexcept {
  Result<Workspace> workspace = Workspace::make({.threads = 1});
  if (!workspace) return workspace.error();
  return CandidateFinder(std::move(*workspace));
}

template <class Real>
Filters CandidateFinder<Real>::coarse_filters(const Mirror<Real>& mirror,
                                              std::span<const std::uint8_t> skip) {
  if (mirror.uniform_bits && skip.empty()) return {};
  category_.resize(mirror.size());
  collide_.resize(mirror.size());
  for (std::uint32_t i = 0; i < mirror.size(); ++i) {
    const bool out = is_skipped(skip, i);
    category_[i] = out ? 0 : fold(mirror.category[i]);
    collide_[i] = out ? 0 : fold(mirror.collide[i]);
  }
  return {.category = category_, .collide = collide_};
}

template <class Real>
std::optional<Error> CandidateFinder<Real>::find_regular(std::span<const BoundsBox<Real>> bounds,
                                                         const Filters& filters) {
  if (bounds.size() <= kFewGeoms) {
    pairs_.clear();
    packed_.pack(bounds);
    for (std::uint32_t i = 0; i < bounds.size(); ++i) {
      near_.clear();
      packed_.append_near(bounds[i], near_, std::size_t{i} + 1);
      for (const std::uint32_t j : near_) {
        if (closed_overlap(bounds[i].v, bounds[j].v)) pairs_.push_back({i, j});
      }
    }
    return std::nullopt;
  }
  BoundsOf<Real> boxes(bounds[0].v, bounds.size());
  boxes.filters = filters;
  pairs_.resize(pairs_.capacity());
  Result<DetectReport> report = overlap_pairs(workspace_, boxes, pairs_);
  if (!report && report.error().code == Errc::capacity) {
    // Room to spare, so that the next frame does not need it again.
    pairs_.resize(report.error().needed + report.error().needed / 8);
    report = overlap_pairs(workspace_, boxes, pairs_);
  }
  if (!report) return report.error();
  pairs_.resize(report->contacts);
  return std::nullopt;
}

template <class Real>
void CandidateFinder<Real>::keep_counting(const Mirror<Real>& mirror,
                                          std::span<const std::uint8_t> skip) {
  std::size_t kept = 0;
  for (const IndexPair pair : pairs_) {
    pairs_[kept] = pair;
    kept +=
        mirror.counts(pair.g1, pair.g2) && !is_skipped(skip, pair.g1) && !is_skipped(skip, pair.g2)
            ? 1
            : 0;
  }
  pairs_.resize(kept);
}

/// Boxes that are no boxes: few, so each is compared with every other.
template <class Real>
void CandidateFinder<Real>::add_odd(const Mirror<Real>& mirror,
                                    std::span<const std::uint8_t> skip) {
  constexpr std::uint8_t kOdd = kIsNan | kIsInverted;
  for (std::uint32_t i = 0; i < mirror.size(); ++i) {
    if ((mirror.traits[i] & kOdd) == 0 || is_skipped(skip, i)) continue;
    for (std::uint32_t j = 0; j < mirror.size(); ++j) {
      const bool both_odd = (mirror.traits[j] & kOdd) != 0;
      if (j == i || (both_odd && j < i) || is_skipped(skip, j)) continue;
      if (mirror.counts(i, j) && mirror.overlap(i, j)) {
        pairs_.push_back({std::min(i, j), std::max(i, j)});
      }
    }
  }
}

template <class Real>
Result<std::span<const IndexPair>> CandidateFinder<Real>::find(
    const Mirror<Real>& mirror, std::span<const BoundsBox<Real>> bounds,
    std::span<const std::uint8_t> skip) {
  if (auto error = find_regular(bounds, coarse_filters(mirror, skip))) return *std::move(error);
  keep_counting(mirror, skip);
  if ((mirror.all_traits & (kIsNan | kIsInverted)) != 0) add_odd(mirror, skip);
  return std::span<const IndexPair>(pairs_);
}

template class CandidateFinder<float>;
template class CandidateFinder<double>;

}  // namespace harpoon::ode
