#pragma once

// Whether calls of ODE arrive at Harpoon: kept for those who ask for statistics, verification or
// service (`harpoon run`) and would take silence for success.

#include <atomic>

namespace harpoon::ode {

/// The variable by which `harpoon run` asks to be told: "PID FD DEVICE INODE" of a file of its own,
/// whose first byte becomes 1 when a call arrives and whose second when a libode is served.
inline constexpr const char* kArrivalVariable = "HARPOON_ARRIVAL";

inline constinit std::atomic<bool> has_arrived{false};

void tell_arrival();

/// A space is to be collided.
inline void note_arrival() {
  if (!has_arrived.load(std::memory_order_relaxed)) tell_arrival();
}

/// A libode is served.
void note_service();

}  // namespace harpoon::ode
