#pragma once

// Stock dCollide on the recorded pairs: the fairer way beside Figure 5. The spheres of the recorded
// world are put where they were at each step, not timed; then the step's pairs are asked in a row,
// timed. The few spheres of one diamond are hot in cache, which is ODE at its best.

#include <memory>

#include "bench/contestant.hpp"
#include "bench/recording.hpp"

namespace harpoon::bench {

/// `recording` must outlive the result. Counts beyond the recording start it again. Like an ODE
/// program's callback, every call writes its contact into the same local variable.
std::unique_ptr<Contestant> make_ode_replay(const Recording& recording);

}  // namespace harpoon::bench
