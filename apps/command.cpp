#include "apps/command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <new>

#include "apps/exit_code.hpp"
#include "apps/interrupt.hpp"
#include "bench/machine.hpp"

namespace harpoon::app {
namespace {

constexpr const char* kExitCodes =
    "Exit codes:\n"
    "  0    success\n"
    "  1    the command ran and found a failure (a mismatch, a missed target)\n"
    "  2    usage: unknown command or option, bad value\n"
    "  3    environment: a file, device, package or memory that is not there\n"
    "  5    run --require: no call of ODE was served\n"
    "  130  interrupted by SIGINT or SIGTERM; no file was written\n\n"
    "Environment:\n"
    "  NO_COLOR  when set and not empty, no colours are used\n\n"
    "Examples:\n"
    "  harpoon demo                        the paper's experiment, with a report\n"
    "  harpoon bench pairs --count 10000   ODE and every device on the same pairs\n"
    "  harpoon afu                         the simulated AFU, format by format\n"
    "  harpoon devices                     what can compute here\n"
    "  harpoon selftest                    is every device right?";

std::string version_text() {
  const bench::Machine machine = bench::describe_machine();
  return fmt::format("harpoon {} (commit {}, ODE {}, {})", machine.harpoon, bench::build_commit(),
                     machine.ode, machine.compiler);
}

std::string joined(int argc, const char* const* argv) {
  std::string line = "harpoon";
  for (int i = 1; i < argc; ++i) {
    line += std::string(" ") + argv[i];
  }
  return line;
}

void print_error(const std::string& message) {
  std::fflush(stdout);
  fmt::print(stderr, "harpoon: error: {}\n", message);
}

// CLI11 tells help and version by a zero exit code of their "error".
int report_parse(const CLI::App& root, const CLI::ParseError& error) {
  if (error.get_exit_code() == 0) {
    return root.exit(error);
  }
  const CLI::App* used = &root;
  while (!used->get_subcommands().empty()) {
    used = used->get_subcommands().front();
  }
  std::string name = "harpoon";
  for (const CLI::App* app = used; app->get_parent() != nullptr; app = app->get_parent()) {
    name.insert(sizeof "harpoon" - 1, " " + app->get_name());
  }
  const std::vector<std::string> unknown = used->remaining();
  const std::string what =
      unknown.empty() ? error.what()
                      : fmt::format("'{}' is no command or option of {}", unknown.front(), name);
  print_error(fmt::format("{}. See `{} --help`.", what, name));
  return static_cast<int>(ExitCode::usage);
}

int run_guarded(const std::function<void()>& run) {
  try {
    run();
    return static_cast<int>(ExitCode::ok);
  } catch (const CommandError& error) {
    print_error(error.what());
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    print_error("Out of memory. Use a smaller --count.");
    return static_cast<int>(ExitCode::environment);
  } catch (const std::exception& error) {
    print_error(error.what());
    return static_cast<int>(ExitCode::environment);
  }
}

}  // namespace

void add_all_commands(CLI::App& root, Context& context) {
  root.name("harpoon");
  root.description("Collision detection on whatever machine is at hand.");
  root.set_version_flag("--version", version_text, "Print version, commit and ODE, and exit");
  root.set_help_flag("-h,--help", "Print this help and exit");
  root.require_subcommand(1);
  root.footer(kExitCodes);
  add_demo(root, context);
  add_bench(root, context);
  add_diamond(root, context);
  add_detect(root, context);
  add_afu(root, context);
  add_run(root, context);
  add_replay(root, context);
  add_devices(root, context);
  add_selftest(root, context);
  add_completion(root, context);
  add_manual(root, context);
}

int run_command_line(int argc, const char* const* argv) {
  install_interrupt_handlers();
  Context context{detect_terminal(), joined(argc, argv), {}};
  CLI::App root;
  add_all_commands(root, context);
  try {
    root.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return report_parse(root, error);
  } catch (const CommandError& error) {
    print_error(error.what());
    return static_cast<int>(error.code());
  }
  return run_guarded(context.run);
}

}  // namespace harpoon::app
