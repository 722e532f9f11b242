// The commands that need ODE, in a build without it: they say what is missing and how to get it.

#include <CLI/CLI.hpp>

#include "apps/command.hpp"
#include "apps/exit_code.hpp"

namespace harpoon::app {
namespace {

void add_refusal(CLI::App& parent, Context& context, const char* name) {
  CLI::App* command = parent.add_subcommand(name, "Not in this build: it needs ODE (libode-dev)");
  command->allow_extras();
  command->callback([&context] {
    context.run = [] {
      throw CommandError(
          ExitCode::environment,
          "This build has no ODE. Install libode-dev (apt-get install libode-dev) and "
          "build again.");
    };
  });
}

}  // namespace

void add_demo(CLI::App& root, Context& context) {
  add_refusal(root, context, "demo");
}
void add_bench_pairs(CLI::App& bench, Context& context) {
  add_refusal(bench, context, "pairs");
}
void add_bench_ode(CLI::App& bench, Context& context) {
  add_refusal(bench, context, "ode");
}
void add_replay(CLI::App& root, Context& context) {
  add_refusal(root, context, "replay");
}
void add_diamond(CLI::App& root, Context& context) {
  add_refusal(root, context, "diamond");
}

}  // namespace harpoon::app
