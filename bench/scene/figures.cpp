#include "bench/scene/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

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
      "| bodies | contacts | `detect` ms | ns a body | `Scene` ms | set again, ms | "
      "`overlap_pairs` "
      "ms |\n| ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n";
  for (const ScalingPoint& p : points) {
    if (p.plan.kind != kind) continue;
    const SceneRow& detect = row_of(p, HarpoonMode::detect);
    text += fmt::format("| {} | {} | {:.3f} | {:.1f} | {:.3f} | {:.4f} | {:.3f} |\n", p.plan.bodies,
                        detect.contacts, detect.ms.median, ns_per_body(detect.ms.median, p),
                        row_of(p, HarpoonMode::scene).ms.median,
                        row_of(p, HarpoonMode::still).ms.median,
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

/// Logarithmic axes on a canvas of fixed size.
class Axes {
 public:
  static constexpr double kWidth = 640, kHeight = 360, kLeft = 56, kRight = 130, kTop = 16,
                          kBottom = 40;

  Axes(double x_low, double x_high, double y_low, double y_high)
      : x_low_(x_low), x_high_(x_high), y_low_(y_low), y_high_(y_high) {}
  [[nodiscard]] double x(double value) const {
    return kLeft + (kWidth - kLeft - kRight) * part(value, x_low_, x_high_);
  }
  [[nodiscard]] double y(double value) const {
    return kHeight - kBottom - (kHeight - kTop - kBottom) * part(value, y_low_, y_high_);
  }

 private:
  static double part(double value, double low, double high) {
    return std::log(value / low) / std::log(high / low);
  }
  double x_low_, x_high_, y_low_, y_high_;
};

std::string label(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     text);
}

std::string grid_line(double x1, double y1, double x2, double y2) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#ccc\"/>\n", x1, y1,
      x2, y2);
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
      "frames "
      "in\nwhich every body moves by 2 % of its radius; \"set again\" is a frame of a `Scene` "
      "whose "
      "bodies are\nset where they are. The reasons are in [scene.md](scene.md).\n\n",
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
  double most_bodies = 0;
  double most_ns = 0;
  double least_ns = 1e300;
  for (const ScalingPoint& p : points) {
    const double ns = ns_per_body(row_of(p, HarpoonMode::detect).ms.median, p);
    most_bodies = std::max(most_bodies, static_cast<double>(p.plan.bodies));
    most_ns = std::max(most_ns, ns);
    least_ns = std::min(least_ns, ns);
  }
  const double y_low = std::pow(10.0, std::floor(std::log10(least_ns)));
  const double y_high = std::pow(10.0, std::ceil(std::log10(most_ns * 1.01)));
  const Axes axes(1000, std::max(most_bodies, 2000.0), y_low, y_high);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" "
      "height=\"100%\" fill=\"#fff\"/>\n",
      Axes::kWidth, Axes::kHeight);
  for (double n = 1000; n <= most_bodies; n *= 10) {
    svg += grid_line(axes.x(n), axes.y(y_low), axes.x(n), axes.y(y_high));
    svg += label(axes.x(n), Axes::kHeight - 22, "middle", fmt::format("10^{:.0f}", std::log10(n)));
  }
  for (double decade = y_low; decade <= y_high * 1.01; decade *= 10) {
    for (const double step : {1.0, 2.0, 5.0}) {
      const double ns = decade * step;
      if (ns > y_high * 1.01) break;
      svg += grid_line(axes.x(1000), axes.y(ns), Axes::kWidth - Axes::kRight, axes.y(ns));
      svg += label(Axes::kLeft - 6, axes.y(ns) + 4, "end", fmt::format("{:g}", ns));
    }
  }
  svg += label(Axes::kLeft, Axes::kHeight - 6, "start", "bodies; ns a body, detect");
  constexpr std::array kColours = {"#1b6ca8", "#c8553d", "#588157", "#8e5aa8", "#b08900", "#444"};
  std::size_t colour = 0;
  for (const WorldKind kind : kinds_of(points)) {
    const char* const stroke = kColours[colour++ % kColours.size()];
    std::string places;
    double end_y = 0;
    for (const ScalingPoint& p : points) {
      if (p.plan.kind != kind) continue;
      end_y = axes.y(ns_per_body(row_of(p, HarpoonMode::detect).ms.median, p));
      places += fmt::format("{:.1f},{:.1f} ", axes.x(static_cast<double>(p.plan.bodies)), end_y);
    }
    svg += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n",
                       places, stroke);
    svg += label(Axes::kWidth - Axes::kRight + 6, end_y + 4, "start",
                 fmt::format("<tspan fill=\"{}\">{}</tspan>", stroke, to_string(kind)));
  }
  return svg + "</svg>\n";
}

}  // namespace harpoon::bench
