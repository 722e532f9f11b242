#pragma once

// A subcommand of `harpoon` is one file command_NAME.cpp that defines one of these functions: it
// declares its options, and on parsing leaves what is to be run in the context. main runs it.

#include <functional>
#include <string>

#include "apps/terminal.hpp"

namespace CLI {  // NOLINT(readability-identifier-naming): it is the name CLI11 chose
class App;
}

namespace harpoon::app {

struct Context {
  Terminal terminal;
  std::string command_line;   ///< as typed, for the results
  std::function<void()> run;  ///< set by the subcommand that was given; throws CommandError
  /// What helps when there is too little memory; set by subcommands that know better.
  std::string memory_remedy = "End other programs, or use a larger machine.";
};

void add_demo(CLI::App& root, Context& context);
void add_bench(CLI::App& root, Context& context);
void add_bench_pairs(CLI::App& bench, Context& context);
void add_bench_scene(CLI::App& bench, Context& context);
void add_bench_ode(CLI::App& bench, Context& context);
void add_diamond(CLI::App& root, Context& context);
void add_detect(CLI::App& root, Context& context);
void add_afu(CLI::App& root, Context& context);
void add_run(CLI::App& root, Context& context);
void add_replay(CLI::App& root, Context& context);
void add_devices(CLI::App& root, Context& context);
void add_selftest(CLI::App& root, Context& context);
void add_completion(CLI::App& root, Context& context);
void add_manual(CLI::App& root, Context& context);
void add_help(CLI::App& root, Context& context);

/// Declares the whole command. Every option of every subcommand is in `root` afterwards.
void add_all_commands(CLI::App& root, Context& context);

/// Parses and runs; reports errors on standard error. The exit code.
int run_command_line(int argc, const char* const* argv);

}  // namespace harpoon::app
