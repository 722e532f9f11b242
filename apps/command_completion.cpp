// `harpoon completion` and `harpoon manual`: what is installed for shells and for man, printed by
// the command itself so that it can never disagree with it.

#include <CLI/CLI.hpp>

#include "apps/command.hpp"
#include "apps/completion.hpp"
#include "apps/manual.hpp"
#include "apps/options.hpp"
#include "apps/output.hpp"
#include "harpoon/version.hpp"

namespace harpoon::app {

void add_completion(CLI::App& root, Context& context) {
  CLI::App* completion =
      root.add_subcommand("completion", "Print the completion script of a shell");
  auto shell = std::make_shared<std::string>();
  add_choice(*completion, "shell", *shell, {"bash", "zsh", "fish"}, "The shell")->required();
  completion->footer("Example:\n  source <(harpoon completion bash)");
  completion->callback([&root, &context, shell] {
    context.run = [&root, shell] {
      const CommandInfo info = describe_command(root);
      print("{}", *shell == "bash"  ? bash_completion(info)
                  : *shell == "zsh" ? zsh_completion(info)
                                    : fish_completion(info));
    };
  });
}

void add_manual(CLI::App& root, Context& context) {
  CLI::App* manual = root.add_subcommand("manual", "Print the manual page in roff");
  manual->footer("Example:\n  harpoon manual | man -l -");
  manual->callback([&root, &context] {
    context.run = [&root] {
      print("{}", manual_page(describe_command(root), std::string(version())));
    };
  });
}

}  // namespace harpoon::app
