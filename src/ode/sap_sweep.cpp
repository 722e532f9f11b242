#include "ode/sap_sweep.hpp"

#include <algorithm>
#include <bit>

#include "ode/lanes.hpp"
#include "ode/packed_bounds.hpp"

namespace harpoon::ode {
namespace {

/// Of whose partners the mean is taken.
constexpr std::size_t kMostSamples = 64;
constexpr std::size_t kGeomsOfASample = 16;
/// Pairs that there is room for at first.
constexpr std::size_t kMinRoom = 256;

}  // namespace

template <class Real>
void SapSweep<Real>::assign(const Mirror<Real>& mirror, std::span<const std::uint32_t> ranks,
                            const std::uint32_t* bounded, const float* lows, const float* highs) {
  count_ = ranks.size();
  geoms_.resize(count_);
  for (std::vector<float>* lanes : {&low0_, &high0_, &lows1_, &highs1_, &lows2_, &highs2_}) {
    lanes->resize(count_ + kLanes);
  }
  std::uint32_t* const geoms = geoms_.data();
  float *const low0 = low0_.data(), *const high0 = high0_.data();
  float *const lows1 = lows1_.data(), *const highs1 = highs1_.data();
  float *const lows2 = lows2_.data(), *const highs2 = highs2_.data();
  const BoundsBox<Real>* const boxes = mirror.bounds.data();
  const int low1 = low1_, low2 = low2_;
  for (std::size_t k = 0; k < count_; ++k) {
    const std::uint32_t p = ranks[k];
    geoms[k] = bounded[p];
    low0[k] = lows[p];
    high0[k] = highs[p];
    const Real* const box = boxes[bounded[p]].v;
    lows1[k] = static_cast<float>(box[low1]);
    highs1[k] = static_cast<float>(box[low1 + 1]);
    lows2[k] = static_cast<float>(box[low2]);
    highs2[k] = static_cast<float>(box[low2 + 1]);
  }
  // Apart from the gathering, so that compilers do several at a time.
  for (float* const bounds : {lows1, lows2}) {
    for (std::size_t k = 0; k < count_; ++k) bounds[k] -= margin_of(bounds[k]);
  }
  for (float* const bounds : {highs1, highs2}) {
    for (std::size_t k = 0; k < count_; ++k) bounds[k] += margin_of(bounds[k]);
  }
}

template <class Real>
std::size_t SapSweep<Real>::mean_partners() const {
  const auto end = low0_.begin() + static_cast<std::ptrdiff_t>(count_);
  const std::size_t step = std::max(count_ / kMostSamples, kGeomsOfASample);
  std::size_t partners = 0, samples = 0;
  for (std::size_t k = 0; k < count_; k += step, ++samples) {
    const auto next = low0_.begin() + static_cast<std::ptrdiff_t>(k + 1);
    partners += static_cast<std::size_t>(std::upper_bound(next, end, high0_[k]) - next);
  }
  return samples == 0 ? 0 : partners / samples;
}

template <class Real>
bool SapSweep<Real>::has_one_order() const {
  const auto end = low0_.begin() + static_cast<std::ptrdiff_t>(count_);
  return std::adjacent_find(low0_.begin(), end) == end;
}

template <class Real>
void SapSweep<Real>::append(const Mirror<Real>& mirror, std::vector<IndexPair>& out) {
  const std::uint32_t* const geoms = geoms_.data();
  const float *const low0 = low0_.data(), *const lows1 = lows1_.data(),
                     *const lows2 = lows2_.data();
  const float *const highs1 = highs1_.data(), *const highs2 = highs2_.data();
  const BoundsBox<Real>* const boxes = mirror.bounds.data();
  std::size_t found = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    const float high0 = high0_[k];
    const float low1 = lows1[k], high1 = highs1[k], low2 = lows2[k], high2 = highs2[k];
    const std::uint32_t geom = geoms[k];
    const Real* const box = boxes[geom].v;
    for (std::size_t p = k + 1; p < count_ && low0[p] <= high0; p += kLanes) {
      const LaneBits apart = (load_lanes(low0 + p) > high0) | (load_lanes(lows1 + p) > high1) |
                             (load_lanes(highs1 + p) < low1) | (load_lanes(lows2 + p) > high2) |
                             (load_lanes(highs2 + p) < low2);
      unsigned near = ~mask_of(apart) & ((1u << kLanes) - 1);
      if (near == 0) continue;
      if (p + kLanes > count_) near &= (1u << (count_ - p)) - 1;
      if (found_.size() < found + kLanes) found_.resize(2 * found + kMinRoom);
      IndexPair* to = found_.data() + found;
      for (; near != 0; near &= near - 1) {
        const std::uint32_t other = geoms[p + static_cast<unsigned>(std::countr_zero(near))];
        *to = {geom, other};
        to += overlap(box, boxes[other].v) && mirror.counts(geom, other) ? 1 : 0;
      }
      found = static_cast<std::size_t>(to - found_.data());
    }
  }
  out.insert(out.end(), found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(found));
}

template class SapSweep<float>;
template class SapSweep<double>;

}  // namespace harpoon::ode
