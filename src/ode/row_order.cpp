#include "ode/row_order.hpp"

#include <algorithm>

namespace harpoon::ode {
namespace {

/// Rows up to this length are sorted by counting smaller keys.
constexpr std::size_t kShortRow = 24;

/// Writes the row to `out` by key. Keys differ.
void put_sorted(std::span<KeyedPair> row, IndexPair* out) {
  if (row.size() > kShortRow) {
    std::sort(row.begin(), row.end(),
              [](const KeyedPair& a, const KeyedPair& b) { return a.key < b.key; });
    for (const KeyedPair& pair : row) *out++ = {pair.first, pair.second};
    return;
  }
  // Rows are short and in no order: without branches there is nothing to mispredict.
  for (const KeyedPair& pair : row) {
    std::size_t place = 0;
    for (const KeyedPair& other : row) place += other.key < pair.key ? 1 : 0;
    out[place] = {pair.first, pair.second};
  }
}

}  // namespace

/// After the scatter `starts_` holds where each row ends.
void RowOrder::finish(std::vector<IndexPair>& out, std::uint32_t rows) {
  const std::size_t position = out.size();
  out.resize(position + sorted_.size());
  std::size_t begin = 0;
  for (std::uint32_t row = 0; row < rows; ++row) {
    put_sorted(std::span(sorted_).subspan(begin, starts_[row] - begin),
               out.data() + position + begin);
    begin = starts_[row];
  }
}

}  // namespace harpoon::ode
