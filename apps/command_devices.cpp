// `harpoon devices`: what can compute on this machine, and how to get what is missing.

#include <CLI/CLI.hpp>

#include "apps/command.hpp"
#include "apps/device_catalog.hpp"
#include "apps/output.hpp"
#include "apps/table.hpp"

namespace harpoon::app {
namespace {

void list(const Terminal& terminal) {
  std::vector<std::vector<Cell>> rows;
  for (const CatalogEntry& entry : device_catalog()) {
    const DeviceInfo info = entry.look();
    rows.push_back({info.name,
                    info.available ? Cell("yes", Colour::green) : Cell("no", Colour::red),
                    info.modelled ? "modelled" : "measured", info.description});
  }
  print("{}",
        format_table(terminal, {{"device"}, {"available"}, {"times are"}, {"description"}}, rows));
  std::string sets;
  for (const std::string& set : cpu_instruction_sets()) {
    sets += (sets.empty() ? "" : ", ") + set;
  }
  print("\nInstruction sets of cpu here: {}\n", sets);
}

}  // namespace

void add_devices(CLI::App& root, Context& context) {
  CLI::App* devices = root.add_subcommand(
      "devices", "List devices: what is there, what is missing and how to get it");
  devices->footer("Example:\n  harpoon devices");
  devices->callback([&context] { context.run = [&context] { list(context.terminal); }; });
}

}  // namespace harpoon::app
