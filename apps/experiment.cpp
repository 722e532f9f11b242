#include "apps/experiment.hpp"

#include <algorithm>

#include "apps/exit_code.hpp"
#include "apps/figures.hpp"
#include "bench/ode/recorder.hpp"

namespace harpoon::app {
namespace {

constexpr std::size_t kQuickStride = 20;
constexpr std::size_t kQuickPairs = 1000;
/// So that a time can be seen again.
constexpr unsigned kQuickRounds = 5;

// The parts of the experiment and how much of the whole time each takes.
struct Part {
  double begin;
  double end;
};
constexpr Part kFigure6Part = {0, 0.2};
constexpr Part kFigure7Part = {0.2, 0.7};
constexpr Part kTablePart = {0.7, 0.97};

std::vector<std::size_t> thinned(const std::vector<std::size_t>& counts) {
  std::vector<std::size_t> few;
  for (std::size_t i = 0; i < counts.size(); i += kQuickStride) {
    few.push_back(counts[i]);
  }
  return few;
}

bench::PairsPlan figure_plan(const ExperimentPlan& plan, const std::vector<std::size_t>& counts,
                             double time_limit_s) {
  bench::PairsPlan pairs;
  pairs.counts = plan.quick ? thinned(counts) : counts;
  pairs.rounds = plan.quick ? kQuickRounds : 9;
  pairs.time_limit_s = time_limit_s;
  pairs.figure5 = true;
  pairs.devices = plan.devices;
  return pairs;
}

bench::PairsPlan table_plan(const ExperimentPlan& plan) {
  bench::PairsPlan pairs;
  pairs.counts = {10, 250, 1000, 10000, 90000, 1000000};
  if (plan.quick) {
    pairs.counts = {10, kQuickPairs};
  }
  pairs.rounds = plan.quick ? kQuickRounds : 15;
  pairs.time_limit_s = 10;
  pairs.figure5 = true;
  pairs.devices = plan.table_devices;
  return pairs;
}

bench::PairsOutcome measure(const bench::PairsPlan& plan, const Part& part,
                            const bench::ShareDone& share_done) {
  const auto share = [&](double done) { share_done(part.begin + done * (part.end - part.begin)); };
  return value_or_throw(bench::run_pairs(plan, share));
}

std::vector<bench::SelftestCheck> check_contacts(const ExperimentPlan& plan) {
  const std::size_t count = plan.quick ? kQuickPairs : bench::kMostRecordedPairs;
  const bench::Recording recording =
      value_or_throw(bench::record({}, bench::PairType::mixed, count));
  std::vector<bench::SelftestCheck> checks;
  for (const bench::NamedDevice& device : plan.table_devices) {
    const Capabilities& capabilities = device.device->capabilities();
    const std::size_t pairs = capabilities.modelled ? std::min(count, kQuickPairs) : count;
    if (bench::supports(capabilities, bench::Format::records, false)) {
      checks.push_back(bench::check_records(device, bench::to_records<float>(recording, pairs)));
    }
    if (bench::supports(capabilities, bench::Format::records, true)) {
      checks.push_back(bench::check_records(device, bench::to_records<double>(recording, pairs)));
    }
  }
  return checks;
}

}  // namespace

bool Experiment::contacts_are_right() const {
  return std::all_of(checks.begin(), checks.end(),
                     [](const bench::SelftestCheck& check) { return check.passed(); });
}

Experiment run_experiment(const ExperimentPlan& plan, const bench::ShareDone& share_done) {
  const bench::LoadWatch watch;
  Experiment experiment;
  experiment.quick = plan.quick;
  experiment.figure6 = measure(figure_plan(plan, figure6_counts(), 8), kFigure6Part, share_done);
  experiment.figure7 = measure(figure_plan(plan, figure7_counts(), 16), kFigure7Part, share_done);
  experiment.table = measure(table_plan(plan), kTablePart, share_done);
  experiment.load = watch.look();
  experiment.checks = check_contacts(plan);
  return experiment;
}

}  // namespace harpoon::app
