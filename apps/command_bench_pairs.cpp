// `harpoon bench pairs`: ODE and every device on the same pairs, in one interleaved run.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "apps/command.hpp"
#include "apps/device_catalog.hpp"
#include "apps/exit_code.hpp"
#include "apps/figures.hpp"
#include "apps/files.hpp"
#include "apps/options.hpp"
#include "apps/output.hpp"
#include "apps/progress.hpp"
#include "apps/result_table.hpp"
#include "bench/machine.hpp"
#include "bench/ode/pairs_bench.hpp"
#include "bench/ode/targets.hpp"
#include "bench/results.hpp"

namespace harpoon::app {
namespace {

struct PairsOptions {
  std::string figure;
  std::vector<std::size_t> counts = {10000};
  std::string type = "real";
  std::string format = "records";
  std::string precision = "all";
  std::vector<unsigned> threads = {1};
  std::string device = "all";
  std::string profile = kDefaultAfuProfile;
  unsigned rounds = 11;
  std::size_t spheres = 100000;
  std::uint64_t seed = 1;
  unsigned h_max = 3;
  double d_sph = 0;
  bool copy = false;
  bool check = false;
  std::string json;
  std::string csv;
};

bench::PairsPlan to_plan(const PairsOptions& options) {
  bench::PairsPlan plan;
  plan.type = *bench::parse_pair_type(options.type);
  plan.format = *bench::parse_format(options.format);
  plan.counts = options.counts;
  std::sort(plan.counts.begin(), plan.counts.end());
  plan.counts.erase(std::unique(plan.counts.begin(), plan.counts.end()), plan.counts.end());
  if (!options.figure.empty()) {
    plan.counts = options.figure == "6" ? figure6_counts() : figure7_counts();
  }
  plan.figure5 = true;
  plan.f32 = options.precision != "f64";
  plan.f64 = options.precision != "f32";
  plan.rounds = options.rounds;
  plan.indexed_spheres = options.spheres;
  plan.seed = options.seed;
  plan.diamond.h_max = options.h_max;
  plan.diamond.d_sph = options.d_sph;
  return plan;
}

// A batch that cannot fit would have the machine swap, or end the process.
void require_memory(const bench::PairsPlan& plan, const PairsOptions& options) {
  constexpr double kUsableShare = 0.8;
  double bytes_per_pair = (plan.f32 ? 64 : 0) + (plan.f64 ? 128 : 0);
  if (plan.format == bench::Format::indexed) {
    bytes_per_pair += sizeof(IndexPair);
  }
  const double copy_bytes = options.copy ? 512e6 : 0;
  const double needed_gb =
      (static_cast<double>(plan.counts.back()) * bytes_per_pair + copy_bytes) * 1e-9;
  const double memory_gb = bench::describe_machine().memory_gb;
  if (needed_gb > kUsableShare * memory_gb) {
    throw CommandError(ExitCode::environment,
                       fmt::format("--count: {} pairs take {:.1f} GB, this machine has {:.1f} GB. "
                                   "Use a smaller --count or one --precision.",
                                   plan.counts.back(), needed_gb, memory_gb));
  }
}

void require_outputs(const PairsOptions& options) {
  if (!options.json.empty() && options.json != "-") {
    require_writable_file(options.json, "--json");
  }
  if (!options.csv.empty()) {
    require_writable_file(options.csv, "--csv");
  }
}

// Simulating so many pairs takes longer than anybody waits who did not ask for it.
std::vector<std::string> leave_out_slow(const PairsOptions& options, bench::PairsPlan& plan) {
  constexpr std::size_t kMostSimulated = 1000000;
  if (options.device != "all" || plan.counts.back() <= kMostSimulated) {
    return {};
  }
  std::vector<std::string> notes;
  std::erase_if(plan.devices, [&](const bench::NamedDevice& device) {
    const bool slow = device.device->capabilities().modelled;
    if (slow) {
      notes.push_back(
          fmt::format("Device {} is simulated and left out above {} pairs; ask for it "
                      "with --device {}.",
                      device.name, kMostSimulated, device.name));
    }
    return slow;
  });
  return notes;
}

void measure(const Context& context, const PairsOptions& options) {
  const bench::LoadWatch watch;
  bench::PairsPlan plan = to_plan(options);
  require_memory(plan, options);
  require_outputs(options);
  plan.devices = open_devices(options.device, options.threads, options.profile);
  const std::vector<std::string> left_out = leave_out_slow(options, plan);
  if (options.copy) {
    plan.copy_threads = thread_counts(options.threads);
  }
  auto outcome = [&] {
    Progress progress(context.terminal);
    progress.show(0, "recording pairs");
    const auto share = [&](double done) { progress.show(done, "measuring"); };
    return value_or_throw(bench::run_pairs(plan, share));
  }();
  outcome.notes.insert(outcome.notes.end(), left_out.begin(), left_out.end());

  bench::ResultSet results{bench::describe_machine(),
                           bench::build_commit(),
                           bench::timestamp(),
                           context.command_line,
                           outcome.timer_overhead_ns,
                           bench::to_rows(outcome.series, plan.type),
                           bench::to_copy_bandwidths(outcome.copy_series),
                           outcome.notes,
                           watch.look()};
  const bool json_on_stdout = options.json == "-";
  const std::string table = describe_results(context.terminal, results);
  json_on_stdout ? remark(table) : print("{}", table);
  if (json_on_stdout) {
    print("{}", bench::to_json(results));
  } else if (!options.json.empty()) {
    write_file(options.json, bench::to_json(results));
    print("{}\n", shown(options.json));
  }
  if (!options.csv.empty()) {
    append_csv(options.csv, bench::csv_header(), bench::to_csv(results));
    const std::string name = shown(options.csv) + "\n";
    json_on_stdout ? remark(name) : print("{}", name);
  }
}

bench::NamedDevice open_cpu(unsigned threads) {
  return open_devices("cpu", {threads}).front();
}

void check(const Context& context, const PairsOptions& options) {
  const bench::LoadWatch watch;
  bench::TargetPlan plan{open_cpu(1), open_cpu(2), open_cpu(0), options.rounds};
  const auto targets = [&] {
    Progress progress(context.terminal);
    const auto share = [&](double done) { progress.show(done, "measuring targets"); };
    return value_or_throw(bench::check_targets(plan, share));
  }();
  print("{}", describe_targets(context.terminal, targets));
  print("{}", paragraph(bench::describe_load(watch.look())));
  const auto count = [&](bench::TargetVerdict verdict) {
    return std::count_if(targets.begin(), targets.end(),
                         [&](const bench::Target& t) { return t.verdict() == verdict; });
  };
  const auto missed = count(bench::TargetVerdict::missed);
  const auto unsure = count(bench::TargetVerdict::unsure);
  if (missed > 0) {
    throw CommandError(ExitCode::failure,
                       fmt::format("{} of {} targets were missed: the cpu device is slower than "
                                   "promised here.",
                                   missed, targets.size()));
  }
  if (unsure > 0) {
    throw CommandError(ExitCode::failure,
                       fmt::format("The run was too noisy to judge {} of {} targets. Run `harpoon "
                                   "bench pairs --check --rounds 50` on an idle machine.",
                                   unsure, targets.size()));
  }
}

void add_selection(CLI::App& pairs, PairsOptions& options) {
  add_choice(pairs, "--figure", options.figure, {"6", "7"},
             "Sweep of the paper: 6 is 10 to 1000 step 10, 7 is 1000 to 90000 step 1000");
  add_whole(pairs, "--count", options.counts, 1, kMaxBatchPairs, "N",
            "Pairs in a batch; several separated by commas")
      ->delimiter(',')
      ->default_str("10000")
      ->excludes("--figure");
  add_choice(pairs, "--type", options.type, {"real", "fake", "grazing", "mixed"},
             "Type of the recorded pairs")
      ->capture_default_str();
  add_choice(pairs, "--format", options.format, {"records", "arrays", "indexed"},
             "How pairs lie in memory; indexed asks about random pairs of many spheres")
      ->capture_default_str();
  add_choice(pairs, "--precision", options.precision, {"f32", "f64", "all"}, "Precision")
      ->capture_default_str();
  add_whole(pairs, "--threads", options.threads, 0, 1024, "T",
            "Threads of the cpu device; several separated by commas, 0 for all")
      ->delimiter(',')
      ->default_str("1");
  add_name(pairs, "--device", options.device, device_choices(), "Device to compare with ODE");
  add_name(pairs, "--profile", options.profile, "PROFILE",
           "Link of the simulated AFU, as for `harpoon afu`");
}

void add_details(CLI::App& pairs, PairsOptions& options) {
  add_whole(pairs, "--rounds", options.rounds, 1, 10000, "N",
            "Turns of each contestant at each count");
  add_whole(pairs, "--hmax", options.h_max, 1, bench::kMaxDiamondHMax, "H",
            "Diamond to record from: shells around the centre");
  add_real(pairs, "--dsph", options.d_sph, 0, 1e6, "D",
           "Diamond to record from: gap between spheres, metres");
  add_whole(pairs, "--spheres", options.spheres, 2, 100000000, "N",
            "Distinct spheres of --format indexed");
  add_seed(pairs, options.seed, "Seed of the pairs of --format indexed");
  pairs.add_flag("--copy", options.copy, "Also measure the copy bandwidth of as many threads");
  pairs.add_flag(
      "--check", options.check,
      "Measure the promised figures of the cpu device instead; exit code 1 on a miss, or "
      "when the run is too noisy to say");
  add_name(pairs, "--json", options.json, "FILE",
           "Write the results as JSON; - for standard output");
  add_name(pairs, "--csv", options.csv, "FILE", "Append the results to a CSV file");
}

}  // namespace

void add_bench_pairs(CLI::App& bench, Context& context) {
  CLI::App* pairs =
      bench.add_subcommand("pairs", "ODE and every device on the same pairs, interleaved");
  auto options = std::make_shared<PairsOptions>();
  add_selection(*pairs, *options);
  add_details(*pairs, *options);
  pairs->footer(
      "ODE is timed on the same recorded pairs as one batch (device ode) and as in Figure 5 of "
      "the\n"
      "paper (device ode (Figure 5)). Figures are medians over rounds; speed-ups and GB/s are "
      "those\n"
      "of fastest batches, which other programs cannot move, and relate to device ode.\n\n"
      "Examples:\n"
      "  harpoon bench pairs --count 10,10000,90000\n"
      "  harpoon bench pairs --figure 7 --json figure7.json\n"
      "  harpoon bench pairs --format indexed --count 1000000\n"
      "  harpoon bench pairs --count 8000000 --precision f32 --threads 1,2 --copy\n"
      "  harpoon bench pairs --check");
  pairs->callback([&context, options] {
    context.memory_remedy = "Use a smaller --count, or fewer --spheres.";
    context.run = [&context, options] {
      options->check ? check(context, *options) : measure(context, *options);
    };
  });
}

}  // namespace harpoon::app
