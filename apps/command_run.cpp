// `harpoon run -- COMMAND`: an ODE program with Harpoon's collision detection.

#include <CLI/CLI.hpp>
#include <memory>

#include "apps/command.hpp"
#include "apps/drop_in.hpp"
#include "apps/exit_code.hpp"
#include "apps/options.hpp"

namespace harpoon::app {
namespace {

struct RunOptions {
  std::string policy = "compat";
  std::string precision = "exact";
  std::string device = "cpu";
  bool verify = false;
  bool statistics = false;
  bool require = false;
  std::vector<std::string> command;
};

void run(const RunOptions& options) {
  if (options.command.empty()) {
    throw CommandError(ExitCode::usage, "No command to run. Give one after --.");
  }
  const std::vector<Variable> variables = {{"HARPOON_ODE", options.policy},
                                           {"HARPOON_PRECISION", options.precision},
                                           {"HARPOON_DEVICE", options.device},
                                           {"HARPOON_VERIFY", options.verify ? "1" : "0"},
                                           {"HARPOON_STATS", options.statistics ? "1" : "0"}};
  if (options.verify || options.statistics || options.require) {
    run_and_watch(options.command, variables, {.require = options.require});
  }
  run_with_drop_in(options.command, variables);
}

}  // namespace

void add_run(CLI::App& root, Context& context) {
  CLI::App* command =
      root.add_subcommand("run", "Run an ODE program with Harpoon's collision detection");
  auto options = std::make_shared<RunOptions>();
  add_choice(*command, "--policy", options->policy, {"compat", "fixed", "strict"},
             "Where stock ODE fails")
      ->capture_default_str();
  add_choice(*command, "--precision", options->precision, {"exact", "f32"},
             "Contacts of spheres with stock's bits, or in binary32")
      ->capture_default_str();
  add_name(*command, "--device", options->device, "NAME", "Device for contacts of spheres");
  command->add_flag("--verify", options->verify, "Compare every pair and contact with stock ODE");
  command->add_flag("--stats", options->statistics, "Print one line of statistics at the end");
  command->add_flag("--require", options->require,
                    "Exit code 5 when no call of ODE was served, whatever the program's is");
  command->add_option("command", options->command, "The program and its arguments, after --")
      ->type_name("COMMAND");
  command->footer(
      "The same as LD_PRELOAD=libharpoon_ode.so and variables HARPOON_...; see docs/ode.md. With\n"
      "--stats, --verify or --require it waits for the program and says so when no call of ODE\n"
      "arrived.\n\n"
      "Examples:\n"
      "  harpoon run --stats -- ./my_simulation\n"
      "  harpoon run --verify -- python3 pile.py");
  command->callback([&context, options] { context.run = [options] { run(*options); }; });
}

}  // namespace harpoon::app
