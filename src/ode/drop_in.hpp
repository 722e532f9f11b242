#pragma once

// The one engine of a process under the preload, made at the first use and never destroyed:
// programs use libode until their very end.

#include "ode/engine.hpp"

namespace harpoon::ode {

/// The engine, or null when the options are wrong (said once): then everything is libode's.
Engine* drop_in();
/// The same, or null while nobody has needed it yet.
Engine* drop_in_if_made();

}  // namespace harpoon::ode
