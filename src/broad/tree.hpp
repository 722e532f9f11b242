#pragma once

// The order of worlds for which no grid is good: a space-filling curve (Morton 1966) through the
// box around all bodies, and where many share one of its cells, through the box around those, and
// so on. Every sixteen bodies that follow each other are a leaf. Bodies that are too large for
// their leaf make a tree of their own. Neither how far bodies are apart nor how their sizes differ
// matters. The result is a function of the set of bodies and their ids alone; docs/scene.md defines
// it.

#include <cstdint>
#include <optional>
#include <span>

#include "base/buffer.hpp"
#include "broad/order.hpp"
#include "harpoon/error.hpp"

namespace harpoon::broad {

/// A body as the curve meets it.
template <class Real>
struct TreeItem {
  Real at[3];  ///< centre of its bounds
  std::uint32_t id;
  std::uint16_t side[3];  ///< exponent of its bounds' side along each axis
};

/// Memory kept between calls.
struct TreeMemory {
  Buffer items, spare, codes, boxes;

  [[nodiscard]] std::size_t bytes() const noexcept { return bytes_of(items, spare, codes, boxes); }
};

/// Room for the items of so many bodies; null when there is none.
template <class Real>
TreeItem<Real>* reserve_items(TreeMemory& memory, std::size_t bodies) noexcept;

/// The exponent of a side, as TreeItem has it: any that is not negative, infinite ones too.
std::uint16_t side_exponent(double side) noexcept;

/// Orders items of the memory, which ascend by id, into trees and describes those in `out`: ranges
/// of sorted positions from 0 on, nodes with memory for their boxes. What stands first is coarsest.
template <class Real>
std::optional<Error> grow_trees(std::span<TreeItem<Real>> items, TreeMemory& memory,
                                Ordered<Real, Real>& out);

/// Orders the valid spheres, giants as well; `margin` as in the survey.
template <class Real>
std::optional<Error> order_in_trees(const Means& means, const Source<Real>& source, double margin,
                                    OrderMemory& memory, TreeMemory& tree_memory,
                                    Ordered<Real, Real>& out);

}  // namespace harpoon::broad
