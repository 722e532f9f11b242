#include "bench/scene/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "bench/chart.hpp"

namespace harpoon::bench {
namespace {

/// Rows of an outcome, in the order in which run_scene makes them.
const SceneRow& row_of(const ScalingPoint& point, HarpoonMode mode) {
  return point.outcome.rows[static_cast<std::size_t>(mode)];
}

double ns_per_body(double ms, const ScalingPoint& point) {
  return ms * 1e6 / static_cast<double>(point.plan.bodies);
}

std::string sizes_table(const std::vector<ScalingPoint>& points, WorldKind kind) {
  std::string text =
      "| bodies | contacts | `detect` ms | ns a body | `Scene` ms | still, ms | set again, ms | "
      "set again, GB/s | `overlap_pairs` ms |\n"
      "| ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (const ScalingPoint& p : points) {
    if (p.plan.kind != kind) continue;
    const SceneRow& detect = row_of(p, HarpoonMode::detect);
    const SceneRow& again = row_of(p, HarpoonMode::again);
    text += fmt::format(
        "| {} | {} | {:.3f} | {:.1f} | {:.3f} | {:.6f} | {:.4f} | {:.1f} | {:.3f} |\n",
        p.plan.bodies, detect.contacts, detect.ms.median, ns_per_body(detect.ms.median, p),
        row_of(p, HarpoonMode::scene).ms.median, row_of(p, HarpoonMode::still).ms.median,
        again.ms.median, static_cast<double>(again.bytes_floor) * 1e-6 / again.ms.median,
        row_of(p, HarpoonMode::bounds).ms.median);
  }
  return text;
}

std::string stages_table(const ScalingPoint& point) {
  const SceneRow& row = row_of(point, HarpoonMode::detect);
  const StageBytes floor = stage_floor(point.plan.bodies, row.contacts, point.plan.f64);
  struct Line {
    const char* stage;
    double ms;
    std::uint64_t bytes;
  };
  const std::array<Line, 4> lines = {{{"survey", row.stages.survey, floor.survey},
                                      {"order", row.stages.order, floor.order},
                                      {"search", row.stages.search, floor.search},
                                      {"contacts", row.stages.contacts, floor.contacts}}};
  std::string text =
      "| stage | ms | ns a body | floor, MB | floor / time, GB/s |\n| --- | ---: | ---: | ---: | "
      "---: |\n";
  for (const Line& line : lines) {
    const double megabytes = static_cast<double>(line.bytes) * 1e-6;
    text +=
        fmt::format("| {} | {:.3f} | {:.1f} | {:.1f} | {:.1f} |\n", line.stage, line.ms,
                    ns_per_body(line.ms, point), megabytes, line.ms > 0 ? megabytes / line.ms : 0);
  }
  return text;
}

std::vector<WorldKind> kinds_of(const std::vector<ScalingPoint>& points) {
  std::vector<WorldKind> kinds;
  for (const ScalingPoint& p : points) {
    if (kinds.empty() || kinds.back() != p.plan.kind) kinds.push_back(p.plan.kind);
  }
  return kinds;
}

}  // namespace

StageBytes stage_floor(std::uint64_t bodies, std::uint64_t contacts, bool f64) {
  const std::uint64_t body = f64 ? sizeof(SphereF64) : sizeof(Sphere);
  const std::uint64_t contact = f64 ? sizeof(BodyContactF64) : sizeof(BodyContact);
  const std::uint64_t id = sizeof(std::uint32_t);
  const std::uint64_t culling = 4 * sizeof(float);
  const std::uint64_t candidate = 2 * id;
  return {bodies * body, bodies * (body + body + id + culling),
          bodies * culling + contacts * candidate,
          bodies * (body + id) + contacts * (candidate + contact)};
}

std::string scaling_markdown(const std::vector<ScalingPoint>& points, const Machine& machine,
                             const std::string& command, const std::string& plot) {
  std::string text = "# The scene in figures\n\n";
  if (points.empty()) return text;
  const ScenePlan& first = points.front().plan;
  text += fmt::format(
      "Written by\n\n    {}\n\nat commit {}: {}, {} cores, {}; {} thread{}, {}. Medians over "
      "frames in\nwhich every body moves by 2 % of its radius. \"still\" is a frame of a `Scene` "
      "in which nothing\nmoves; \"set again\" the same where the caller hands in all bodies anew, "
      "with the rate at which\nthey are compared. The reasons are in [scene.md](scene.md).\n\n",
      command, build_commit(), machine.cpu, machine.cores, machine.instruction_set, first.threads,
      first.threads == 1 ? "" : "s", first.f64 ? "double" : "float");
  text += fmt::format("![Nanoseconds a body over the number of bodies]({})\n", plot);
  for (const WorldKind kind : kinds_of(points)) {
    text += fmt::format("\n## {}\n\n{}", to_string(kind), sizes_table(points, kind));
    const auto last = std::find_if(points.rbegin(), points.rend(),
                                   [&](const ScalingPoint& p) { return p.plan.kind == kind; });
    text += fmt::format("\nStages of `detect` at {} bodies:\n\n{}", last->plan.bodies,
                        stages_table(*last));
  }
  return text;
}

std::string scaling_svg(const std::vector<ScalingPoint>& points) {
  if (points.empty()) return "";
  Chart chart;
  chart.caption = "bodies; ns a body, detect";
  double most_bodies = 0;
  double most_ns = 0;
  double least_ns = 1e300;
  for (const WorldKind kind : kinds_of(points)) {
    ChartLine line{std::string(to_string(kind)), {}};
    for (const ScalingPoint& p : points) {
      if (p.plan.kind != kind) continue;
      const auto bodies = static_cast<double>(p.plan.bodies);
      const double ns = ns_per_body(row_of(p, HarpoonMode::detect).ms.median, p);
      line.points.push_back({bodies, ns});
      most_bodies = std::max(most_bodies, bodies);
      most_ns = std::max(most_ns, ns);
      least_ns = std::min(least_ns, ns);
    }
    chart.lines.push_back(std::move(line));
  }
  chart.x = {1000, std::max(most_bodies, 2000.0), true};
  chart.y = decades_around(least_ns, most_ns * 1.01);
  return to_svg(chart);
}

}  // namespace harpoon::bench
