#pragma once

// libharpoon_ode_engine, the library beside this one that does the work: opened when a program
// first collides a space, so that one that never does pays nothing for it.

#include "ode/libodes.hpp"

namespace harpoon::ode {

/// Its symbol of that name, or null: why has been said. Opened at the first call, by the path that
/// it had when this library was loaded.
void* find_in_engine_library(const char* name);

/// The service of a libode, made at the first call. Null where the libode is left to itself, and to
/// other threads while it is being made.
Service* serve(Libode& libode);

/// All services write their statistics that have not yet.
void report_all();

}  // namespace harpoon::ode
