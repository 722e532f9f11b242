#pragma once

// The one engine of a process under the preload, made at the first use and never destroyed:
// programs use libode until their very end.

#include <atomic>

#include "ode/engine.hpp"

namespace harpoon::ode {

/// Set once the engine is there; read by every event.
inline constinit std::atomic<Engine*> made_drop_in{nullptr};

/// The engine, or null when the options are wrong (said once): then everything is libode's.
Engine* drop_in();
/// The same, or null while nobody has needed it yet.
inline Engine* drop_in_if_made() {
  return made_drop_in.load(std::memory_order_acquire);
}

/// From now on dGeomMoved, or dCollide, tells the engine of its calls. Called by the engine.
void watch_moves();
void watch_contacts();

}  // namespace harpoon::ode
