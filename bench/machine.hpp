#pragma once

// Where and by what a figure was measured.

#include <string>

namespace harpoon::bench {

struct Machine {
  std::string cpu;
  unsigned cores = 0;  ///< hardware threads this process may use
  double memory_gb = 0;
  std::string os;
  std::string kernel;
  std::string compiler;         ///< that built Harpoon
  std::string instruction_set;  ///< widest in use
  std::string ode;              ///< version and precision, or "absent"
  std::string harpoon;          ///< version
  double cache_mb = 0;          ///< the largest cache; 0 where the machine does not tell
};

/// Reads the running machine; fields that it does not tell are "unknown".
Machine describe_machine();

/// The commit this was built from, "-dirty" appended when files differed; "unknown" outside git.
std::string build_commit();

/// The present time, ISO 8601 in UTC, to the second.
std::string timestamp();

}  // namespace harpoon::bench
