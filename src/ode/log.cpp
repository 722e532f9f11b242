#include "ode/log.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <string>

namespace harpoon::ode {

void write_log_line(LogLevel level, std::string_view line) {
  const std::string_view mark = level == LogLevel::error     ? "error: "
                                : level == LogLevel::warning ? "warning: "
                                                             : "";
  const std::string text = fmt::format("harpoon: {}{}\n", mark, line);
  // Nobody is left to tell when standard error is closed.
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
}

}  // namespace harpoon::ode
