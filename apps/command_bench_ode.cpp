// `harpoon bench ode`: stock ODE and the drop-in on the same worlds.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "apps/command.hpp"
#include "apps/drop_in.hpp"
#include "apps/exit_code.hpp"
#include "apps/files.hpp"
#include "apps/interrupt.hpp"
#include "apps/options.hpp"
#include "apps/progress.hpp"
#include "apps/table.hpp"
#include "bench/ode/drop_in_bench.hpp"

namespace harpoon::app {
namespace {

struct OdeOptions {
  std::string kind = "packed";
  std::size_t geoms = 10000;
  std::string space = "all";
  double seconds = 2;
  std::uint64_t seed = 1;
  std::string json;
};

/// The words of this process' command line.
std::vector<std::string> own_words() {
  const std::string joined = read_file("/proc/self/cmdline");
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin < joined.size();) {
    const std::size_t end = std::min(joined.find('\0', begin), joined.size());
    words.push_back(joined.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

std::string describe(const Terminal& terminal, const bench::DropInOutcome& outcome) {
  std::vector<std::vector<Cell>> rows;
  for (const bench::DropInRow& row : outcome.rows) {
    rows.push_back({row.space, fmt::format("{:.4f}", row.stock_ms.median),
                    fmt::format("{:.4f}", row.harpoon_ms.median),
                    fmt::format("{:.2f}", row.speedup), fmt::format("{}", row.pairs),
                    fmt::format("{}", row.contacts), row.identical ? "yes" : "NO"});
  }
  std::string text = format_table(terminal,
                                  {{"space"},
                                   {"stock ms", true},
                                   {"harpoon ms", true},
                                   {"speed-up", true},
                                   {"pairs", true},
                                   {"contacts", true},
                                   {"identical"}},
                                  rows);
  for (const std::string& note : outcome.notes) text += note + "\n";
  return text;
}

void measure(const Context& context, const OdeOptions& options) {
  if (!bench::drop_in_is_interposed()) {
    // Measured as it is used: once more, with the library in front of libode.
    std::vector<std::string> words = own_words();
    words[0] = "/proc/self/exe";
    run_with_drop_in(words, {});
  }
  bench::DropInPlan plan;
  plan.kind = *bench::parse_drop_in_kind(options.kind);
  plan.geoms = options.geoms;
  plan.seconds = options.seconds;
  plan.seed = options.seed;
  plan.spaces = options.space == "all"
                    ? std::vector<std::string>{"simple", "hash", "sap", "quadtree"}
                    : std::vector<std::string>{options.space};
  const bool json_on_stdout = options.json == "-";
  if (!options.json.empty() && !json_on_stdout) require_writable_file(options.json, "--json");
  const auto outcome = [&] {
    Progress progress(context.terminal);
    const auto share = [&](double done) { progress.show(done, "measuring"); };
    return value_or_throw(bench::run_drop_in(plan, share, is_interrupted));
  }();
  throw_if_interrupted();
  fmt::print(json_on_stdout ? stderr : stdout, "{}", describe(context.terminal, outcome));
  if (!options.json.empty()) {
    const std::string json =
        bench::drop_in_json(plan, outcome, bench::describe_machine(), context.command_line);
    if (json_on_stdout) {
      fmt::print("{}", json);
    } else {
      write_file(options.json, json);
      fmt::print("{}\n", options.json);
    }
  }
  for (const bench::DropInRow& row : outcome.rows) {
    if (!row.identical) {
      throw CommandError(ExitCode::failure,
                         fmt::format("the drop-in differs from stock in the {} space", row.space));
    }
  }
}

}  // namespace

void add_bench_ode(CLI::App& bench, Context& context) {
  CLI::App* ode = bench.add_subcommand("ode", "Stock ODE and the drop-in on the same worlds");
  auto options = std::make_shared<OdeOptions>();
  add_choice(*ode, "--kind", options->kind, {"packed", "gas", "mixed", "asleep"}, "World")
      ->capture_default_str();
  ode->add_option("--geoms", options->geoms, "Geoms")
      ->check(whole_number(2, 10000000))
      ->type_name("N")
      ->capture_default_str();
  add_choice(*ode, "--space", options->space, {"simple", "hash", "sap", "quadtree", "all"},
             "Kind of space")
      ->capture_default_str();
  ode->add_option("--seconds", options->seconds, "Time to measure each space, at least five steps")
      ->check(CLI::Range(0.0, 3600.0))
      ->type_name("S")
      ->capture_default_str();
  ode->add_option("--seed", options->seed, "Seed of the world")
      ->type_name("N")
      ->capture_default_str();
  ode->add_option("--json", options->json, "Write the results as JSON; - for standard output")
      ->type_name("FILE");
  ode->footer(
      "Times are medians of dSpaceCollide with dCollide in the callback, stock and drop-in step\n"
      "by step in turn on twin worlds, in one process with the library preloaded.\n\n"
      "Examples:\n"
      "  harpoon bench ode --geoms 1000\n"
      "  harpoon bench ode --kind gas --geoms 100000 --space hash --json ode.json");
  ode->callback(
      [&context, options] { context.run = [&context, options] { measure(context, *options); }; });
}

}  // namespace harpoon::app
