#pragma once

// The one way in which stock libode and the drop-in are compared: the same subject in two
// processes, this one with the drop-in and another with stock libode, in turn. It makes neither
// process itself.

#include <vector>

#include "bench/interrupt.hpp"
#include "bench/ode/twin.hpp"
#include "harpoon/error.hpp"

namespace harpoon::bench {

struct TwinPlan {
  Subject subject = {};
  double seconds = 2;          ///< of measuring, at least five steps
  bool compares_every = true;  ///< all states, or those of some more steps when all is measured
};

/// Of the measured steps.
struct StepTimes {
  std::vector<double> step_ms, collision_ms;
};

struct TwinOutcome {
  StepTimes stock, harpoon;
  std::size_t geoms = 0;
  double pairs = 0, contacts = 0;  ///< of a measured step, on average
  Program::Work last;              ///< the drop-in's last step
  bool identical = false;          ///< the numbers of pairs and contacts always, states as planned
};

/// A turn takes about a millisecond or, where that is longer, one step: between turns the other
/// process has the core and its caches. `stock` is a socket at whose other end a process without
/// the drop-in is in serve_twins. An interrupted outcome is incomplete.
/// Errors: device_unavailable when the drop-in is not in front of libode, or that process has gone.
Result<TwinOutcome> measure_twins(const TwinPlan& plan, int stock, const Interrupted& interrupted);

}  // namespace harpoon::bench
