#include "ode/hash_order.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace harpoon::ode {
namespace {

/// libode's bounds of cell numbers: integers that both an int and a Real hold exactly.
template <class Real>
constexpr Real kMaxCell = sizeof(Real) == 4 ? Real((1 << 24) - 1)
                                            : Real(std::numeric_limits<std::int32_t>::max());
template <class Real>
constexpr Real kMinCell = sizeof(Real) == 4 ? -kMaxCell<Real>
                                            : Real(std::numeric_limits<std::int32_t>::min());

template <class Real>
bool is_infinite(const BoundsBox<Real>& box) {
  constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
  return box.v[0] <= -kInfinity || box.v[1] >= kInfinity || box.v[2] <= -kInfinity ||
         box.v[3] >= kInfinity || box.v[4] <= -kInfinity || box.v[5] >= kInfinity;
}

/// Whether the bucket numbers of a column wrap for a geom whose cells there begin at `low_z`. Sums
/// are exact in 64 bits: each term is below 2^39.
bool wraps(std::int32_t level, std::int32_t x, std::int32_t y, std::int32_t low_z) {
  const std::uint64_t base = static_cast<std::uint32_t>(level) * std::uint64_t{1000} +
                             static_cast<std::uint32_t>(x) * std::uint64_t{100} +
                             static_cast<std::uint32_t>(y) * std::uint64_t{10};
  return static_cast<std::int64_t>(base) + low_z < 0;
}

/// Rounds down a number that an int holds.
template <class Real>
std::int32_t floor_of(Real value) {
  const auto whole = static_cast<std::int32_t>(value);
  return whole - (value < static_cast<Real>(whole) ? 1 : 0);
}

/// The exponent that std::frexp gives.
int exponent_of(double value) {
  constexpr int kBias = 1022, kSpecial = 0x7FF;
  const int biased = static_cast<int>(std::bit_cast<std::uint64_t>(value) >> 52) & kSpecial;
  int exponent = biased - kBias;
  if (biased == 0 || biased == kSpecial) (void)std::frexp(value, &exponent);
  return exponent;
}

}  // namespace

template <class Real>
bool HashOrder<Real>::discretise(const BoundsBox<Real>& box, int min_level, int max_level,
                                 Cells& cells) {
  cells = {kBig, {}, {}};
  if (is_infinite(box)) return true;
  Real extent = box.v[1] - box.v[0];
  extent = std::max(extent, box.v[3] - box.v[2]);
  extent = std::max(extent, box.v[5] - box.v[4]);
  const int level = std::max(exponent_of(static_cast<double>(extent)), min_level);
  if (level > max_level) return true;
  if (level != scale_level_) {
    scale_ = Real(1) / std::ldexp(Real(1), level);
    scale_level_ = level;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const Real low = box.v[2 * axis] * scale_, high = box.v[2 * axis + 1] * scale_;
    if (!(low >= kMinCell<Real> && low < kMaxCell<Real> && high >= kMinCell<Real> &&
          high < kMaxCell<Real>)) {
      return false;
    }
    cells.low[axis] = floor_of(low);
    cells.high[axis] = floor_of(high);
  }
  cells.level = level;
  return true;
}

template <class Real>
void HashOrder<Real>::prepare(const Mirror<Real>& mirror, int min_level, int max_level) {
  const std::uint32_t count = mirror.size();
  cells_.resize(count);
  stray_.assign(count, 0);
  has_stray_ = false;
  has_nan_ = (mirror.all_traits & kIsNan) != 0;
  if (has_nan_) skip_.assign(count, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool is_nan = (mirror.traits[i] & kIsNan) != 0;
    if (is_nan) skip_[i] = 1;
    if (!discretise(mirror.bounds[i], min_level, max_level, cells_[i]) || is_nan) {
      stray_[i] = 1;
      has_stray_ = true;
    }
  }
}

template <class Real>
typename HashOrder<Real>::Found HashOrder<Real>::small_key_of(std::uint32_t first,
                                                              std::uint32_t second,
                                                              std::uint64_t& key) const {
  const Cells& a = cells_[first];
  const Cells& b = cells_[second];
  const int shift = std::min(b.level - a.level, 31);
  std::int32_t base[3], low[3], high[3];
  for (int axis = 0; axis < 3; ++axis) {
    base[axis] = a.low[axis] >> shift;
    low[axis] = std::max(base[axis], b.low[axis]);
    high[axis] = std::min(a.high[axis] >> shift, b.high[axis]);
    if (low[axis] > high[axis]) return Found::never;
  }
  const auto keyed = [&](std::int32_t x, std::int32_t y) {
    return static_cast<std::uint64_t>(b.level - a.level) << 40 |
           static_cast<std::uint64_t>(x - base[0]) << 38 |
           static_cast<std::uint64_t>(y - base[1]) << 36 |
           static_cast<std::uint64_t>(low[2] - base[2]) << 34 | (0xFFFFFFFFu - second);
  };
  // Mostly no column wraps: both begin at or above 0, or x, y or the level makes the base huge.
  if ((~(base[2] | b.low[2]) | low[0] | low[1] | b.level) < 0) {
    key = keyed(low[0], low[1]);
    return Found::yes;
  }
  for (std::int32_t x = low[0]; x <= high[0]; ++x) {
    for (std::int32_t y = low[1]; y <= high[1]; ++y) {
      if (wraps(b.level, x, y, base[2]) == wraps(b.level, x, y, b.low[2])) {
        key = keyed(x, y);
        return Found::yes;
      }
    }
  }
  key = keyed(low[0], low[1]);
  return Found::missed;
}

template <class Real>
std::size_t HashOrder<Real>::append(std::span<const IndexPair> pairs, bool as_stock, RowOrder& rows,
                                    std::vector<IndexPair>& out) {
  std::size_t missed = 0;
  rows.pairs.clear();
  rows.pairs.reserve(pairs.size());
  big_.clear();
  for (const auto& [i, j] : pairs) {
    std::uint32_t first = i, second = j;
    const std::int32_t first_level = cells_[i].level, second_level = cells_[j].level;
    if (second_level < first_level) std::swap(first, second);
    if (cells_[second].level == kBig) {
      // All of small x big comes before big x big.
      const std::uint64_t class_bit = cells_[first].level == kBig ? 1 : 0;
      big_.push_back({class_bit << 63 | std::uint64_t{first} << 31 | second, first, second});
      continue;
    }
    std::uint64_t key = 0;
    const Found found = small_key_of(first, second, key);
    if (found == Found::missed) ++missed;
    if (found == Found::yes || (found == Found::missed && !as_stock)) {
      rows.pairs.push_back({key, first, second});
    }
  }
  rows.append_to(out, static_cast<std::uint32_t>(cells_.size()),
                 [](std::uint32_t first) { return first; });
  std::sort(big_.begin(), big_.end(),
            [](const KeyedPair& a, const KeyedPair& b) { return a.key < b.key; });
  for (const KeyedPair& pair : big_) out.push_back({pair.first, pair.second});
  return missed;
}

template <class Real>
bool HashOrder<Real>::update(const Mirror<Real>& mirror, const SlotChange& change, int min_level,
                             int max_level) {
  change.apply_to(cells_);
  for (const std::uint32_t slot : change.fresh) {
    if (!discretise(mirror.bounds[slot], min_level, max_level, cells_[slot])) return false;
  }
  return true;
}

template <class Real>
std::uint64_t HashOrder<Real>::row_of(IndexPair oriented) const {
  // All of small x big comes after the small ones' rows, and big x big after that.
  const bool first_is_big = cells_[oriented.g1].level == kBig;
  const bool second_is_big = cells_[oriented.g2].level == kBig;
  const std::uint64_t part = (first_is_big ? 1u : 0u) + (second_is_big ? 1u : 0u);
  return part << 32 | oriented.g1;
}

template <class Real>
typename HashOrder<Real>::Found HashOrder<Real>::key_of(IndexPair oriented,
                                                        std::uint64_t& key) const {
  if (cells_[oriented.g2].level != kBig) return small_key_of(oriented.g1, oriented.g2, key);
  key = oriented.g2;
  return Found::yes;
}

template class HashOrder<float>;
template class HashOrder<double>;

}  // namespace harpoon::ode
