#include "bench/scene/scaling.hpp"

#include <algorithm>

namespace harpoon::bench {
namespace {

/// Bodies that a point should move in all its frames together, where the world is small.
constexpr std::size_t kBodyFrames = 2000000;

ScenePlan plan_of(const ScalingPlan& plan, WorldKind kind, std::size_t bodies) {
  ScenePlan point;
  point.kind = kind;
  point.bodies = bodies;
  const auto more = static_cast<unsigned>(std::min<std::size_t>(kMostFrames, kBodyFrames / bodies));
  point.frames = std::max(plan.frames, more);
  point.threads = plan.threads;
  point.f64 = plan.f64;
  point.seed = plan.seed;
  return point;
}

}  // namespace

std::vector<std::size_t> scaling_sizes(std::size_t most) {
  std::vector<std::size_t> sizes;
  for (std::size_t n = 1000; n < most; n *= 10) sizes.push_back(n);
  sizes.push_back(most);
  return sizes;
}

Result<std::vector<ScalingPoint>> run_scaling(const ScalingPlan& plan,
                                              const std::function<void(double)>& share,
                                              const Interrupted& interrupted) {
  const std::vector<std::size_t> sizes = scaling_sizes(plan.most_bodies);
  std::vector<ScalingPoint> points;
  double work = 0;
  for (const std::size_t n : sizes) work += static_cast<double>(n);
  work *= static_cast<double>(plan.kinds.size());
  double done = 0;
  for (const WorldKind kind : plan.kinds) {
    for (const std::size_t bodies : sizes) {
      const ScenePlan point = plan_of(plan, kind, bodies);
      const auto part = [&](double of_point) {
        share((done + of_point * static_cast<double>(bodies)) / work);
      };
      auto outcome = run_scene(point, part, interrupted);
      if (!outcome) return outcome.error();
      if (must_stop(interrupted)) return points;
      points.push_back({point, *std::move(outcome)});
      done += static_cast<double>(bodies);
    }
  }
  return points;
}

std::string scaling_json(const ScalingPlan& plan, const std::vector<ScalingPoint>& points,
                         const Machine& machine, const std::string& command) {
  Json results = Json::array();
  bool counts_agree = true;
  for (const ScalingPoint& point : points) {
    counts_agree = counts_agree && point.outcome.counts_agree;
    for (Json& row : scene_results(point.plan, point.outcome)) results.push_back(std::move(row));
  }
  return scene_document({plan.frames, plan.seed, counts_agree, {}}, std::move(results), machine,
                        command);
}

}  // namespace harpoon::bench
