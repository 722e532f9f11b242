#pragma once

// The declared command as plain data, from which the manual page and the shell completions are
// written: what they say is what the parser accepts.

#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): it is the name CLI11 chose
class App;
}

namespace harpoon::app {

struct OptionInfo {
  std::vector<std::string> names;  ///< with dashes, long ones last: "-h", "--help"; or "shell"
  bool is_positional = false;      ///< given by its place, not by its name
  std::string help;
  std::string type;                  ///< "" for a flag; else "N", "FILE", "DIR", "a|b|c"
  std::string default_value;         ///< "" when there is none
  std::vector<std::string> choices;  ///< the type's, when it is a list
};

/// A command, then its subcommands, depth first.
struct CommandInfo {
  std::string path;  ///< "harpoon bench pairs"
  std::string name;  ///< "pairs"
  std::string help;
  std::string footer;
  std::vector<OptionInfo> options;
  std::vector<CommandInfo> subcommands;
};

CommandInfo describe_command(const CLI::App& root);

/// All commands of the tree in one list, `root` first. The pointers are into `root`.
std::vector<const CommandInfo*> flattened(const CommandInfo& root);

}  // namespace harpoon::app
