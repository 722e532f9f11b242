#pragma once

// Checks of option values that several commands share. Their type names ("a|b|c", "FILE", "DIR",
// "N") are also what shell completion and the manual are made from.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace harpoon::app {

/// An option whose value is one of `choices`.
CLI::Option* add_choice(CLI::App& app, const std::string& flag, std::string& value,
                        const std::vector<std::string>& choices, const std::string& help);

/// Accepts whole numbers from `low` to `high`.
CLI::Validator whole_number(std::uint64_t low, std::uint64_t high);

}  // namespace harpoon::app
