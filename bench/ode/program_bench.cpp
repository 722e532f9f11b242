#include "bench/ode/program_bench.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "bench/json.hpp"
#include "bench/ode/runtime.hpp"
#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

constexpr unsigned kWarmSteps = 2;
constexpr unsigned kLeastSteps = 5;
constexpr unsigned kMostSteps = 2000;

/// One of the twins. The solver takes the order of its constraints from ODE's random numbers: each
/// twin has a sequence of its own.
class Side {
 public:
  Side(const ProgramPlan& plan, ProgramKind kind, const CollisionCalls& calls)
      : program_(make_program(kind, plan.geoms, plan.seed)), calls_(calls), random_(plan.seed) {}

  void step() {
    dRandSetSeed(random_);
    const double begin_ns = now_ns();
    work_ = program_->step(calls_);
    step_ms_ = (now_ns() - begin_ns) * 1e-6;
    random_ = dRandGetSeed();
    state_.clear();
    program_->append_state(state_);
  }
  void note() {
    step_samples_.push_back(step_ms_);
    collision_samples_.push_back(work_.collision_ms);
  }

  [[nodiscard]] const Program& program() const { return *program_; }
  [[nodiscard]] const Program::Work& work() const { return work_; }
  [[nodiscard]] double step_ms() const { return step_ms_; }
  [[nodiscard]] Summary steps() const { return summarize(step_samples_); }
  [[nodiscard]] Summary collisions() const { return summarize(collision_samples_); }
  [[nodiscard]] bool equals(const Side& other) const {
    return work_.pairs == other.work_.pairs && work_.contacts == other.work_.contacts &&
           state_.size() == other.state_.size() &&
           std::memcmp(state_.data(), other.state_.data(), state_.size() * sizeof(dReal)) == 0;
  }

 private:
  std::unique_ptr<Program> program_;
  CollisionCalls calls_;
  unsigned long random_;
  Program::Work work_;
  double step_ms_ = 0;
  std::vector<dReal> state_;
  std::vector<double> step_samples_, collision_samples_;
};

ProgramRow measure(const ProgramPlan& plan, ProgramKind kind, const Interrupted& interrupted) {
  Side stock(plan, kind, stock_calls()), ours(plan, kind, linked_calls());
  ProgramRow row;
  row.program = kind;
  row.geoms = ours.program().geoms();
  row.identical = true;
  const unsigned settling = std::max(kWarmSteps, ours.program().settling_steps());
  double spent_ms = 0;
  unsigned measured = 0;
  for (unsigned step = 0;
       measured < kMostSteps && (measured < kLeastSteps || spent_ms < plan.seconds * 1e3); ++step) {
    if (must_stop(interrupted)) return row;
    const bool stock_first = step % 2 == 0;
    (stock_first ? stock : ours).step();
    (stock_first ? ours : stock).step();
    row.identical = row.identical && stock.equals(ours);
    if (step < settling) continue;
    ++measured;
    spent_ms += stock.step_ms() + ours.step_ms();
    stock.note();
    ours.note();
    row.pairs += static_cast<double>(ours.work().pairs);
    row.contacts += static_cast<double>(ours.work().contacts);
  }
  row.pairs /= measured;
  row.contacts /= measured;
  row.stock_step_ms = stock.steps();
  row.harpoon_step_ms = ours.steps();
  row.stock_collision_ms = stock.collisions();
  row.harpoon_collision_ms = ours.collisions();
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

Result<std::vector<ProgramRow>> run_programs(const ProgramPlan& plan,
                                             const std::function<void(double)>& share,
                                             const Interrupted& interrupted) {
  if (!drop_in_is_interposed()) {
    return Error{Errc::device_unavailable,
                 "libharpoon_ode is not in front of libode here. Preload it."};
  }
  const OdeRuntime ode;
  std::vector<ProgramRow> rows;
  for (const ProgramKind kind : plan.programs) {
    rows.push_back(measure(plan, kind, interrupted));
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
