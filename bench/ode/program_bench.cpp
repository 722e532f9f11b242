#include "bench/ode/program_bench.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "bench/json.hpp"
#include "bench/ode/collision_calls.hpp"
#include "bench/ode/program_twin.hpp"
#include "bench/ode/runtime.hpp"

namespace harpoon::bench {
namespace {

constexpr unsigned kWarmSteps = 2;
constexpr unsigned kLeastSteps = 5;
constexpr unsigned kMostSteps = 2000;

/// What a side took in the measured steps.
struct Samples {
  std::vector<double> step_ms, collision_ms;

  void add(const ProgramStep& step) {
    step_ms.push_back(step.step_ms);
    collision_ms.push_back(step.work.collision_ms);
  }
};

bool are_equal(const ProgramStep& a, const ProgramStep& b) {
  return a.work.pairs == b.work.pairs && a.work.contacts == b.work.contacts &&
         a.state.size() == b.state.size() &&
         std::memcmp(a.state.data(), b.state.data(), a.state.size() * sizeof(dReal)) == 0;
}

Result<ProgramRow> measure(const ProgramPlan& plan, ProgramKind kind, int socket,
                           const Interrupted& interrupted) {
  ProgramTwin twin(socket, kind, plan.geoms, plan.seed);
  ProgramRun run(kind, plan.geoms, plan.seed);
  ProgramRow row;
  row.program = kind;
  row.geoms = run.program().geoms();
  row.identical = true;
  const unsigned settling = std::max(kWarmSteps, run.program().settling_steps());
  Samples stock_samples, our_samples;
  double spent_ms = 0;
  unsigned measured = 0;
  for (unsigned step = 0;
       measured < kMostSteps && (measured < kLeastSteps || spent_ms < plan.seconds * 1e3); ++step) {
    if (must_stop(interrupted)) return row;
    const std::optional<ProgramStep> stock = twin.step();
    if (!stock) {
      return Error{Errc::device_unavailable, "The process with stock libode has ended. Try again."};
    }
    const ProgramStep ours = run.step();
    row.identical = row.identical && are_equal(*stock, ours);
    if (step < settling) continue;
    ++measured;
    spent_ms += stock->step_ms + ours.step_ms;
    stock_samples.add(*stock);
    our_samples.add(ours);
    row.pairs += static_cast<double>(ours.work.pairs);
    row.contacts += static_cast<double>(ours.work.contacts);
  }
  row.pairs /= measured;
  row.contacts /= measured;
  row.stock_step_ms = summarize(stock_samples.step_ms);
  row.harpoon_step_ms = summarize(our_samples.step_ms);
  row.stock_collision_ms = summarize(stock_samples.collision_ms);
  row.harpoon_collision_ms = summarize(our_samples.collision_ms);
  return row;
}

Json to_json(const ProgramRow& row) {
  return {{"program", to_string(row.program)},
          {"geoms", row.geoms},
          {"stock_step_ms", row.stock_step_ms.median},
          {"harpoon_step_ms", row.harpoon_step_ms.median},
          {"stock_collision_ms", row.stock_collision_ms.median},
          {"harpoon_collision_ms", row.harpoon_collision_ms.median},
          {"collision_share", row.share()},
          {"collision_speedup", row.collision_speedup()},
          {"speedup", row.speedup()},
          {"limit", row.limit()},
          {"pairs", row.pairs},
          {"contacts", row.contacts},
          {"identical", row.identical},
          {"samples", row.harpoon_step_ms.samples}};
}

}  // namespace

double ProgramRow::share() const {
  return stock_collision_ms.median / stock_step_ms.median;
}
double ProgramRow::collision_speedup() const {
  return stock_collision_ms.median / harpoon_collision_ms.median;
}
double ProgramRow::speedup() const {
  return stock_step_ms.median / harpoon_step_ms.median;
}

Result<std::vector<ProgramRow>> run_programs(const ProgramPlan& plan, int stock,
                                             const std::function<void(double)>& share,
                                             const Interrupted& interrupted) {
  if (!drop_in_is_interposed()) {
    return Error{Errc::device_unavailable,
                 "libharpoon_ode is not in front of libode here. Preload it."};
  }
  const OdeRuntime ode;
  std::vector<ProgramRow> rows;
  for (const ProgramKind kind : plan.programs) {
    const Result<ProgramRow> row = measure(plan, kind, stock, interrupted);
    if (!row) return row.error();
    rows.push_back(*row);
    if (must_stop(interrupted)) return rows;
    share(static_cast<double>(rows.size()) / static_cast<double>(plan.programs.size()));
  }
  return rows;
}

std::string programs_json(const ProgramPlan& plan, const std::vector<ProgramRow>& rows,
                          const Machine& machine, const std::string& command) {
  Json results = Json::array();
  for (const ProgramRow& row : rows) results.push_back(to_json(row));
  const Json out = {{"machine", machine_json(machine)},
                    {"commit", build_commit()},
                    {"date", timestamp()},
                    {"command", command},
                    {"seed", plan.seed},
                    {"results", results}};
  return out.dump(2) + "\n";
}

}  // namespace harpoon::bench
