#pragma once

// The preload's only output: one line per event on standard error, begun with "harpoon: ".

#include <string_view>

#include "harpoon/device.hpp"

namespace harpoon::ode {

/// Writes the line in one piece. Thread-safe.
void write_log_line(LogLevel level, std::string_view line);

}  // namespace harpoon::ode
