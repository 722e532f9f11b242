#pragma once

// The comparison behind `harpoon bench pairs`: ODE and every device on the same pairs, interleaved.
// It composes recorder, contestants and round-robin; it neither opens devices nor writes files.

#include <string>
#include <vector>

#include "bench/device_contestant.hpp"
#include "bench/ode/diamond.hpp"
#include "bench/recording.hpp"
#include "bench/round_robin.hpp"

namespace harpoon::bench {

/// Distinct pairs that are recorded at most; larger batches repeat them. They are Figure 7's most.
inline constexpr std::size_t kMostRecordedPairs = 90000;

struct PairsPlan {
  PairType type = PairType::real;
  Format format = Format::records;
  std::vector<std::size_t> counts = {10000};  ///< ascending, none 0
  bool f32 = true;
  bool f64 = true;
  unsigned rounds = 11;     ///< at least 1
  double time_limit_s = 0;  ///< when above 0: no further round after it, but three in any case
  bool figure5 = false;     ///< also time ODE the paper's way
  /// Measure copy bandwidth with so many threads each: on the f32 records of the batch where they
  /// are at least 8,000,000, else on memory of its own.
  std::vector<unsigned> copy_threads;
  std::size_t indexed_spheres = 100000;  ///< for Format::indexed
  std::uint64_t seed = 1;                ///< for Format::indexed
  DiamondParameters diamond;
  std::vector<NamedDevice> devices;
};

struct PairsOutcome {
  std::vector<Series> series;       ///< ODE first, then devices
  std::vector<Series> copy_series;  ///< empty unless asked for
  Census census;                    ///< of the recorded world; zeros for Format::indexed
  double timer_overhead_ns = 0;
  std::vector<std::string> notes;  ///< what a reader of the numbers must know
};

/// Share of the work that is done, 0 to 1.
using ShareDone = std::function<void(double)>;

/// Runs the plan. A device that cannot do a format or precision is left out with a note. When
/// interrupted, returns what there is.
/// Errors: invalid_argument (see `record`), and those of devices.
Result<PairsOutcome> run_pairs(const PairsPlan& plan, const ShareDone& share_done = {},
                               const Interrupted& interrupted = {});

}  // namespace harpoon::bench
