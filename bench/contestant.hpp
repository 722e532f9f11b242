#pragma once

// What takes part in a comparison: something that can be asked to do a batch of so many pairs and
// says how long that took. The round-robin knows nothing else of it.

#include <cstddef>
#include <cstdint>
#include <string>

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

/// One turn: the batch done `runs` times in a row, warm, and averaged (the paper's section IV.A).
struct Turn {
  double ns = 0;  ///< of one run of the batch
  std::uint64_t runs = 0;
};

class Contestant {
 public:
  virtual ~Contestant() = default;
  [[nodiscard]] virtual const Label& label() const = 0;
  /// Times the first `count` pairs. Errors are those of the device.
  virtual Result<Turn> take_turn(std::size_t count) = 0;
};

/// How often a batch is run in one turn, from the duration of its warm-up run: at least ten times
/// and at least for 50 us, but only three times when one run takes more than 3 ms.
std::uint64_t runs_per_turn(double warm_up_ns);

}  // namespace harpoon::bench
