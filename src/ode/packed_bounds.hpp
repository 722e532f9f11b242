#pragma once

// Boxes in binary32, rounded outwards, side by side in blocks: one box is compared with all of them
// at the speed of memory. Finds candidates only; whoever asks compares exact bounds.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "ode/bounds_box.hpp"
#include "ode/lanes.hpp"

namespace harpoon::ode {

/// Two units in the last place and the smallest normal number: more than a rounding in any mode,
/// and more than what is lost where subnormals are flushed. Beyond binary32's range NaN comes out.
inline float margin_of(float value) {
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

template <class Real>
class PackedBounds {
 public:
  /// Packs all boxes anew. Throws std::bad_alloc.
  void pack(std::span<const BoundsBox<Real>> boxes);
  /// Packs boxes begin to end - 1 anew; their number has not changed.
  void repack(std::span<const BoundsBox<Real>> boxes, std::size_t begin, std::size_t end);

  /// Appends the numbers, from `first` on, of all boxes that overlap `box`, closed, and perhaps of
  /// some that nearly do, ascending. A NaN overlaps everything. O(boxes). Throws std::bad_alloc.
  void append_near(const BoundsBox<Real>& box, std::vector<std::uint32_t>& out,
                   std::size_t first = 0) const;

 private:
  /// min x, max x, min y, max y, min z, max z of as many boxes as there are lanes.
  struct Block {
    LaneFloats v[6];
  };

  std::vector<Block> blocks_;
  std::size_t count_ = 0;
};

}  // namespace harpoon::ode
