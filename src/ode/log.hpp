#pragma once

// The preload's only output: one line per event on standard error, begun with "harpoon: ". Needs no
// C++ run time.

#include <initializer_list>
#include <string_view>

#include "harpoon/device.hpp"

namespace harpoon::ode {

/// Writes the parts as one line in one piece, control characters as question marks; what is longer
/// than a pipe takes at once is cut. Thread-safe.
void write_log_line(LogLevel level, std::initializer_list<std::string_view> parts);

inline void write_log_line(LogLevel level, std::string_view line) {
  write_log_line(level, {line});
}

}  // namespace harpoon::ode
