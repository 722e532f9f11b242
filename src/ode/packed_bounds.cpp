#include "ode/packed_bounds.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace harpoon::ode {
namespace {

/// Two units in the last place and the smallest normal number: more than a rounding in any mode,
/// and more than what is lost where subnormals are flushed. Beyond binary32's range NaN comes out.
float margin_of(float value) {
  return std::fabs(value) * 0x1p-22f + std::numeric_limits<float>::min();
}

template <class Real>
float rounded_down(Real value) {
  const auto near = static_cast<float>(value);
  return near - margin_of(near);
}

template <class Real>
float rounded_up(Real value) {
  const auto near = static_cast<float>(value);
  return near + margin_of(near);
}

}  // namespace

template <class Real>
void PackedBounds<Real>::repack(std::span<const BoundsBox<Real>> boxes, std::size_t begin,
                                std::size_t end) {
  for (std::size_t k = begin; k < end; ++k) {
    Block& block = blocks_[k / kLanes];
    for (std::size_t side = 0; side < 6; side += 2) {
      block.v[side][k % kLanes] = rounded_down(boxes[k].v[side]);
      block.v[side + 1][k % kLanes] = rounded_up(boxes[k].v[side + 1]);
    }
  }
}

template <class Real>
void PackedBounds<Real>::pack(std::span<const BoundsBox<Real>> boxes) {
  blocks_.resize((boxes.size() + kLanes - 1) / kLanes);
  count_ = boxes.size();
  repack(boxes, 0, count_);
}

template <class Real>
void PackedBounds<Real>::append_near(const BoundsBox<Real>& box, std::vector<std::uint32_t>& out,
                                     std::size_t first) const {
  const float low[3] = {rounded_down(box.v[0]), rounded_down(box.v[2]), rounded_down(box.v[4])};
  const float high[3] = {rounded_up(box.v[1]), rounded_up(box.v[3]), rounded_up(box.v[5])};
  for (std::size_t number = first / kLanes; number < blocks_.size(); ++number) {
    const Floats* const v = blocks_[number].v;
    const Bits apart = (v[0] > high[0]) | (v[1] < low[0]) | (v[2] > high[1]) | (v[3] < low[1]) |
                       (v[4] > high[2]) | (v[5] < low[2]);
    const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(apart);
    if ((halves[0] & halves[1]) == ~std::uint64_t{0}) continue;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::size_t k = number * kLanes + lane;
      if (apart[lane] == 0 && k >= first && k < count_)
        out.push_back(static_cast<std::uint32_t>(k));
    }
  }
}

template class PackedBounds<float>;
template class PackedBounds<double>;

}  // namespace harpoon::ode
