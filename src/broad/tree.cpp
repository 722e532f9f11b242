#include "broad/tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "base/out_of_memory.hpp"

namespace harpoon::broad {
namespace {

/// Fewest bodies of a piece of work.
constexpr std::size_t kPieceBodies = 4096;
/// Cells of the curve along an axis, as a power of two.
constexpr int kCodeBits = 10;
/// Bodies that are nearer than this along all axes are in one place.
constexpr double kLeastSpread = 0x1p-1000;
/// Ranges from this size on are sorted digit by digit.
constexpr std::size_t kDigitBodies = 2048;

/// The box around the centres of some items.
template <class Real>
struct Spread {
  std::array<Real, 3> low, high;

  explicit Spread(std::span<const TreeItem<Real>> items) noexcept {
    std::copy_n(items[0].at, 3, low.begin());
    high = low;
    for (const TreeItem<Real>& item : items) {
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], item.at[k]);
        high[k] = std::max(high[k], item.at[k]);
      }
    }
  }
  [[nodiscard]] double side(std::size_t axis) const noexcept {
    return static_cast<double>(high[axis]) - static_cast<double>(low[axis]);
  }
  [[nodiscard]] double longest() const noexcept { return std::max({side(0), side(1), side(2)}); }
};

/// Cells of the curve through some items: cubes, but stretched along axes along which the items'
/// own bounds are long.
template <class Real>
class Curve {
 public:
  explicit Curve(std::span<const TreeItem<Real>> items) noexcept : spread_(items) {
    // Of the geometric mean of sides only the exponent counts: it does not depend on an order.
    std::array<std::uint64_t, 3> sides = {0, 0, 0};
    for (const TreeItem<Real>& item : items) {
      for (std::size_t k = 0; k < 3; ++k) sides[k] += item.side[k];
    }
    const std::uint64_t least = std::min({sides[0], sides[1], sides[2]}) / items.size();
    std::array<double, 3> stretch;
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      stretch[k] = std::ldexp(1.0, -static_cast<int>(sides[k] / items.size() - least));
      longest = std::max(longest, spread_.side(k) * stretch[k]);
    }
    if (!(longest >= kLeastSpread)) return;
    for (std::size_t k = 0; k < 3; ++k) {
      cells_per_unit_[k] =
          std::min(stretch[k] * (kCells / longest), std::numeric_limits<double>::max());
    }
  }

  /// All items are in one place, or nearly so.
  [[nodiscard]] bool is_point() const noexcept { return cells_per_unit_ == Scales{}; }

  [[nodiscard]] std::uint32_t code(const TreeItem<Real>& item) const noexcept {
    std::uint32_t code = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double cell = (static_cast<double>(item.at[k]) - static_cast<double>(spread_.low[k])) *
                          cells_per_unit_[k];
      code |= spaced(static_cast<std::uint32_t>(std::min(cell, kCells - 1))) << k;
    }
    return code;
  }

 private:
  using Scales = std::array<double, 3>;
  static constexpr double kCells = 1 << kCodeBits;

  /// Two zeros between all bits of a number of kCodeBits.
  static std::uint32_t spaced(std::uint32_t v) noexcept {
    v = (v | v << 16) & 0x030000FFU;
    v = (v | v << 8) & 0x0300F00FU;
    v = (v | v << 4) & 0x030C30C3U;
    return (v | v << 2) & 0x09249249U;
  }

  Spread<Real> spread_;
  Scales cells_per_unit_ = {};
};

/// Sorts numbers by their high 32 bits, of which 3 * kCodeBits are used; equal ones keep their
/// order. Returns where the result is: either of the two.
std::uint64_t* sort_digits(std::uint64_t* from, std::uint64_t* to, std::size_t count) noexcept {
  constexpr std::size_t kDigits = std::size_t{1} << kCodeBits;
  for (int shift = 32; shift < 32 + 3 * kCodeBits; shift += kCodeBits) {
    const auto digit = [&](std::uint64_t v) { return (v >> shift) & (kDigits - 1); };
    std::array<std::uint32_t, kDigits> places = {};
    for (std::size_t i = 0; i < count; ++i) ++places[digit(from[i])];
    std::uint32_t place = 0;
    for (std::uint32_t& p : places) place += std::exchange(p, place);
    for (std::size_t i = 0; i < count; ++i) to[places[digit(from[i])]++] = from[i];
    std::swap(from, to);
  }
  return from;
}

/// Brings items, which ascend by id, into the order of the curve.
template <class Real>
class CurveSorter {
 public:
  CurveSorter(TreeItem<Real>* items, TreeItem<Real>* spare, std::uint64_t* codes,
              std::size_t count) noexcept
      : items_(items), spare_(spare), codes_(codes), count_(count) {}

  void sort(std::size_t begin, std::size_t end) noexcept {
    const std::size_t count = end - begin;
    if (count <= kTreeWidth) return;
    const Curve<Real> curve(std::span<const TreeItem<Real>>(items_ + begin, count));
    if (curve.is_point()) return;
    std::uint64_t* codes = codes_ + begin;
    for (std::size_t i = 0; i < count; ++i) {
      codes[i] = std::uint64_t{curve.code(items_[begin + i])} << 32 | i;
    }
    if (count < kDigitBodies) {
      std::sort(codes, codes + count);
    } else {
      codes = sort_digits(codes, codes_ + count_ + begin, count);
    }
    for (std::size_t i = 0; i < count; ++i) {
      spare_[begin + i] = items_[begin + static_cast<std::uint32_t>(codes[i])];
    }
    std::copy(spare_ + begin, spare_ + end, items_ + begin);
    if (codes[0] >> 32 == codes[count - 1] >> 32) return;  // rounding leaves nothing to part
    // Where many share a cell. The codes of a part are overwritten when it is sorted, not before.
    for (std::size_t first = 0; first < count;) {
      std::size_t last = first + 1;
      while (last < count && codes[last] >> 32 == codes[first] >> 32) ++last;
      sort(begin + first, begin + last);
      first = last;
    }
  }

 private:
  TreeItem<Real>* items_;
  TreeItem<Real>* spare_;
  std::uint64_t* codes_;
  std::size_t count_;
};

/// Exponent of the longest side.
template <class Real>
std::uint16_t size_of(const TreeItem<Real>& item) noexcept {
  return std::max({item.side[0], item.side[1], item.side[2]});
}

/// Parts the items of a leaf: those that are larger than the leaf is wide, and than most of its
/// items, go to the end. Returns the number of others.
template <class Real>
std::size_t part_leaf(std::span<TreeItem<Real>> items) noexcept {
  std::array<std::uint16_t, kTreeWidth> sizes;
  std::transform(items.begin(), items.end(), sizes.begin(), size_of<Real>);
  const auto half = sizes.begin() + static_cast<std::ptrdiff_t>((items.size() - 1) / 2);
  std::nth_element(sizes.begin(), half, sizes.begin() + static_cast<std::ptrdiff_t>(items.size()));
  const std::uint16_t limit = std::max(*half, side_exponent(Spread<Real>(items).longest()));
  const auto end = std::stable_partition(items.begin(), items.end(),
                                         [&](const auto& item) { return size_of(item) <= limit; });
  return static_cast<std::size_t>(end - items.begin());
}

/// Moves what is too large for its leaf to the end; returns the number of what stays. `spare` has
/// room for as many items.
template <class Real>
std::size_t part_all(std::span<TreeItem<Real>> items, TreeItem<Real>* spare) noexcept {
  std::size_t kept = 0;
  std::size_t larger = 0;
  for (std::size_t begin = 0; begin < items.size(); begin += kTreeWidth) {
    const std::size_t count = std::min<std::size_t>(kTreeWidth, items.size() - begin);
    const auto leaf = items.subspan(begin, count);
    const std::size_t small = part_leaf(leaf);
    std::copy_n(leaf.data() + small, count - small, spare + larger);
    std::copy_n(leaf.data(), small, items.data() + kept);
    larger += count - small;
    kept += small;
  }
  std::copy_n(spare, larger, items.data() + kept);
  return kept;
}

/// The shape of a tree over sorted positions, its nodes from `node` on; returns the node after it.
template <class Real>
std::uint32_t shape_tree(Tree<Real>& tree, std::size_t begin, std::size_t end,
                         std::uint32_t node) noexcept {
  tree.begin = static_cast<std::uint32_t>(begin);
  tree.end = static_cast<std::uint32_t>(end);
  tree.levels = 0;
  auto nodes = static_cast<std::uint32_t>(end - begin);
  do {
    nodes = (nodes + kTreeWidth - 1) / kTreeWidth;
    tree.first[tree.levels] = node;
    tree.count[tree.levels] = nodes;
    ++tree.levels;
    node += (nodes + kTreeWidth - 1) / kTreeWidth * kTreeWidth;
  } while (nodes > kTreeWidth || tree.levels < 2);
  return node;
}

template <class Real>
bool reserve_boxes(TreeMemory& memory, std::size_t nodes, Ordered<Real, Real>& out) noexcept {
  const std::size_t with_slack = nodes + kSlack;
  if (!memory.boxes.reserve(6 * with_slack * sizeof(Real))) return false;
  Real* const at = memory.boxes.as<Real>();
  const NodeBoxes<Real> boxes = {at,
                                 at + with_slack,
                                 at + 2 * with_slack,
                                 at + 3 * with_slack,
                                 at + 4 * with_slack,
                                 at + 5 * with_slack};
  for (std::size_t t = 0; t < out.tree_count; ++t) out.trees[t].boxes = boxes;
  return true;
}

}  // namespace

std::uint16_t side_exponent(double side) noexcept {
  std::uint64_t bits;
  std::memcpy(&bits, &side, sizeof bits);
  return static_cast<std::uint16_t>(bits << 1 >> 53);
}

template <class Real>
TreeItem<Real>* reserve_items(TreeMemory& memory, std::size_t bodies) noexcept {
  const std::size_t bytes = (bodies + 1) * sizeof(TreeItem<Real>);
  if (!memory.items.reserve(bytes) || !memory.spare.reserve(bytes) ||
      !memory.codes.reserve(2 * (bodies + 1) * sizeof(std::uint64_t))) {
    return nullptr;
  }
  return memory.items.as<TreeItem<Real>>();
}

template <class Real>
std::optional<Error> grow_trees(std::span<TreeItem<Real>> items, TreeMemory& memory,
                                Ordered<Real, Real>& out) {
  auto* const spare = memory.spare.template as<TreeItem<Real>>();
  CurveSorter<Real>(items.data(), spare, memory.codes.as<std::uint64_t>(), items.size())
      .sort(0, items.size());
  // Finest first: each tree is what its larger bodies leave, and those make the next one.
  std::array<std::size_t, kMaxTrees + 1> starts = {0};
  out.tree_count = 0;
  for (std::size_t begin = 0; begin < items.size();) {
    begin += part_all(items.subspan(begin), spare);
    starts[++out.tree_count] = begin;
  }
  std::reverse(items.begin(), items.end());
  std::uint32_t nodes = 0;
  for (std::size_t t = 0; t < out.tree_count; ++t) {
    const std::size_t begin = items.size() - starts[out.tree_count - t];
    const std::size_t end = items.size() - starts[out.tree_count - t - 1];
    std::reverse(items.begin() + static_cast<std::ptrdiff_t>(begin),
                 items.begin() + static_cast<std::ptrdiff_t>(end));
    nodes = shape_tree(out.trees[t], begin, end, nodes);
  }
  out.levels = 0;
  out.scanned = 0;
  out.bodies = items.size();
  return reserve_boxes(memory, nodes, out) ? std::nullopt : std::optional(out_of_memory());
}

template <class Real>
std::optional<Error> order_in_trees(const Means& means, const Source<Real>& source, double margin,
                                    OrderMemory& memory, TreeMemory& tree_memory,
                                    Ordered<Real, Real>& out) {
  TreeItem<Real>* const items = reserve_items<Real>(tree_memory, source.count);
  if (items == nullptr) return out_of_memory();
  std::size_t count = 0;
  for (std::size_t i = 0; i < source.count; ++i) {
    const SphereOf<Real> b = source[i];
    if (!is_valid(b)) continue;
    const std::uint16_t side = side_exponent(2 * static_cast<double>(b.r));
    items[count++] = {{b.x, b.y, b.z}, static_cast<std::uint32_t>(i), {side, side, side}};
  }
  if (auto error = grow_trees(std::span(items, count), tree_memory, out)) return error;
  if (!reserve_sorted(memory, count, out)) return out_of_memory();
  CullMap map;
  map.radius_pad = kUnderflowPad<Real, Real> + margin / 2;
  auto* const spheres = memory.sorted.template as<SphereOf<Real>>();
  const auto& kernels = means.kernels->of<Real>().template cull<Real>();
  if (auto error = means.run_pieces(count, kPieceBodies,
                                    [&](std::size_t, std::size_t begin, std::size_t end) {
                                      for (std::size_t p = begin; p < end; ++p) {
                                        spheres[p] = source[items[p].id];
                                        out.ids[p] = items[p].id;
                                      }
                                      kernels.cull_arrays(spheres, map, begin, end, out.cull);
                                    })) {
    return error;
  }
  for (std::size_t t = 0; t < out.tree_count; ++t) {
    Tree<Real>& tree = out.trees[t];
    tree.max_radius = *std::max_element(out.cull.r + tree.begin, out.cull.r + tree.end);
  }
  return means.run(out.tree_count,
                   [&](std::size_t t) { kernels.tree_of_spheres(out.cull, out.trees[t]); });
}

template TreeItem<float>* reserve_items(TreeMemory&, std::size_t) noexcept;
template TreeItem<double>* reserve_items(TreeMemory&, std::size_t) noexcept;
template std::optional<Error> grow_trees(std::span<TreeItem<float>>, TreeMemory&,
                                         Ordered<float, float>&);
template std::optional<Error> grow_trees(std::span<TreeItem<double>>, TreeMemory&,
                                         Ordered<double, double>&);
template std::optional<Error> order_in_trees(const Means&, const Source<float>&, double,
                                             OrderMemory&, TreeMemory&, Ordered<float, float>&);
template std::optional<Error> order_in_trees(const Means&, const Source<double>&, double,
                                             OrderMemory&, TreeMemory&, Ordered<double, double>&);

}  // namespace harpoon::broad
