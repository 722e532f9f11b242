#pragma once

// What the standard streams are, and the few escapes the command uses.

#include <string>
#include <string_view>

namespace harpoon::app {

struct Terminal {
  bool shows_progress = false;  ///< standard error is a terminal that understands escapes
  bool has_colour = false;      ///< standard output is one, and NO_COLOR is not set
};

/// Looks at the streams and at TERM and NO_COLOR (any non-empty value forbids colour).
Terminal detect_terminal();

enum class Colour { none, bold, green, red };

/// `text` in that colour, or plainly when the terminal has none.
std::string coloured(const Terminal& terminal, Colour colour, std::string_view text);

}  // namespace harpoon::app
