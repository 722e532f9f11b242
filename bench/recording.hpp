#pragma once

// Pairs of one type recorded from the running diamond world: which spheres, and where every sphere
// was at that step, so that ODE can be asked again about the very same pairs.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bench/lattice.hpp"
#include "bench/pair_type.hpp"
#include "harpoon/records.hpp"

namespace harpoon::bench {

/// How many candidate pairs of each flow the broad phase delivered while recording.
struct Census {
  std::uint64_t fake = 0;
  std::uint64_t grazing = 0;
  std::uint64_t real = 0;

  [[nodiscard]] std::uint64_t candidates() const { return fake + grazing + real; }
};

/// The spheres at one step and the range of pairs taken there.
struct Frame {
  std::vector<Point> positions;
  std::size_t first_pair = 0;
  std::size_t pair_count = 0;
};

struct Recording {
  PairType type = PairType::real;
  double radius = 0;
  std::vector<Frame> frames;     ///< in time order, each with at least one pair
  std::vector<IndexPair> pairs;  ///< in the order of ODE's callbacks
  Census census;
  std::uint64_t steps = 0;  ///< world steps that were run
  /// The pairs did not occur but were made (see `record`).
  bool constructed = false;
};

/// The first `count` pairs as records. When `count` exceeds the recording, it starts again from the
/// first pair. Positions are rounded to Real.
template <class Real>
std::vector<SpherePairOf<Real>> to_records(const Recording& recording, std::size_t count);

}  // namespace harpoon::bench
