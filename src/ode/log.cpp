#include "ode/log.hpp"

#include <unistd.h>

#include <climits>
#include <cstddef>

namespace harpoon::ode {

void write_log_line(LogLevel level, std::initializer_list<std::string_view> parts) {
  char text[PIPE_BUF];
  std::size_t size = 0;
  const auto append = [&](std::string_view part) {
    for (const char letter : part) {
      if (size == sizeof text - 1) return;
      const auto code = static_cast<unsigned char>(letter);
      text[size++] = code < ' ' || code == 0x7f ? '?' : letter;
    }
  };
  append("harpoon: ");
  if (level == LogLevel::error) append("error: ");
  if (level == LogLevel::warning) append("warning: ");
  for (const std::string_view part : parts) append(part);
  text[size++] = '\n';
  // Nobody is left to tell when standard error is closed.
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text, size);
}

}  // namespace harpoon::ode
