#include "apps/table.hpp"

#include <algorithm>

namespace harpoon::app {
namespace {

// UTF-8: continuation bytes take no place.
bool takes_place(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
}

std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), takes_place));
}

// Where the first `width` characters of the text end.
std::size_t end_of(const std::string& text, std::size_t width) {
  std::size_t at = 0;
  for (; at < text.size(); ++at) {
    if (takes_place(text[at]) && width-- == 0) {
      break;
    }
  }
  return at;
}

std::size_t longest_word(const std::string& text) {
  std::size_t longest = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    longest = std::max(longest, width_of(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return longest;
}

// How wide the columns are, and how far apart.
class Layout {
 public:
  Layout(const std::vector<Column>& columns, const std::vector<std::vector<Cell>>& rows) {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      Limits limit{width_of(columns[c].title), longest_word(columns[c].title), 1, columns[c].right};
      for (const std::vector<Cell>& row : rows) {
        const std::size_t width = width_of(row[c].text);
        limit.width = std::max(limit.width, width);
        limit.words = std::max(limit.words, columns[c].right ? width : longest_word(row[c].text));
        limit.least = std::max(limit.least, columns[c].right ? width : std::size_t{1});
      }
      limits_.push_back(limit);
    }
    if (total() > kLineWidth) {
      gap_ = 1;
    }
    shrink(&Limits::words, true);
    shrink(&Limits::words, false);
    shrink(&Limits::least, true);
    shrink(&Limits::least, false);
  }

  [[nodiscard]] std::size_t width(std::size_t column) const { return limits_[column].width; }
  [[nodiscard]] std::size_t gap() const { return gap_; }

 private:
  struct Limits {
    std::size_t width;
    std::size_t words;  ///< without a break inside a word
    std::size_t least;
    bool numbers;
  };

  [[nodiscard]] std::size_t total() const {
    std::size_t sum = gap_ * (limits_.size() - 1);
    for (const Limits& limit : limits_) {
      sum += limit.width;
    }
    return sum;
  }

  // Makes the widest column of numbers, or of texts, narrower, again and again, down to a limit of
  // each.
  void shrink(std::size_t Limits::*floor, bool numbers) {
    while (total() > kLineWidth) {
      const auto can = [&](const Limits& limit) {
        return limit.numbers == numbers && limit.width > limit.*floor;
      };
      const auto widest =
          std::max_element(limits_.begin(), limits_.end(), [&](const Limits& a, const Limits& b) {
            return (can(a) ? a.width : 0) < (can(b) ? b.width : 0);
          });
      if (!can(*widest)) {
        return;
      }
      --widest->width;
    }
  }

  std::vector<Limits> limits_;
  std::size_t gap_ = 2;
};

}  // namespace

std::vector<std::string> broken_into_lines(const std::string& text, std::size_t width) {
  std::vector<std::string> lines;
  std::string rest = text;
  while (width_of(rest) > width) {
    std::size_t end = end_of(rest, width);
    const std::size_t space = rest.rfind(' ', end);
    std::size_t next = end;
    if (space != std::string::npos && space > 0) {
      end = space;
      next = space + 1;
    }
    lines.push_back(rest.substr(0, end));
    rest.erase(0, next);
  }
  lines.push_back(rest);
  return lines;
}

std::string paragraph(const std::string& text) {
  std::string out;
  for (const std::string& line : broken_into_lines(text, kLineWidth)) {
    out += line + "\n";
  }
  return out;
}

std::string format_table(const Terminal& terminal, const std::vector<Column>& columns,
                         const std::vector<std::vector<Cell>>& rows) {
  const Layout layout(columns, rows);
  std::string out;
  const auto add_row = [&](const auto& cell_at) {
    std::vector<std::vector<std::string>> lines;
    std::size_t height = 1;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      lines.push_back(broken_into_lines(cell_at(c).text, layout.width(c)));
      height = std::max(height, lines.back().size());
    }
    for (std::size_t line = 0; line < height; ++line) {
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const std::string text = line < lines[c].size() ? lines[c][line] : "";
        const std::string pad(layout.width(c) - width_of(text), ' ');
        const bool is_last = c + 1 == columns.size();
        out += columns[c].right ? pad : "";
        out += text.empty() ? "" : coloured(terminal, cell_at(c).colour, text);
        out += columns[c].right || is_last ? "" : pad;
        out += is_last ? "\n" : std::string(layout.gap(), ' ');
      }
    }
  };
  add_row([&](std::size_t c) { return Cell(columns[c].title, Colour::bold); });
  for (const std::vector<Cell>& row : rows) {
    add_row([&](std::size_t c) { return row[c]; });
  }
  return out;
}

}  // namespace harpoon::app
