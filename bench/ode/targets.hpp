#pragma once

// The figures that the cpu device must reach, as data, and their measurement. Each is a ratio of
// the fastest times of one interleaved run, so that it means the same on any machine and what else
// the machine does cannot move it.

#include <string>
#include <vector>

#include "bench/ode/pairs_bench.hpp"

namespace harpoon::bench {

enum class TargetVerdict {
  pass,
  missed,
  unsure,  ///< the times differ by more than what is missing: the run was too noisy to say
};

struct Target {
  std::string what;
  double measured = 0;
  Range sure;  ///< holds `measured`; its width is what the fastest times differ by
  double required = 0;
  std::string command;  ///< that measures the figure by itself

  [[nodiscard]] TargetVerdict verdict() const {
    if (measured >= required) {
      return TargetVerdict::pass;
    }
    return sure.high < required ? TargetVerdict::missed : TargetVerdict::unsure;
  }
};

struct TargetPlan {
  NamedDevice one_thread;
  NamedDevice two_threads;
  NamedDevice all_threads;
  unsigned rounds = 15;
};

/// Measures all targets, in about half a minute. The two-thread target is left out on a machine
/// with one core. When interrupted, returns what there is.
/// Errors: as `run_pairs`.
Result<std::vector<Target>> check_targets(const TargetPlan& plan, const ShareDone& share_done = {},
                                          const Interrupted& interrupted = {});

}  // namespace harpoon::bench
