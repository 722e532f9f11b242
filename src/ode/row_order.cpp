#include "ode/row_order.hpp"

#include <algorithm>

namespace harpoon::ode {
namespace {

/// Rows up to this length are sorted by insertion.
constexpr std::size_t kShortRow = 24;

void sort_row(std::span<KeyedPair> row) {
  if (row.size() > kShortRow) {
    std::sort(row.begin(), row.end(),
              [](const KeyedPair& a, const KeyedPair& b) { return a.key < b.key; });
    return;
  }
  for (std::size_t i = 1; i < row.size(); ++i) {
    const KeyedPair pair = row[i];
    std::size_t hole = i;
    for (; hole > 0 && row[hole - 1].key > pair.key; --hole) row[hole] = row[hole - 1];
    row[hole] = pair;
  }
}

}  // namespace

/// After the scatter `starts_` holds where each row ends.
void RowOrder::finish(std::vector<IndexPair>& out, std::uint32_t rows) {
  std::size_t begin = 0;
  for (std::uint32_t row = 0; row < rows; ++row) {
    sort_row(std::span(sorted_).subspan(begin, starts_[row] - begin));
    begin = starts_[row];
  }
  std::size_t position = out.size();
  out.resize(position + sorted_.size());
  for (const KeyedPair& pair : sorted_) out[position++] = {pair.first, pair.second};
}

}  // namespace harpoon::ode
