#pragma once

// The paper's experiment end to end: Figures 6 and 7, the table, and whether the contacts are
// right. It prints and writes nothing.

#include <vector>

#include "bench/device_contestant.hpp"
#include "bench/machine_load.hpp"
#include "bench/ode/pairs_bench.hpp"
#include "bench/selftest.hpp"

namespace harpoon::app {

struct ExperimentPlan {
  std::vector<bench::NamedDevice> devices;        ///< of the figures
  std::vector<bench::NamedDevice> table_devices;  ///< of the table
  /// A twentieth of the counts and few rounds: to see that everything works, not to measure.
  bool quick = false;
};

struct Experiment {
  bench::PairsOutcome figure6;
  bench::PairsOutcome figure7;
  bench::PairsOutcome table;
  /// Every table device on the recorded pairs, against Algorithm 1.
  std::vector<bench::SelftestCheck> checks;
  bench::MachineLoad load;  ///< while it was measured
  bool quick = false;       ///< as planned

  [[nodiscard]] bool contacts_are_right() const;
};

/// Takes about 50 s on two idle cores.
/// Throws CommandError.
Experiment run_experiment(const ExperimentPlan& plan, const bench::ShareDone& share_done);

}  // namespace harpoon::app
