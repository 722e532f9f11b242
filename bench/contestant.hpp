#pragma once

// What takes part in a comparison: something that can be asked to do a batch of so many pairs and
// says how long that took. The round-robin knows nothing else of it.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "harpoon/error.hpp"

namespace harpoon::bench {

/// How a contestant is named in results.
struct Label {
  std::string device;     ///< "ode", "cpu", ...
  std::string precision;  ///< "f32" or "f64"
  unsigned threads = 1;
  std::string format;  ///< "records", "arrays", "indexed"; how the pairs are laid out
  bool modelled = false;
  double bytes_per_pair = 0;  ///< in and out
};

/// One turn: the batch done many times in a row, warm. A sample is the time of one run of it; of a
/// run too short for the clock, the mean over several.
struct Turn {
  std::vector<double> samples_ns;
  std::uint64_t runs = 0;  ///< of the batch, in all samples
};

class Contestant {
 public:
  virtual ~Contestant() = default;
  [[nodiscard]] virtual const Label& label() const = 0;
  /// Times the first `count` pairs. Errors are those of the device.
  virtual Result<Turn> take_turn(std::size_t count) = 0;
};

/// How a turn is divided, from the duration of its warm-up run.
struct TurnShape {
  std::uint64_t samples = 1;
  std::uint64_t runs_per_sample = 1;
};

/// Ten samples of at least 20 us each (the paper's X executions); three when a run takes more than
/// 3 ms.
TurnShape shape_turn(double warm_up_ns);

/// Takes the samples. `time_runs(n)` returns a Result<double>: the nanoseconds of n runs.
template <class TimeRuns>
Result<Turn> take_samples(double warm_up_ns, const TimeRuns& time_runs) {
  const TurnShape shape = shape_turn(warm_up_ns);
  Turn turn;
  for (std::uint64_t i = 0; i < shape.samples; ++i) {
    const Result<double> ns = time_runs(shape.runs_per_sample);
    if (!ns) {
      return ns.error();
    }
    turn.samples_ns.push_back(*ns / static_cast<double>(shape.runs_per_sample));
    turn.runs += shape.runs_per_sample;
  }
  return turn;
}

}  // namespace harpoon::bench
