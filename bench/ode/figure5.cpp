#include "bench/ode/figure5.hpp"

#include <fmt/format.h>
#include <ode/ode.h>

#include <algorithm>
#include <limits>

#include "bench/ode/recorder.hpp"
#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

double time_executions_ns(const Candidate& candidate) {
  dContactGeom contact;
  const double start = now_ns();
  for (unsigned i = 0; i < kFigure5Executions; ++i) {
    dCollide(candidate.geom1, candidate.geom2, 1, &contact, sizeof contact);
  }
  return now_ns() - start;
}

// Times that are so long that something else must have run in between are taken again: each
// collision happens once in a run, so no later sample of it would make up for one that was
// interrupted.
class Stopwatch {
 public:
  double executions_ns(const Candidate& candidate) {
    double least_ns = std::numeric_limits<double>::infinity();
    for (int attempt = 0; attempt < kAttempts && least_ns > kInterrupted * usual_ns_; ++attempt) {
      least_ns = std::min(least_ns, time_executions_ns(candidate));
      usual_ns_ = std::max(std::min(usual_ns_, least_ns), kClockStepNs);
    }
    return least_ns;
  }

 private:
  static constexpr int kAttempts = 10;
  static constexpr double kInterrupted = 50;  ///< times the shortest that was seen
  static constexpr double kClockStepNs = 20;
  double usual_ns_ = std::numeric_limits<double>::max() / kInterrupted;
};

// nCol of the paper's flow chart, with its running total.
class Tally {
 public:
  Tally(PairType type, std::span<const std::size_t> counts, double timer_overhead_ns)
      : type_(type), counts_(counts) {
    run_.timer_overhead_ns = timer_overhead_ns;
  }

  [[nodiscard]] bool done() const { return run_.total_ns.size() == counts_.size(); }
  [[nodiscard]] std::size_t collisions() const { return collisions_; }

  void see(const Candidate& candidate) {
    if (done() || !matches(type_, candidate.flow)) {
      return;
    }
    total_ns_ +=
        (stopwatch_.executions_ns(candidate) - run_.timer_overhead_ns) / kFigure5Executions;
    ++collisions_;
    while (!done() && counts_[run_.total_ns.size()] <= collisions_) {
      run_.total_ns.push_back(total_ns_);
    }
  }

  Figure5Run take() { return std::move(run_); }

 private:
  PairType type_;
  std::span<const std::size_t> counts_;
  Figure5Run run_;
  Stopwatch stopwatch_;
  double total_ns_ = 0;
  std::size_t collisions_ = 0;
};

}  // namespace

Result<Figure5Run> time_as_figure5(const DiamondParameters& parameters, PairType type,
                                   std::span<const std::size_t> counts,
                                   const Interrupted& interrupted) {
  Result<std::unique_ptr<DiamondWorld>> world = DiamondWorld::create(parameters);
  if (!world) {
    return world.error();
  }
  Tally tally(type, counts, measure_timer_overhead_ns());
  std::uint64_t barren_steps = 0;
  while (!tally.done() && !must_stop(interrupted)) {
    const std::size_t before = tally.collisions();
    (*world)->step([&](const Candidate& candidate) { tally.see(candidate); });
    barren_steps = tally.collisions() > before ? 0 : barren_steps + 1;
    if (barren_steps == kMaxBarrenSteps) {
      return Error{
          Errc::invalid_argument,
          fmt::format("This diamond gave no {} collision in {} steps, so Figure 5's method "
                      "cannot time one. Time recorded pairs as a batch instead.",
                      to_string(type), kMaxBarrenSteps)};
    }
  }
  return tally.take();
}

}  // namespace harpoon::bench
