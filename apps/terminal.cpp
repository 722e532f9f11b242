#include "apps/terminal.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>

namespace harpoon::app {

Terminal detect_terminal() {
  const char* term = std::getenv("TERM");
  const bool understands = term != nullptr && std::string_view(term) != "dumb" && *term != '\0';
  const char* no_color = std::getenv("NO_COLOR");
  const bool colour_forbidden = no_color != nullptr && *no_color != '\0';
  return {understands && isatty(STDERR_FILENO) != 0,
          understands && isatty(STDOUT_FILENO) != 0 && !colour_forbidden};
}

std::string coloured(const Terminal& terminal, Colour colour, std::string_view text) {
  if (!terminal.has_colour || colour == Colour::none) {
    return std::string(text);
  }
  const int code = colour == Colour::bold ? 1 : colour == Colour::green ? 32 : 31;
  return fmt::format("\x1b[{}m{}\x1b[0m", code, text);
}

}  // namespace harpoon::app
