#include "apps/command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <new>
#include <stdexcept>

#include "apps/exit_code.hpp"
#include "apps/output.hpp"
#include "apps/parse_error.hpp"
#include "apps/printable.hpp"
#include "apps/signals.hpp"
#include "bench/machine.hpp"

namespace harpoon::app {
namespace {

constexpr const char* kExitCodes =
    "Exit codes:\n"
    "  0    success\n"
    "  1    the command ran and found a failure (a mismatch, a missed target)\n"
    "  2    usage: unknown command or option, bad value\n"
    "  3    environment: a file, device, package or memory that is not there, or fails\n"
    "  4    data: a file that is malformed, or of another kind\n"
    "  5    run --require: no call of ODE was served\n"
    "  129, 130, 143  ended by SIGHUP, SIGINT or SIGTERM; no file is half-written\n\n"
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

/// As typed, fit for a document: results are read long after.
std::string joined(int argc, const char* const* argv) {
  std::string line = "harpoon";
  for (int i = 1; i < argc; ++i) {
    line += " " + printable(argv[i]);
  }
  return line;
}

/// One line on standard error, behind what was printed. What cannot be printed is told too.
void print_error(std::string_view message) {
  try {
    standard_output().flush();
  } catch (const CommandError& lost) {
    note("harpoon: error: {}\n", printable(lost.what()));
  }
  note("harpoon: error: {}\n", printable(message));
}

/// Does a part of the work and says what went wrong. The exit code.
ExitCode attempt(const Context& context, const std::function<void()>& part) {
  try {
    part();
    return ExitCode::ok;
  } catch (const CommandError& error) {
    print_error(error.what());
    return error.code();
  } catch (const std::bad_alloc&) {
    print_error("Out of memory. " + context.memory_remedy);
  } catch (const std::length_error&) {
    print_error("Out of memory. " + context.memory_remedy);
  } catch (const std::exception& error) {
    print_error(error.what());
  }
  return ExitCode::environment;
}

/// Parses, and leaves in the context what is to be run.
void parse(CLI::App& root, Context& context, int argc, const char* const* argv) {
  try {
    root.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const std::string answer = answer_to(root, error);
    context.run = [answer] { standard_output().write(answer); };
  }
}

}  // namespace

void add_all_commands(CLI::App& root, Context& context) {
  root.name("harpoon");
  root.description("Collision detection on whatever machine is at hand.");
  root.set_version_flag("-V,--version", version_text, "Print version, commit and ODE, and exit");
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
  add_help(root, context);  // last: it knows the others
}

int run_command_line(int argc, const char* const* argv) {
  open_standard_streams();
  handle_signals();
  Context context{detect_terminal(), joined(argc, argv), {}};
  CLI::App root;
  add_all_commands(root, context);
  ExitCode code = attempt(context, [&] {
    parse(root, context, argc, argv);
    context.run();
    standard_output().flush();
  });
  if (code == ExitCode::ok && remarks_were_lost()) code = ExitCode::environment;
  return static_cast<int>(code);
}

}  // namespace harpoon::app
