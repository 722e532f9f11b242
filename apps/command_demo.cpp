// `harpoon demo`: the paper's experiment end to end, with a table, a report and the data.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "apps/claims.hpp"
#include "apps/command.hpp"
#include "apps/device_catalog.hpp"
#include "apps/exit_code.hpp"
#include "apps/experiment.hpp"
#include "apps/figures.hpp"
#include "apps/files.hpp"
#include "apps/options.hpp"
#include "apps/output.hpp"
#include "apps/progress.hpp"
#include "apps/report.hpp"
#include "apps/result_table.hpp"

namespace harpoon::app {
namespace {

struct DemoOptions {
  std::string out = "harpoon-out";
  bool quick = false;
};

std::string title_at(double share) {
  return share < 0.2 ? "Figure 6" : share < 0.7 ? "Figure 7" : "table";
}

Experiment run_shown(const Context& context, const ExperimentPlan& plan) {
  Progress progress(context.terminal);
  progress.show(0, "recording the diamond");
  const auto share = [&](double done) { progress.show(done, title_at(done)); };
  return run_experiment(plan, share);
}

bench::ResultSet to_results(const Context& context, const Experiment& experiment) {
  const auto rows = bench::to_rows(experiment.table.series, bench::PairType::real);
  return {bench::describe_machine(),
          bench::build_commit(),
          bench::timestamp(),
          context.command_line,
          experiment.table.timer_overhead_ns,
          rows,
          {},
          report_notes(experiment),
          experiment.load};
}

constexpr const char* kReport = "report.html";
constexpr const char* kJson = "results.json";
constexpr const char* kCsv = "results.csv";
constexpr const char* kFigure6 = "figure6.csv";
constexpr const char* kFigure7 = "figure7.csv";

// The paths of what was written, the report first.
std::vector<std::filesystem::path> write_all(const std::filesystem::path& out,
                                             const Experiment& experiment,
                                             const bench::ResultSet& results) {
  const std::filesystem::path report = out / kReport;
  const std::filesystem::path json = out / kJson;
  const std::filesystem::path csv = out / kCsv;
  const std::filesystem::path figure6 = out / kFigure6;
  const std::filesystem::path figure7 = out / kFigure7;
  write_file(report, fill_template(report_template(), report_data(experiment, results)));
  write_file(json, bench::to_json(results));
  write_file(csv, bench::csv_header() + "\n" + bench::to_csv(results));
  write_file(figure6, figure_csv(experiment.figure6.series));
  write_file(figure7, figure_csv(experiment.figure7.series));
  return {report, json, csv, figure6, figure7};
}

void print_claims(const Context& context, const Experiment& experiment) {
  const auto print_lines = [](const std::string& text, const char* indent) {
    for (const std::string& line : broken_into_lines(text, kLineWidth - 2)) {
      print("{}{}\n", indent, line);
    }
  };
  for (const Claim& claim : judge_claims(experiment)) {
    print_lines("Paper: " + claim.paper, "");
    print_lines("here: " + claim.ours, "  ");
    print("  {}\n", coloured(context.terminal, Colour::bold, "[" + claim.verdict + "]"));
  }
}

void run(const Context& context, const DemoOptions& options) {
  require_writable_folder(options.out, "--out", {kReport, kJson, kCsv, kFigure6, kFigure7});
  const ExperimentPlan plan{open_devices("all", {1}), open_devices("all", {1, 0}), options.quick};
  const Experiment experiment = run_shown(context, plan);
  const bench::ResultSet results = to_results(context, experiment);
  print("{}\n", describe_results(context.terminal, results));
  print_claims(context, experiment);
  print("\nWritten:\n");
  for (const std::filesystem::path& path : write_all(options.out, experiment, results)) {
    print("  {}\n", shown(path));
  }
  if (!experiment.contacts_are_right()) {
    throw CommandError(ExitCode::failure,
                       "Some contacts differ from Algorithm 1. Run `harpoon selftest`.");
  }
}

}  // namespace

void add_demo(CLI::App& root, Context& context) {
  CLI::App* demo = root.add_subcommand(
      "demo", "The paper's experiment end to end: table, Figures 6 and 7, report");
  auto options = std::make_shared<DemoOptions>();
  add_name(*demo, "--out", options->out, "DIR", "Folder to write the report and the data into");
  demo->add_flag("--quick", options->quick,
                 "Few points and few rounds: to see that it works, not to measure");
  demo->footer(
      "Takes about a minute. Writes report.html (one offline file), results.json, results.csv,\n"
      "figure6.csv and figure7.csv.\n\nExamples:\n  harpoon demo\n  harpoon demo --out today");
  demo->callback(
      [&context, options] { context.run = [&context, options] { run(context, *options); }; });
}

}  // namespace harpoon::app
