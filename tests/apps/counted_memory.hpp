#pragma once

// Counts the memory that a program takes with new: link counted_memory.cpp into it.

#include <cstddef>

namespace harpoon::app {

/// Most bytes that were taken at once since the last `reset`, beside those that were taken then.
std::size_t peak_bytes();
void reset_peak();

}  // namespace harpoon::app
