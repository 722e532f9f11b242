// `harpoon bench`: the parent of the measurements. A new one is one file and one line here.

#include <CLI/CLI.hpp>

#include "apps/command.hpp"

namespace harpoon::app {

void add_bench(CLI::App& root, Context& context) {
  CLI::App* bench = root.add_subcommand("bench", "Measure: ODE and every device side by side");
  bench->require_subcommand(1);
  bench->footer("Example:\n  harpoon bench pairs --help");
  add_bench_pairs(*bench, context);
  add_bench_scene(*bench, context);
  add_bench_ode(*bench, context);
}

}  // namespace harpoon::app
