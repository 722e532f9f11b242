#include "apps/table.hpp"

#include <algorithm>

namespace harpoon::app {
namespace {

// UTF-8: continuation bytes take no place.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

}  // namespace

std::string format_table(const Terminal& terminal, const std::vector<Column>& columns,
                         const std::vector<std::vector<Cell>>& rows) {
  std::vector<std::size_t> widths;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::size_t width = width_of(columns[c].title);
    for (const std::vector<Cell>& row : rows) {
      width = std::max(width, width_of(row[c].text));
    }
    widths.push_back(width);
  }
  std::string out;
  const auto add_line = [&](const auto& cell_at) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const Cell cell = cell_at(c);
      const std::string pad(widths[c] - width_of(cell.text), ' ');
      const bool is_last = c + 1 == columns.size();
      out += columns[c].right ? pad : "";
      out += coloured(terminal, cell.colour, cell.text);
      out += columns[c].right || is_last ? "" : pad;
      out += is_last ? "\n" : "  ";
    }
  };
  add_line([&](std::size_t c) { return Cell(columns[c].title, Colour::bold); });
  for (const std::vector<Cell>& row : rows) {
    add_line([&](std::size_t c) { return row[c]; });
  }
  return out;
}

}  // namespace harpoon::app
