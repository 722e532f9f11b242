#include "bench/contestant.hpp"

#include <algorithm>
#include <cmath>

namespace harpoon::bench {

std::uint64_t runs_per_turn(double warm_up_ns) {
  constexpr double kShortestTurnNs = 50e3;
  constexpr double kLongRunNs = 3e6;
  constexpr std::uint64_t kRuns = 10;
  constexpr std::uint64_t kLongRuns = 3;
  constexpr std::uint64_t kMostRuns = 100000;
  if (warm_up_ns > kLongRunNs) {
    return kLongRuns;
  }
  const double enough = std::ceil(kShortestTurnNs / std::max(warm_up_ns, 1.0));
  return std::clamp(static_cast<std::uint64_t>(enough), kRuns, kMostRuns);
}

}  // namespace harpoon::bench
