#include "bench/contestant.hpp"

#include <algorithm>
#include <cmath>

namespace harpoon::bench {

TurnShape shape_turn(double warm_up_ns) {
  constexpr double kShortestSampleNs = 20e3;
  constexpr double kLongRunNs = 3e6;
  constexpr std::uint64_t kSamples = 10;
  constexpr std::uint64_t kLongSamples = 3;
  if (warm_up_ns > kLongRunNs) {
    return {kLongSamples, 1};
  }
  const double runs = std::ceil(kShortestSampleNs / std::max(warm_up_ns, 1.0));
  return {kSamples, static_cast<std::uint64_t>(runs)};
}

}  // namespace harpoon::bench
