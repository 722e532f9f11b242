#pragma once

// Shell completion scripts: commands, options, choices, and files where a file is wanted.

#include <string>

#include "apps/command_tree.hpp"

namespace harpoon::app {

std::string bash_completion(const CommandInfo& root);
std::string zsh_completion(const CommandInfo& root);
std::string fish_completion(const CommandInfo& root);

}  // namespace harpoon::app
