// `harpoon afu`: what the AFU is and what it counted in a small transaction of every format.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <optional>

#include "apps/afu_runs.hpp"
#include "apps/command.hpp"
#include "apps/exit_code.hpp"
#include "apps/files.hpp"
#include "apps/options.hpp"
#include "apps/output.hpp"
#include "apps/progress.hpp"
#include "apps/table.hpp"
#include "bench/json.hpp"

namespace harpoon::app {
namespace {

using bench::Json;

constexpr const char* kStepNames[] = {"pointers", "data, SPL", "start", "AFU ID",
                                      "done",     "results",   "free"};

struct AfuCommandOptions {
  AfuRunsPlan plan;
  std::string json;
  std::string waveform;
};

std::string id_text(const afu::AfuIdentity& id) {
  return fmt::format("{:016x}{:016x}", id.id_high, id.id_low);
}

double ns_per_cycle(const afu::AfuReport& report) {
  return 1000 / report.link.clock_mhz;
}

std::string per_pair(double value, const AfuRun& run) {
  return run.report.pairs == 0
             ? "-"
             : fmt::format("{:.3f}", value / static_cast<double>(run.report.pairs));
}

double simulated_pairs_per_s(const AfuRun& run) {
  constexpr double kNsPerS = 1e9;
  return static_cast<double>(run.report.pairs) / run.wall_ns * kNsPerS;
}

std::string describe_afu(const afu::AfuReport& report) {
  const afu::AfuIdentity& id = report.identity;
  const afu::LinkInfo& link = report.link;
  return fmt::format(
      "AFU ID   {}\n"
      "Array    {} SCPUs, {} index lanes, up to {} lines in flight, {} spheres\n"
      "Formats  direct; direct, hits only; indexed, hits only\n"
      "Profile  {}: {}\n"
      "Link     {} MHz, {:.1f} bytes a cycle {}, {} lines in flight each way\n\n",
      id_text(id), id.scpus, id.lanes, id.lines_in_flight, id.table_spheres, link.profile,
      link.description, link.clock_mhz, link.bytes_per_cycle,
      link.shared_bandwidth ? "in all" : "each way", link.lines_in_flight);
}

std::string describe_runs(const Terminal& terminal, const std::vector<AfuRun>& runs) {
  std::vector<std::vector<Cell>> rows;
  for (const AfuRun& run : runs) {
    const afu::AfuReport& r = run.report;
    const auto cycles = static_cast<double>(r.total_cycles);
    rows.push_back({run.name, fmt::format("{}", r.pairs), fmt::format("{}", r.hits),
                    fmt::format("{}", r.total_cycles), per_pair(cycles, run),
                    per_pair(cycles * ns_per_cycle(r), run),
                    fmt::format("{:.1f} %", 100 * r.link_occupancy),
                    fmt::format("{:.1f} %", 100 * r.scpu_occupancy),
                    r.pairs == 0 ? "-" : fmt::format("{:.0f}", simulated_pairs_per_s(run))});
  }
  return format_table(terminal,
                      {{"run"},
                       {"pairs", true},
                       {"hits", true},
                       {"cycles", true},
                       {"a pair", true},
                       {"ns a pair", true},
                       {"link busy", true},
                       {"SCPUs busy", true},
                       {"simulated/s", true}},
                      rows);
}

std::string describe_counters(const Terminal& terminal, const std::vector<AfuRun>& runs) {
  std::vector<std::vector<Cell>> rows;
  for (const AfuRun& run : runs) {
    const afu::Counters& c = run.report.counters;
    std::vector<Cell> row = {run.name};
    for (const std::uint64_t value :
         {c.cycles, c.lines_read, c.lines_written, c.scpu_pairs, c.first_line, c.first_write,
          c.read_stalls, c.write_stalls, c.spl2_cycles}) {
      row.emplace_back(fmt::format("{}", value));
    }
    rows.push_back(row);
  }
  return format_table(terminal,
                      {{"counters"},
                       {"running", true},
                       {"lines in", true},
                       {"lines out", true},
                       {"SCPU pairs", true},
                       {"first line", true},
                       {"first write", true},
                       {"read stalls", true},
                       {"write stalls", true},
                       {"SPL2 load", true}},
                      rows);
}

std::string describe_steps(const Terminal& terminal, const std::vector<AfuRun>& runs) {
  std::vector<Column> columns = {{"steps, at cycle"}};
  for (const char* name : kStepNames) {
    columns.push_back({fmt::format("{} {}", columns.size(), name), true});
  }
  std::vector<std::vector<Cell>> rows;
  for (const AfuRun& run : runs) {
    std::vector<Cell> row = {run.name};
    for (const std::uint64_t at : run.report.last_steps) {
      row.emplace_back(fmt::format("{}", at - run.report.last_steps.front()));
    }
    rows.push_back(row);
  }
  return format_table(terminal, columns, rows);
}

std::string describe(const Terminal& terminal, const std::vector<AfuRun>& runs) {
  return describe_afu(runs.front().report) + describe_runs(terminal, runs) + "\n" +
         describe_counters(terminal, runs) + "\n" + describe_steps(terminal, runs) + "\n" +
         paragraph(
             "Cycles, and ns made of them, are modelled. simulated/s is measured: pairs that "
             "the simulation puts through in a second of this machine.");
}

Json link_json(const afu::LinkInfo& link) {
  return {{"profile", link.profile},
          {"description", link.description},
          {"clock_mhz", link.clock_mhz},
          {"bytes_per_cycle", link.bytes_per_cycle},
          {"shared_bandwidth", link.shared_bandwidth},
          {"lines_in_flight", link.lines_in_flight},
          {"modelled", link.modelled}};
}

Json afu_json(const afu::AfuIdentity& id) {
  Json formats = Json::array();
  for (std::uint32_t i = 0; i < afu::contract::kFormatCount; ++i) {
    formats.push_back(format_name(static_cast<afu::contract::Format>(i)));
  }
  return {{"id", id_text(id)},
          {"scpus", id.scpus},
          {"index_lanes", id.lanes},
          {"lines_in_flight", id.lines_in_flight},
          {"table_spheres", id.table_spheres},
          {"formats", formats}};
}

Json counters_json(const afu::Counters& c) {
  return {{"cycles", c.cycles},
          {"lines_read", c.lines_read},
          {"lines_written", c.lines_written},
          {"hits", c.hits},
          {"scpu_pairs", c.scpu_pairs},
          {"first_line", c.first_line},
          {"first_write", c.first_write},
          {"read_stalls", c.read_stalls},
          {"write_stalls", c.write_stalls},
          {"spl2_cycles", c.spl2_cycles}};
}

Json run_json(const AfuRun& run) {
  const afu::AfuReport& r = run.report;
  Json steps = Json::array();
  for (const std::uint64_t at : r.last_steps) {
    steps.push_back(at - r.last_steps.front());
  }
  return {{"run", run.name},
          {"format", format_name(r.format)},
          {"pairs", r.pairs},
          {"hits", r.hits},
          {"transactions", r.transactions},
          {"cycles", r.total_cycles},
          {"modelled_ns", static_cast<double>(r.total_cycles) * ns_per_cycle(r)},
          {"link_occupancy", r.link_occupancy},
          {"scpu_occupancy", r.scpu_occupancy},
          {"counters", counters_json(r.counters)},
          {"last_steps", steps},
          {"simulated_pairs_per_s", simulated_pairs_per_s(run)}};
}

Json to_json(const std::vector<AfuRun>& runs) {
  Json all = Json::array();
  for (const AfuRun& run : runs) {
    all.push_back(run_json(run));
  }
  const afu::AfuReport& first = runs.front().report;
  return {{"schema", 1},
          {"link", link_json(first.link)},
          {"afu", afu_json(first.identity)},
          {"runs", all}};
}

void require_right(const std::vector<AfuRun>& runs) {
  for (const AfuRun& run : runs) {
    if (!run.mismatch.empty()) {
      throw CommandError(ExitCode::failure, fmt::format("{}: {}. Do not use this AFU; report it.",
                                                        run.name, run.mismatch));
    }
  }
}

void deliver(const Context& context, const AfuCommandOptions& options,
             const std::vector<AfuRun>& runs, OutputFile* waveform) {
  const bool json_on_stdout = options.json == "-";
  if (json_on_stdout) {
    print("{}\n", to_json(runs).dump(2));
  } else {
    print("{}", describe(context.terminal, runs));
  }
  if (!options.json.empty() && !json_on_stdout) {
    write_file(options.json, to_json(runs).dump(2) + "\n");
    print("{}\n", shown(options.json));
  }
  if (waveform == nullptr) return;
  waveform->commit();
  const std::string name = shown(options.waveform) + "\n";
  json_on_stdout ? remark(name) : print("{}", name);
}

void show(const Context& context, const AfuCommandOptions& options) {
  if (!options.json.empty() && options.json != "-") require_writable_file(options.json, "--json");
  std::optional<OutputFile> waveform;
  std::optional<CommandError> lost;
  AfuRunsPlan plan = options.plan;
  if (!options.waveform.empty()) {
    waveform.emplace(options.waveform, "--waveform");
    plan.waveform = [&](std::string_view text) {
      try {
        if (!lost) waveform->out().write(text);
      } catch (const CommandError& error) {
        lost = error;
      }
    };
  }
  const std::vector<AfuRun> runs = [&] {
    Progress progress(context.terminal);
    progress.show(0, "running the AFU");
    return run_afu(plan);
  }();
  if (lost) throw CommandError(*lost);
  deliver(context, options, runs, waveform ? &*waveform : nullptr);
  require_right(runs);
}

void add_options(CLI::App& command, AfuCommandOptions& options) {
  add_name(command, "--profile", options.plan.profile, "PROFILE",
           "Link: harp, pcie3x16 or f2, and any of its numbers after commas");
  add_whole(command, "--pairs", options.plan.pairs, 0, 10000000, "N", "Pairs in each run");
  add_whole(command, "--hits", options.plan.direct_hit_percent, 0, 100, "N",
            "Percent of the pairs that overlap, direct formats");
  add_whole(command, "--indexed-hits", options.plan.indexed_hit_percent, 0, 100, "N",
            "Percent of the pairs that overlap, indexed format");
  add_seed(command, options.plan.seed, "Seed of the pairs");
  add_name(command, "--waveform", options.waveform, "FILE",
           "Write the AFU's ports in the direct run as a VCD; use few --pairs");
  add_name(command, "--json", options.json, "FILE",
           "Write the same as JSON; - for standard output alone");
}

}  // namespace

void add_afu(CLI::App& root, Context& context) {
  CLI::App* command = root.add_subcommand(
      "afu", "The simulated AFU: what it is, and a small transaction of every format");
  auto options = std::make_shared<AfuCommandOptions>();
  add_options(*command, *options);
  command->footer(
      "Every result is compared with the scalar collider; exit code 1 when one differs. The\n"
      "published behaviour is 4 lines in flight and a barrier after every batch of N pairs.\n"
      "Numbers of a profile: clock_mhz, gbps, shared (0 or 1), latency_ns, write_latency_ns,\n"
      "in_flight.\n\n"
      "Examples:\n"
      "  harpoon afu\n"
      "  harpoon afu --profile pcie3x16 --pairs 100000\n"
      "  harpoon afu --profile harp,latency_ns=500,in_flight=32 --json -\n"
      "  harpoon afu --pairs 20 --waveform afu.vcd");
  command->callback([&context, options] {
    context.memory_remedy = "Use fewer --pairs.";
    context.run = [&context, options] { show(context, *options); };
  });
}

}  // namespace harpoon::app
