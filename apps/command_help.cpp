// `harpoon help [COMMAND]`: the same as `harpoon COMMAND --help`.

#include <CLI/CLI.hpp>

#include "apps/command.hpp"
#include "apps/output.hpp"
#include "apps/parse_error.hpp"

namespace harpoon::app {
namespace {

/// For completion: the commands that stand directly below `root`.
std::string names_below(const CLI::App& root) {
  std::string names;
  for (const CLI::App* sub : root.get_subcommands([](const CLI::App*) { return true; })) {
    names += (names.empty() ? "" : "|") + sub->get_name();
  }
  return names;
}

}  // namespace

void add_help(CLI::App& root, Context& context) {
  const std::string names = names_below(root);
  CLI::App* command = root.add_subcommand("help", "Print the help of a command");
  auto path = std::make_shared<std::vector<std::string>>();
  command->add_option("command", *path, "The command, a word or two")->type_name(names);
  command->footer("Examples:\n  harpoon help\n  harpoon help bench pairs");
  command->callback([&root, &context, path] {
    context.run = [&root, path] { standard_output().write(help_of(root, *path)); };
  });
}

}  // namespace harpoon::app
