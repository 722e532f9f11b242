#include "ode/packed_bounds.hpp"

#include <bit>

namespace harpoon::ode {

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
    const LaneFloats* const v = blocks_[number].v;
    const LaneBits apart = (v[0] > high[0]) | (v[1] < low[0]) | (v[2] > high[1]) | (v[3] < low[1]) |
                           (v[4] > high[2]) | (v[5] < low[2]);
    for (unsigned near = ~mask_of(apart) & ((1u << kLanes) - 1); near != 0; near &= near - 1) {
      const std::size_t k = number * kLanes + static_cast<unsigned>(std::countr_zero(near));
      if (k >= first && k < count_) out.push_back(static_cast<std::uint32_t>(k));
    }
  }
}

template class PackedBounds<float>;
template class PackedBounds<double>;

}  // namespace harpoon::ode
