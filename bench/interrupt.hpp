#pragma once

// How a long measurement is told to stop: it asks now and then, and returns early with what it has.
// The caller, who knows why, decides what the incomplete result is worth.

#include <functional>

namespace harpoon::bench {

/// Answers true once the work should stop; may be empty. Called from the measuring thread only.
using Interrupted = std::function<bool()>;

inline bool must_stop(const Interrupted& interrupted) {
  return interrupted && interrupted();
}

}  // namespace harpoon::bench
