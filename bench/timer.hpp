#pragma once

// The one clock of every measurement: wall time, monotonic. Wall and not CPU time, because the
// question is how long the caller waits.

#include <chrono>

namespace harpoon::bench {

/// Nanoseconds since an arbitrary point; never runs backwards.
inline double now_ns() {
  const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
  return static_cast<double>(
      std::chrono::duration_cast<std::chrono::nanoseconds>(since_start).count());
}

/// What a measured interval contains of the clock itself, in nanoseconds: the median distance of
/// two readings with nothing between them. Takes about a millisecond.
double measure_timer_overhead_ns();

}  // namespace harpoon::bench
