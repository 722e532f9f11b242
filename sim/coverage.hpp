#pragma once

// Which lines of the RTL a Verilated model reached: written to a file of its own in the folder that
// HARPOON_RTL_COVERAGE names at compile time; without it, nothing is.

#include "verilated.h"

#ifdef HARPOON_RTL_COVERAGE
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <string>

#include "verilated_cov.h"
#endif

namespace harpoon::sim {

inline void write_coverage([[maybe_unused]] VerilatedContext& context) {
#ifdef HARPOON_RTL_COVERAGE
  static std::atomic<int> count = 0;
  const std::filesystem::path folder = HARPOON_RTL_COVERAGE;
  const std::string name = std::to_string(::getpid()) + "_" + std::to_string(count++) + ".dat";
  std::filesystem::create_directories(folder);
  context.coveragep()->write((folder / name).c_str());
#endif
}

}  // namespace harpoon::sim
