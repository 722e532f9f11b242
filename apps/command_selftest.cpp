// `harpoon selftest`: is every device, and every instruction set, right on this machine?

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>

#include "apps/command.hpp"
#include "apps/device_catalog.hpp"
#include "apps/exit_code.hpp"
#include "apps/options.hpp"
#include "apps/output.hpp"
#include "apps/progress.hpp"
#include "apps/table.hpp"
#include "bench/selftest.hpp"

#if HARPOON_WITH_ODE
#include "bench/ode/oracle.hpp"
#endif

namespace harpoon::app {
namespace {

struct SelftestOptions {
  std::size_t pairs = 1000000;
  std::uint64_t seed = 1;
  std::string device = "all";
};

// The cpu device once per instruction set, and then every device as it is normally opened.
std::vector<bench::NamedDevice> devices_to_test(const std::string& selection) {
  std::vector<bench::NamedDevice> devices;
  if (selection == "all" || selection == "cpu") {
    for (const std::string& set : cpu_instruction_sets()) {
      CpuOptions options;
      options.threads = 1;
      options.instruction_set = set;
      devices.push_back({"cpu " + set, 1, value_or_throw(make_cpu_device(options))});
    }
  }
  for (bench::NamedDevice& device : open_devices(selection, {0})) {
    devices.push_back(std::move(device));
  }
  return devices;
}

std::vector<bench::Oracle> oracles() {
#if HARPOON_WITH_ODE
  return {bench::make_ode_oracle()};
#else
  print("Without ODE in this build, dCollide is not compared (install libode-dev, rebuild).\n");
  return {};
#endif
}

// One row per device, one column per comparison; a cell is about all forms of a batch.
std::string matrix_of(const Terminal& terminal, const std::vector<bench::SelftestCheck>& checks) {
  std::vector<std::string> devices;
  std::vector<std::string> comparisons;
  std::map<std::pair<std::string, std::string>, bool> passed;
  const auto add_once = [](std::vector<std::string>& names, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      names.push_back(name);
    }
  };
  for (const bench::SelftestCheck& check : checks) {
    add_once(devices, check.device);
    add_once(comparisons, check.against);
    bool& cell = passed.try_emplace({check.device, check.against}, true).first->second;
    cell = cell && check.passed();
  }
  std::vector<Column> columns = {{"device"}};
  for (const std::string& comparison : comparisons) {
    columns.push_back({comparison});
  }
  std::vector<std::vector<Cell>> rows;
  for (const std::string& device : devices) {
    std::vector<Cell> row = {device};
    for (const std::string& comparison : comparisons) {
      const auto cell = passed.find({device, comparison});
      row.push_back(cell == passed.end() ? Cell("-")
                    : cell->second       ? Cell("ok", Colour::green)
                                         : Cell("FAILED", Colour::red));
    }
    rows.push_back(row);
  }
  return format_table(terminal, columns, rows);
}

std::vector<bench::SelftestCheck> run_shown(const Context& context,
                                            const bench::SelftestPlan& plan) {
  Progress progress(context.terminal);
  const double checks_per_device = 6 + 3 * static_cast<double>(plan.oracles.size());
  const double all = checks_per_device * static_cast<double>(plan.devices.size());
  double done = 0;
  progress.show(0, "making pairs");
  const auto on_check = [&](const bench::SelftestCheck& check) {
    progress.show(++done / all, fmt::format("{}: {} {}", check.device, check.form, check.against));
  };
  return bench::run_selftest(plan, on_check);
}

void run(const Context& context, const SelftestOptions& options) {
  bench::SelftestPlan plan;
  plan.devices = devices_to_test(options.device);
  plan.oracles = oracles();
  plan.pairs = options.pairs;
  plan.seed = options.seed;
  const std::vector<bench::SelftestCheck> checks = run_shown(context, plan);
  print("{}\n", matrix_of(context.terminal, checks));
  std::size_t failed = 0;
  std::uint64_t pairs = 0;
  for (const bench::SelftestCheck& check : checks) {
    pairs += check.pairs;
    if (!check.passed()) {
      ++failed;
      print("{}, {}, {}: {} mismatches. {}\n", check.device, check.form, check.against,
            check.mismatches, check.first_mismatch);
    }
  }
  if (failed > 0) {
    throw CommandError(
        ExitCode::failure,
        fmt::format("{} of {} checks failed (seed {}). Do not use these devices here; "
                    "report the lines above.",
                    failed, checks.size(), options.seed));
  }
  print("All {} checks passed: records, arrays and indexed, {} contacts (seed {}).\n",
        checks.size(), pairs, options.seed);
}

}  // namespace

void add_selftest(CLI::App& root, Context& context) {
  CLI::App* selftest = root.add_subcommand(
      "selftest", "Compare every device and instruction set with plain Algorithm 1 and dCollide");
  auto options = std::make_shared<SelftestOptions>();
  add_whole(*selftest, "--pairs", options->pairs, 8, 50000000, "N", "Pairs in each check");
  add_seed(*selftest, options->seed, "Seed of the random pairs");
  add_name(*selftest, "--device", options->device, device_choices(), "Device to test");
  selftest->footer(
      "Contacts are compared bit by bit (any NaN equals any NaN). Exit code 1 when one differs.\n\n"
      "Examples:\n  harpoon selftest\n  harpoon selftest --device cpu --pairs 10000000 --seed 7");
  selftest->callback([&context, options] {
    context.memory_remedy = "Use fewer --pairs.";
    context.run = [&context, options] { run(context, *options); };
  });
}

}  // namespace harpoon::app
