#pragma once

// A text table for people, no wider than a terminal: columns as wide as their widest cell, or
// narrower with their texts broken into lines where the table would be too wide otherwise.

#include <cstddef>
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

/// Columns of a terminal.
inline constexpr std::size_t kLineWidth = 80;

/// Title line, then one line per row; two spaces between columns, none at the end of a line.
/// Where that is wider than kLineWidth, spaces between columns become one, then titles above
/// numbers are broken at spaces, then texts, the widest first, and within words last of all.
/// Numbers are never broken: where they do not fit beside each other at all, they are left as wide
/// as they are.
std::string format_table(const Terminal& terminal, const std::vector<Column>& columns,
                         const std::vector<std::vector<Cell>>& rows);

/// The text in lines of at most `width`, broken at spaces, within words where one is longer.
std::vector<std::string> broken_into_lines(const std::string& text, std::size_t width);

/// A sentence below a table: the text in lines of kLineWidth, with a newline at the end.
std::string paragraph(const std::string& text);

}  // namespace harpoon::app
