#pragma once

// Stock dCollide as an oracle for single pairs.

#include "bench/selftest.hpp"

namespace harpoon::bench {

/// Named "dCollide". Keeps ODE alive as long as it is. Its radii must be >= 0 (ODE asserts).
/// ODE does not tell a grazing collision from a real one, so that word is told by the distance.
Oracle make_ode_oracle();

}  // namespace harpoon::bench
