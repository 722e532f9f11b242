// `harpoon bench scene`: all contacts of a moving world, Harpoon and other engines side by side.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "apps/command.hpp"
#include "apps/exit_code.hpp"
#include "apps/files.hpp"
#include "apps/options.hpp"
#include "apps/output.hpp"
#include "apps/printable.hpp"
#include "apps/progress.hpp"
#include "apps/table.hpp"
#include "bench/scene/figures.hpp"
#include "bench/scene/scaling.hpp"
#include "bench/scene/scene_bench.hpp"

namespace harpoon::app {
namespace {

struct SceneOptions {
  std::string kind = "gas";
  std::size_t bodies = 100000;
  unsigned frames = 12;
  unsigned threads = 1;
  std::string precision = "f32";
  std::vector<std::string> against = {"none"};
  std::uint64_t seed = 1;
  std::string json;
  bool scaling = false;
  std::string write_docs;
};

/// Names of the files that --write-docs makes.
constexpr const char* kFiguresFile = "scene-figures.md";
constexpr const char* kPlotFile = "scene-scaling.svg";

std::vector<std::string> peers_of(const std::vector<std::string>& names) {
  std::vector<std::string> known = bench::scene_peers();
  std::vector<std::string> peers;
  for (const std::string& name : names) {
    if (name == "none") continue;
    if (name == "all") return known;
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw CommandError(ExitCode::usage,
                         fmt::format("--against: no {} in this build; there are {}, all, none",
                                     in_quotes(name), fmt::join(known, ", ")));
    }
    peers.push_back(name);
  }
  return peers;
}

/// A still scene's frame takes nanoseconds.
std::string milliseconds(double ms) {
  return fmt::format("{:.{}f}", ms, ms < 0.01 ? 6 : 3);
}

// Two tables, for one would be wider than a terminal: what a frame takes, and what it consists of.
std::string describe(const Terminal& terminal, const bench::SceneOutcome& outcome) {
  std::vector<std::vector<Cell>> frames;
  std::vector<std::vector<Cell>> parts;
  for (const bench::SceneRow& row : outcome.rows) {
    frames.push_back({row.engine, row.precision, fmt::format("{}", row.threads),
                      milliseconds(row.ms.median), milliseconds(row.ms.min),
                      milliseconds(row.ms.high),
                      fmt::format("{:.{}f}", row.speedup, row.speedup < 0.01 ? 6 : 2)});
    parts.push_back({row.engine, fmt::format("{:.3f}", row.update_ms),
                     fmt::format("{:.3f}", row.broad_ms), fmt::format("{:.3f}", row.narrow_ms),
                     fmt::format("{}", row.pairs), fmt::format("{}", row.contacts),
                     fmt::format("{:.2f}", static_cast<double>(row.bytes_floor) * 1e-6)});
  }
  std::string text = format_table(terminal,
                                  {{"engine"},
                                   {"precision"},
                                   {"threads", true},
                                   {"ms/frame", true},
                                   {"min", true},
                                   {"p90", true},
                                   {"x harpoon", true}},
                                  frames);
  text += "\n";
  text += format_table(terminal,
                       {{"engine"},
                        {"update", true},
                        {"broad", true},
                        {"narrow", true},
                        {"pairs", true},
                        {"contacts", true},
                        {"floor MB", true}},
                       parts);
  for (const std::string& note : outcome.notes) text += paragraph(note);
  return text;
}

/// The table goes to standard output unless the JSON does.
void show(const SceneOptions& options, const std::string& table) {
  options.json == "-" ? remark(table) : print("{}", table);
}

/// Writes to the file, or to standard output.
void deliver_json(const std::string& file, const std::string& json) {
  if (file == "-") {
    print("{}", json);
  } else if (!file.empty()) {
    write_file(file, json);
    print("{}\n", shown(file));
  }
}

void require_outputs(const SceneOptions& options) {
  if (!options.json.empty() && options.json != "-") require_writable_file(options.json, "--json");
  if (!options.write_docs.empty()) {
    require_writable_folder(options.write_docs, "--write-docs", {kFiguresFile, kPlotFile});
  }
}

[[noreturn]] void disagree() {
  throw CommandError(ExitCode::failure, "the engines do not agree on the number of contacts");
}

void measure(const Context& context, const SceneOptions& options) {
  bench::ScenePlan plan;
  plan.kind = *bench::parse_world_kind(options.kind);
  plan.bodies = options.bodies;
  plan.frames = options.frames;
  plan.threads = options.threads;
  plan.f64 = options.precision == "f64";
  plan.seed = options.seed;
  plan.against = peers_of(options.against);
  require_outputs(options);
  const auto outcome = [&] {
    Progress progress(context.terminal);
    const auto share = [&](double done) { progress.show(done, "measuring"); };
    return value_or_throw(bench::run_scene(plan, share, {}));
  }();
  show(options, describe(context.terminal, outcome));
  deliver_json(options.json,
               bench::scene_json(plan, outcome, bench::describe_machine(), context.command_line));
  if (!outcome.counts_agree) disagree();
}

void measure_scaling(const Context& context, const SceneOptions& options, bool three_kinds) {
  bench::ScalingPlan plan;
  plan.kinds = {bench::WorldKind::gas, bench::WorldKind::packed, bench::WorldKind::polydisperse};
  if (!three_kinds) plan.kinds = {*bench::parse_world_kind(options.kind)};
  plan.most_bodies = options.bodies;
  plan.frames = options.frames;
  plan.threads = options.threads;
  plan.f64 = options.precision == "f64";
  plan.seed = options.seed;
  require_outputs(options);
  const auto points = [&] {
    Progress progress(context.terminal);
    const auto share = [&](double done) { progress.show(done, "measuring"); };
    return value_or_throw(bench::run_scaling(plan, share, {}));
  }();
  const bench::Machine machine = bench::describe_machine();
  const std::string text =
      bench::scaling_markdown(points, machine, context.command_line, kPlotFile);
  show(options, text);
  deliver_json(options.json, bench::scaling_json(plan, points, machine, context.command_line));
  if (!options.write_docs.empty()) {
    const std::filesystem::path folder = options.write_docs;
    write_file(folder / kFiguresFile, text);
    write_file(folder / kPlotFile, bench::scaling_svg(points));
  }
  for (const bench::ScalingPoint& point : points) {
    if (!point.outcome.counts_agree) disagree();
  }
}

}  // namespace

void add_bench_scene(CLI::App& bench, Context& context) {
  CLI::App* scene =
      bench.add_subcommand("scene", "All contacts of a moving world, against other engines");
  auto options = std::make_shared<SceneOptions>();
  add_choice(*scene, "--kind", options->kind,
             {"gas", "packed", "polydisperse", "bed", "diamond", "clusters"}, "World")
      ->capture_default_str();
  add_whole(*scene, "--bodies", options->bodies, 1, 100000000, "N", "Bodies");
  add_whole(*scene, "--frames", options->frames, 1, 100000, "N",
            "Measured frames, after three to warm up");
  add_whole(*scene, "--threads", options->threads, 1, 1024, "T",
            "Threads of Harpoon; the others have one");
  add_choice(*scene, "--precision", options->precision, {"f32", "f64"}, "Precision of Harpoon")
      ->capture_default_str();
  scene
      ->add_option("--against", options->against,
                   "Engines to compare with, separated by commas: ode, bullet, fcl, embree, all")
      ->delimiter(',')
      ->type_name("ENGINES")
      ->default_str("none");
  add_seed(*scene, options->seed, "Seed of the world");
  add_name(*scene, "--json", options->json, "FILE",
           "Write the results as JSON; - for standard output");
  auto* const scaling =
      scene->add_flag("--scaling", options->scaling,
                      "Sizes from 1,000 to --bodies, three kinds or the one named, without peers");
  add_name(*scene, "--write-docs", options->write_docs, "DIR",
           "With --scaling: write the tables and the plot of docs/ to this folder")
      ->needs(scaling);
  scene->footer(
      "Every body moves by 2 % of its radius per frame. Figures are medians over frames in\n"
      "milliseconds; the floor is what must be read and written at least.\n\n"
      "  harpoon                   detect, without history\n"
      "  harpoon scene             a Scene, all bodies set in every frame\n"
      "  harpoon scene, still      a Scene in which nothing moves: detect alone\n"
      "  harpoon scene, set again  a Scene whose bodies are all set where they are: compared\n"
      "  harpoon bounds            overlap_pairs on the bodies' bounds\n\n"
      "Examples:\n"
      "  harpoon bench scene --kind packed --against bullet,embree\n"
      "  harpoon bench scene --bodies 1000000 --threads 2 --json scene.json\n"
      "  harpoon bench scene --scaling --bodies 4000000 --write-docs docs");
  scene->callback([&context, options, scene] {
    context.memory_remedy = "Use fewer --bodies.";
    const bool three_kinds = scene->count("--kind") == 0;
    context.run = [&context, options, three_kinds] {
      options->scaling ? measure_scaling(context, *options, three_kinds)
                       : measure(context, *options);
    };
  });
}

}  // namespace harpoon::app
