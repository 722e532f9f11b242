// `harpoon bench ode`: stock ODE and the drop-in on the same worlds, collision alone or whole
// programs.

#include <fmt/format.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>

#include "apps/command.hpp"
#include "apps/drop_in.hpp"
#include "apps/exit_code.hpp"
#include "apps/files.hpp"
#include "apps/options.hpp"
#include "apps/output.hpp"
#include "apps/progress.hpp"
#include "apps/signals.hpp"
#include "apps/table.hpp"
#include "bench/ode/drop_in_bench.hpp"
#include "bench/ode/interposed.hpp"
#include "bench/ode/program_bench.hpp"
#include "bench/ode/twin.hpp"

namespace harpoon::app {
namespace {

struct OdeOptions {
  std::string kind = "packed";
  std::string program;  ///< whole programs instead of collision alone
  std::size_t geoms = 10000;
  bool geoms_given = false;
  std::string space = "all";
  double seconds = 2;
  std::uint64_t seed = 1;
  std::string json;
};

/// The words of this process' command line.
std::vector<std::string> own_words() {
  const std::string joined = read_file("/proc/self/cmdline");
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin < joined.size();) {
    const std::size_t end = std::min(joined.find('\0', begin), joined.size());
    words.push_back(joined.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

std::string describe(const Terminal& terminal, const bench::DropInOutcome& outcome) {
  std::vector<std::vector<Cell>> rows;
  for (const bench::DropInRow& row : outcome.rows) {
    rows.push_back({std::string(to_string(row.space)), fmt::format("{:.4f}", row.stock_ms.median),
                    fmt::format("{:.4f}", row.harpoon_ms.median),
                    fmt::format("{:.2f}", row.speedup), fmt::format("{}", row.pairs),
                    fmt::format("{}", row.contacts), row.identical ? "yes" : "NO"});
  }
  std::string text = format_table(terminal,
                                  {{"space"},
                                   {"stock ms", true},
                                   {"harpoon ms", true},
                                   {"speed-up", true},
                                   {"pairs", true},
                                   {"contacts", true},
                                   {"identical"}},
                                  rows);
  for (const std::string& note : outcome.notes) text += paragraph(note);
  return text;
}

/// Holds the number of the socket to the process with stock libode.
constexpr const char* kTwinVariable = "HARPOON_BENCH_TWIN";

/// Keeps this process and those that come of it on one core: what others do there then slows both
/// sides alike. Where that is not allowed they stay where they are.
void stay_on_one_core() {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(static_cast<std::size_t>(std::max(::sched_getcpu(), 0)), &one);
  ::sched_setaffinity(0, sizeof one, &one);
}

/// Leaves a process behind that runs what it is asked for with stock libode, and goes on as one
/// with the drop-in: this command once more, with the library in front of libode. Returns the
/// socket between them.
int part_from_stock() {
  if (bench::drop_in_is_interposed()) {
    const char* const twin = std::getenv(kTwinVariable);
    if (twin != nullptr) return std::atoi(twin);
    throw CommandError(ExitCode::usage,
                       "libharpoon_ode is preloaded already. Run `harpoon bench ode` without it: "
                       "it does so itself.");
  }
  stay_on_one_core();
  int ends[2];
  const bool has_ends = ::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0;
  const pid_t child = has_ends ? ::fork() : -1;
  if (child < 0) {
    throw CommandError(
        ExitCode::environment,
        fmt::format("There is no second process: {}. End some others.", std::strerror(errno)));
  }
  if (child == 0) {
    // It has nothing to say and nothing to leave behind; it goes when the other one goes.
    leave_signals_alone();
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::close(ends[0]);
    bench::serve_twins(ends[1]);
    ::_exit(0);
  }
  ::close(ends[1]);
  std::vector<std::string> words = own_words();
  words[0] = "/proc/self/exe";
  run_with_drop_in(words, {{kTwinVariable, std::to_string(ends[0])}});
}

/// Runs `work` with a progress to report to.
template <class Work>
auto with_progress(const Context& context, const Work& work) {
  Progress progress(context.terminal);
  return value_or_throw(work([&](double done) { progress.show(done, "measuring"); }));
}

/// The table goes to standard output unless the JSON does.
void deliver(const std::string& file, const std::string& table, const std::string& json) {
  if (file == "-") {
    remark(table);
    print("{}", json);
    return;
  }
  print("{}", table);
  if (file.empty()) return;
  write_file(file, json);
  print("{}\n", shown(file));
}

void measure(const Context& context, const OdeOptions& options) {
  bench::DropInPlan plan;
  plan.kind = *bench::parse_drop_in_kind(options.kind);
  plan.geoms = options.geoms;
  plan.seconds = options.seconds;
  plan.seed = options.seed;
  for (std::size_t k = 0; k < bench::kSpaceKinds; ++k) {
    const auto space = static_cast<bench::SpaceKind>(k);
    if (options.space == "all" || options.space == to_string(space)) plan.spaces.push_back(space);
  }
  const int stock = part_from_stock();
  const auto outcome = with_progress(context, [&](const std::function<void(double)>& share) {
    return bench::run_drop_in(plan, stock, share, {});
  });
  deliver(options.json, describe(context.terminal, outcome),
          bench::drop_in_json(plan, outcome, bench::describe_machine(), context.command_line));
  for (const bench::DropInRow& row : outcome.rows) {
    if (!row.identical) {
      throw CommandError(
          ExitCode::failure,
          fmt::format("the drop-in differs from stock in the {} space", to_string(row.space)));
    }
  }
}

std::vector<bench::ProgramKind> programs_of(const OdeOptions& options) {
  std::vector<bench::ProgramKind> programs;
  for (std::size_t k = 0; k < bench::kProgramKinds; ++k) {
    const auto kind = static_cast<bench::ProgramKind>(k);
    if (options.program == "all" || options.program == to_string(kind)) programs.push_back(kind);
  }
  return programs;
}

std::string describe(const Terminal& terminal, const std::vector<bench::ProgramRow>& rows) {
  const auto ms = [](const bench::Summary& summary) {
    return fmt::format("{:.3f}", summary.median);
  };
  const auto times = [](double ratio) { return fmt::format("{:.2f}", ratio); };
  // Two tables, for one would be wider than a terminal.
  std::vector<std::vector<Cell>> steps;
  std::vector<std::vector<Cell>> collisions;
  for (const bench::ProgramRow& row : rows) {
    const std::string name(to_string(row.program));
    steps.push_back({name, fmt::format("{}", row.geoms), ms(row.stock_step_ms),
                     ms(row.harpoon_step_ms), times(row.speedup()), times(row.limit()),
                     row.identical ? "yes" : "NO"});
    collisions.push_back({name, ms(row.stock_collision_ms), ms(row.harpoon_collision_ms),
                          times(row.collision_speedup()),
                          fmt::format("{:.1f} %", row.share() * 100)});
  }
  return format_table(terminal,
                      {{"step of"},
                       {"geoms", true},
                       {"stock ms", true},
                       {"harpoon ms", true},
                       {"speed-up", true},
                       {"limit", true},
                       {"identical"}},
                      steps) +
         "\n" +
         format_table(terminal,
                      {{"collision in"},
                       {"stock ms", true},
                       {"harpoon ms", true},
                       {"speed-up", true},
                       {"share", true}},
                      collisions);
}

void measure_programs(const Context& context, const OdeOptions& options) {
  bench::ProgramPlan plan;
  plan.programs = programs_of(options);
  plan.geoms = options.geoms_given ? options.geoms : 0;
  plan.seconds = options.seconds;
  plan.seed = options.seed;
  for (const bench::ProgramKind kind : plan.programs) {
    if (options.geoms_given && !has_size(kind)) {
      throw CommandError(ExitCode::usage,
                         fmt::format("--geoms does not go with {}, whose size is fixed. Leave it "
                                     "out, or give one of pile, sleeping, planner, clutter.",
                                     to_string(kind)));
    }
  }
  const int stock = part_from_stock();
  const auto rows = with_progress(context, [&](const std::function<void(double)>& share) {
    return bench::run_programs(plan, stock, share, {});
  });
  deliver(options.json, describe(context.terminal, rows),
          bench::programs_json(plan, rows, bench::describe_machine(), context.command_line));
  for (const bench::ProgramRow& row : rows) {
    if (!row.identical) {
      throw CommandError(ExitCode::failure, fmt::format("with the drop-in {} runs another way",
                                                        to_string(row.program)));
    }
  }
}

void run(const Context& context, const OdeOptions& options) {
  if (!options.json.empty() && options.json != "-") require_writable_file(options.json, "--json");
  if (options.program.empty()) {
    measure(context, options);
  } else {
    measure_programs(context, options);
  }
}

}  // namespace

void add_bench_ode(CLI::App& bench, Context& context) {
  CLI::App* ode = bench.add_subcommand("ode", "Stock ODE and the drop-in on the same worlds");
  auto options = std::make_shared<OdeOptions>();
  CLI::Option* const kind =
      add_choice(*ode, "--kind", options->kind,
                 {"packed", "gas", "mixed", "asleep", "chain", "fallen", "cars"}, "World");
  kind->capture_default_str();
  CLI::Option* const geoms =
      add_whole(*ode, "--geoms", options->geoms, 2, 10000000, "N",
                "Geoms; of a program its bodies or obstacles, by default its own number");
  CLI::Option* const space =
      add_choice(*ode, "--space", options->space, {"simple", "hash", "sap", "quadtree", "all"},
                 "Kind of space");
  space->capture_default_str();
  add_choice(*ode, "--program", options->program,
             {"diamond10", "diamond30", "pile", "sleeping", "planner", "clutter", "all"},
             "Whole programs instead of collision alone")
      ->excludes(kind)
      ->excludes(space);
  add_real(*ode, "--seconds", options->seconds, 0, 3600, "S",
           "Time to measure each space or program, at least five steps");
  add_seed(*ode, options->seed, "Seed of the world");
  add_name(*ode, "--json", options->json, "FILE",
           "Write the results as JSON; - for standard output");
  ode->footer(
      "Times are medians of a step, stock and drop-in in turn on twin worlds, in two processes on\n"
      "one core, without and with the library preloaded: dSpaceCollide with dCollide in the\n"
      "callback. With --program also of the whole step, solver included: share is the part of\n"
      "collision in stock's step, limit what the step would gain if collision took no time\n"
      "(Amdahl).\n\n"
      "Programs: diamond10, diamond30: the paper's world. pile: 3,000 bodies dropped into a pen.\n"
      "sleeping: 10,000 boxes, all asleep but for those that 8 balls hit. planner, clutter: an "
      "arm\n"
      "of 42 geoms between 40 plates, or 1,000 boxes, and no solver.\n\n"
      "Examples:\n"
      "  harpoon bench ode --geoms 1000\n"
      "  harpoon bench ode --kind gas --geoms 100000 --space hash --json ode.json\n"
      "  harpoon bench ode --program all --seconds 5");
  ode->callback([&context, options, geoms] {
    context.memory_remedy = "Use fewer --geoms.";
    options->geoms_given = geoms->count() > 0;
    context.run = [&context, options] { run(context, *options); };
  });
}

}  // namespace harpoon::app
