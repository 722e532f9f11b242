#pragma once

// How Harpoon's times grow: the scene benchmark over sizes, each size a run of its own without
// peers.

#include <functional>
#include <string>
#include <vector>

#include "bench/scene/scene_bench.hpp"

namespace harpoon::bench {

struct ScalingPlan {
  std::vector<WorldKind> kinds;
  std::size_t most_bodies = 4000000;
  unsigned frames = 12;  ///< of the largest worlds; small ones get more, up to kMostFrames
  unsigned threads = 1;
  bool f64 = false;
  std::uint64_t seed = 1;
};
inline constexpr unsigned kMostFrames = 200;

/// 10^3 and then 10 times more as long as that is below `most`, then `most`.
std::vector<std::size_t> scaling_sizes(std::size_t most);

struct ScalingPoint {
  ScenePlan plan;
  SceneOutcome outcome;
};

/// One point for each kind and size, kinds one after the other. Errors: the first of a run.
Result<std::vector<ScalingPoint>> run_scaling(const ScalingPlan& plan,
                                              const std::function<void(double)>& share,
                                              const Interrupted& interrupted);

/// As scene_json, with the results of all points.
std::string scaling_json(const ScalingPlan& plan, const std::vector<ScalingPoint>& points,
                         const Machine& machine, const std::string& command);

}  // namespace harpoon::bench
