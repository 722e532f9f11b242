#pragma once

// The options of all commands, by kind: each has a range or a list, and says it in its help and
// when it refuses a value. Their type names ("a|b|c", "FILE", "DIR", "N") are also what shell
// completion and the manual are made from.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <concepts>
#include <limits>
#include <string>
#include <vector>

namespace harpoon::app {

/// An option whose value is one of `choices`.
CLI::Option* add_choice(CLI::App& app, const std::string& flag, std::string& value,
                        const std::vector<std::string>& choices, const std::string& help);

/// Accepts whole numbers from `low` to `high`, in decimal digits.
CLI::Validator whole_number(std::uint64_t low, std::uint64_t high);
/// Accepts finite numbers from `low` to `high`.
CLI::Validator real_number(double low, double high);

/// A whole number from `low` to `high`; `value` may be a vector of them.
template <class Value>
CLI::Option* add_whole(CLI::App& app, const std::string& flag, Value& value, std::uint64_t low,
                       std::uint64_t high, const char* type, const std::string& help) {
  return app.add_option(flag, value, fmt::format("{} ({} to {})", help, low, high))
      ->transform(whole_number(low, high))
      ->type_name(type)
      ->capture_default_str();
}

CLI::Option* add_real(CLI::App& app, const std::string& flag, double& value, double low,
                      double high, const char* type, const std::string& help);

/// Any whole number of 64 bits.
CLI::Option* add_seed(CLI::App& app, std::uint64_t& value, const std::string& help);

/// A name of a file ("FILE"), folder ("DIR"), device or program; not empty.
CLI::Option* add_name(CLI::App& app, const std::string& flag, std::string& value,
                      const std::string& type, const std::string& help);

}  // namespace harpoon::app
