#pragma once

// A text table for people: columns as wide as their widest cell.

#include <string>
#include <vector>

#include "apps/terminal.hpp"

namespace harpoon::app {

struct Column {
  std::string title;
  bool right = false;  ///< numbers are aligned to the right
};

struct Cell {
  std::string text;
  Colour colour = Colour::none;

  Cell(std::string from) : text(std::move(from)) {}  // NOLINT(google-explicit-constructor)
  Cell(const char* from) : text(from) {}             // NOLINT(google-explicit-constructor)
  Cell(std::string from, Colour with) : text(std::move(from)), colour(with) {}
};

/// Title line, then one line per row; two spaces between columns, none at the end of a line.
std::string format_table(const Terminal& terminal, const std::vector<Column>& columns,
                         const std::vector<std::vector<Cell>>& rows);

}  // namespace harpoon::app
