#include "bench/ode/twin_bench.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "bench/ode/interposed.hpp"
#include "bench/ode/runtime.hpp"

namespace harpoon::bench {
namespace {

constexpr unsigned kWarmSteps = 2;
constexpr unsigned kLeastSteps = 5;
constexpr unsigned kMostTurns = 2000;
constexpr unsigned kComparedSteps = 3;
constexpr double kTurnMs = 1;
constexpr unsigned kMostStepsOfATurn = 1000;

double total_ms(const TwinTurn& turn) {
  double sum = 0;
  for (const TimedStep& step : turn.steps) sum += step.step_ms;
  return sum;
}

/// How many steps the next turn has, by the fastest of this one: others may have had the core.
unsigned steps_after(const TwinTurn& turn) {
  double step_ms = kTurnMs;
  for (const TimedStep& step : turn.steps) step_ms = std::min(step_ms, step.step_ms);
  return static_cast<unsigned>(std::min(kTurnMs / step_ms, double{kMostStepsOfATurn}));
}

bool are_equal(const TwinTurn& a, const TwinTurn& b) {
  const auto found_the_same = [](const TimedStep& x, const TimedStep& y) {
    return x.work.pairs == y.work.pairs && x.work.contacts == y.work.contacts;
  };
  return std::equal(a.steps.begin(), a.steps.end(), b.steps.begin(), b.steps.end(),
                    found_the_same) &&
         a.state.size() == b.state.size() &&
         (a.state.empty() ||
          std::memcmp(a.state.data(), b.state.data(), a.state.size() * sizeof(dReal)) == 0);
}

void add_times(const TwinTurn& turn, StepTimes& times) {
  for (const TimedStep& step : turn.steps) {
    times.step_ms.push_back(step.step_ms);
    times.collision_ms.push_back(step.work.collision_ms);
  }
}

/// Both sides of a measurement and what came of it so far.
class Sides {
 public:
  Sides(const Subject& subject, int stock) : twin_(stock, subject), run_(subject) {
    outcome_.geoms = run_.program().geoms();
    outcome_.identical = true;
  }
  [[nodiscard]] const Program& program() const { return run_.program(); }
  [[nodiscard]] unsigned measured() const {
    return static_cast<unsigned>(outcome_.harpoon.step_ms.size());
  }
  [[nodiscard]] double spent_ms() const { return spent_ms_; }
  /// The steps of stock's last turn.
  [[nodiscard]] const TwinTurn& stock() const { return stock_; }

  /// False once the other process has gone.
  bool turn(unsigned steps, bool compares) {
    std::optional<TwinTurn> stock = twin_.turn(steps, compares);
    if (!stock) return false;
    stock_ = std::move(*stock);
    ours_ = run_.turn(steps, compares);
    outcome_.identical = outcome_.identical && are_equal(stock_, ours_);
    return true;
  }

  /// Counts the last turn as measured.
  void take() {
    spent_ms_ += total_ms(stock_) + total_ms(ours_);
    add_times(stock_, outcome_.stock);
    add_times(ours_, outcome_.harpoon);
    for (const TimedStep& step : ours_.steps) {
      outcome_.pairs += static_cast<double>(step.work.pairs);
      outcome_.contacts += static_cast<double>(step.work.contacts);
    }
    outcome_.last = ours_.steps.back().work;
  }

  TwinOutcome outcome() {
    const double steps = std::max(measured(), 1U);
    outcome_.pairs /= steps;
    outcome_.contacts /= steps;
    return std::move(outcome_);
  }

 private:
  Twin twin_;
  SubjectRun run_;
  TwinTurn stock_, ours_;
  double spent_ms_ = 0;
  TwinOutcome outcome_;
};

}  // namespace

Result<TwinOutcome> measure_twins(const TwinPlan& plan, int stock, const Interrupted& interrupted) {
  if (!drop_in_is_interposed()) {
    return Error{Errc::device_unavailable,
                 "libharpoon_ode is not in front of libode here. Preload it."};
  }
  const Error gone{Errc::device_unavailable, "The process with stock libode has ended. Try again."};
  const OdeRuntime ode;
  Sides sides(plan.subject, stock);
  const unsigned settling = std::max(kWarmSteps, sides.program().settling_steps());
  unsigned steps = 1, settled = 0;
  for (unsigned turns = 0; turns < kMostTurns && (sides.measured() < kLeastSteps ||
                                                  sides.spent_ms() < plan.seconds * 1e3);) {
    if (must_stop(interrupted)) return sides.outcome();
    if (!sides.turn(steps, plan.compares_every)) return gone;
    if (settled < settling) {
      settled += steps;
    } else {
      sides.take();
      ++turns;
    }
    steps = steps_after(sides.stock());
  }
  if (!plan.compares_every && !sides.turn(kComparedSteps, true)) return gone;
  return sides.outcome();
}

}  // namespace harpoon::bench
