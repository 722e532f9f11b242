#pragma once

// Boxes in binary32, rounded outwards, side by side in blocks: one box is compared with all of them
// at the speed of memory. Finds candidates only; whoever asks compares exact bounds.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ode/bounds_box.hpp"

namespace harpoon::ode {

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
  /// Vectors that compilers have everywhere; the library is built for the oldest machine it serves.
  static constexpr std::size_t kLanes = 4;
  using Floats __attribute__((vector_size(kLanes * sizeof(float)))) = float;
  using Bits __attribute__((vector_size(kLanes * sizeof(float)))) = std::int32_t;
  /// min x, max x, min y, max y, min z, max z of as many boxes as there are lanes.
  struct Block {
    Floats v[6];
  };

  std::vector<Block> blocks_;
  std::size_t count_ = 0;
};

}  // namespace harpoon::ode
