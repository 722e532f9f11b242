#pragma once

// Boxes in the terms of the order and the search: a box is sorted like a sphere that sits at its
// lowest corner and whose radius is half of its longest side. Two boxes that overlap are then
// within reach of each other, cell for cell. An axis along which boxes are long beside their other
// sides is left out of this, the grid has one cell along it. Boxes that would spoil the grid all
// the same, infinite or huge beside the others, stay out of it and are scanned.

#include <cstdint>
#include <optional>
#include <vector>

#include "broad/order.hpp"
#include "broad/search.hpp"
#include "broad/tree.hpp"
#include "harpoon/scene.hpp"

namespace harpoon::broad {

/// The caller's boxes.
template <class Real>
struct BoxSource {
  const Real* first;
  std::size_t stride_bytes;
  std::size_t count;

  [[nodiscard]] const Real* operator[](std::size_t i) const noexcept {
    return reinterpret_cast<const Real*>(reinterpret_cast<const char*>(first) + i * stride_bytes);
  }
};

/// What ordering boxes needs and leaves behind.
struct BoxMemory {
  Buffer corners;  ///< a sphere for each box, by id
  Buffer high;     ///< highest corners in sorted order, one array for each axis
  Buffer low;      ///< lowest corners along the axes that the grid ignores
  std::vector<std::uint32_t> invalid, scanned;

  [[nodiscard]] std::size_t bytes() const noexcept { return bytes_of(corners, high, low); }
};

/// Boxes in search order, in culling coordinates.
template <class Real, class Cull>
struct OrderedBoxes : BoxJudge {
  Ordered<Cull, Cull> bodies;
  BoxSource<Real> source;
  /// Culling coordinates that are equal may have been different: rounded, or clamped in the grid.
  bool touching_unsure = sizeof(Cull) < sizeof(Real);
};

/// What became of an attempt to order.
enum class BoxOrder : std::uint8_t {
  done,
  nothing,       ///< no valid box
  needs_double,  ///< float does not resolve these boxes; never with Cull = double
  needs_trees,   ///< too many boxes fit no grid
};

/// Surveys and orders the boxes; ids of invalid ones are appended to `excluded`, unless another
/// attempt is needed. Throws std::bad_alloc only.
template <class Real, class Cull>
Result<BoxOrder> order_boxes(const Means& means, const BoxSource<Real>& source, BoxMemory& memory,
                             OrderMemory& order_memory, std::vector<std::uint32_t>& excluded,
                             OrderedBoxes<Real, Cull>& out);

/// The same without grids, for any boxes; invalid ones are known from the attempt before it.
template <class Real>
std::optional<Error> order_boxes_in_trees(const Means& means, const BoxSource<Real>& source,
                                          BoxMemory& memory, OrderMemory& order_memory,
                                          TreeMemory& tree_memory, OrderedBoxes<Real, Real>& out);

}  // namespace harpoon::broad
