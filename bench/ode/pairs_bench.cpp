#include "bench/ode/pairs_bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "bench/copy_bandwidth.hpp"
#include "bench/ode/cold.hpp"
#include "bench/ode/figure5.hpp"
#include "bench/ode/recorder.hpp"
#include "bench/ode/replay.hpp"
#include "bench/results.hpp"
#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

// Everything the contestants use, in the order in which it must be built and, reversed, torn down.
class Arena {
 public:
  Arena(const PairsPlan& plan, const Interrupted& interrupted)
      : plan_(plan), interrupted_(interrupted) {}

  Result<bool> prepare() {
    if (plan_.format == Format::indexed) {
      prepare_indexed();
    } else if (const Result<bool> recorded = prepare_recorded(); !recorded) {
      return recorded.error();
    }
    if (plan_.f32) {
      add_devices<float>();
    }
    if (plan_.f64) {
      add_devices<double>();
    }
    add_copies();
    return true;
  }

  [[nodiscard]] std::span<const std::unique_ptr<Contestant>> contestants() const {
    return contestants_;
  }
  [[nodiscard]] const std::optional<Recording>& recording() const { return recording_; }
  [[nodiscard]] std::span<const std::unique_ptr<Contestant>> copies() const { return copies_; }
  [[nodiscard]] std::vector<std::string> notes() const { return notes_; }

 private:
  [[nodiscard]] std::size_t most() const { return plan_.counts.back(); }

  Result<bool> prepare_recorded() {
    const std::size_t distinct = std::min(most(), kMostRecordedPairs);
    Result<Recording> recorded = record(plan_.diamond, plan_.type, distinct, interrupted_);
    if (!recorded) {
      return recorded.error();
    }
    recording_ = std::move(recorded.value());
    if (recording_->constructed) {
      notes_.emplace_back(
          "Grazing pairs (coincident centres) do not occur in the diamond. These were made: at "
          "each "
          "step every odd sphere was placed on the centre of its even neighbour.");
    }
    if (most() > distinct) {
      notes_.push_back(fmt::format("Batches of more than {} pairs repeat the {} recorded ones.",
                                   distinct, distinct));
    }
    if (!recording_->pairs.empty()) {
      contestants_.push_back(make_ode_replay(*recording_));
    }
    return true;
  }

  void prepare_indexed() {
    scene_ = make_indexed_scene(plan_.type, plan_.indexed_spheres, most(), plan_.seed);
    notes_.push_back(fmt::format(
        "Indexed: {} distinct spheres and random pairs of them (seed {}), {:.1f} % of which touch.",
        scene_.spheres.size(), scene_.seed, 100 * scene_.hit_share));
    contestants_.push_back(make_ode_cold(scene_));
  }

  template <class Real>
  void add_devices() {
    std::vector<NamedDevice> able;
    for (const NamedDevice& device : plan_.devices) {
      if (supports(device.device->capabilities(), plan_.format, sizeof(Real) == 8)) {
        able.push_back(device);
      } else {
        notes_.push_back(fmt::format("Device {} does not do {} in {}; left out.", device.name,
                                     to_string(plan_.format), sizeof(Real) == 8 ? "f64" : "f32"));
      }
    }
    if (able.empty()) {
      return;
    }
    if (plan_.format == Format::indexed) {
      for (const NamedDevice& device : able) {
        contestants_.push_back(make_indexed_contestant<Real>(device, scene_));
      }
      return;
    }
    auto pairs = to_records<Real>(*recording_, most());
    if (plan_.format == Format::arrays) {
      const auto memory = std::make_shared<ArrayMemory<Real>>(pairs);
      for (const NamedDevice& device : able) {
        contestants_.push_back(make_arrays_contestant<Real>(device, memory));
      }
      return;
    }
    const auto memory = std::make_shared<PairMemory<Real>>(std::move(pairs));
    if constexpr (sizeof(Real) == 4) {
      f32_memory_ = memory;
    }
    for (const NamedDevice& device : able) {
      contestants_.push_back(make_records_contestant<Real>(device, memory));
    }
  }

  void add_copies() {
    if (plan_.copy_threads.empty()) {
      return;
    }
    constexpr std::size_t kCopyBytes = kCopyPairs * sizeof(SpherePair);
    std::span<const std::byte> source;
    std::span<std::byte> target;
    if (f32_memory_ && most() >= kCopyPairs) {
      // What is compared with a copy moves the same bytes of the same pages.
      source = std::as_bytes(std::span(f32_memory_->pairs)).first(kCopyBytes);
      target = std::as_writable_bytes(std::span(f32_memory_->contacts)).first(kCopyBytes);
    } else {
      copy_source_.assign(kCopyBytes, std::byte{1});
      copy_target_.assign(kCopyBytes, std::byte{2});
      source = copy_source_;
      target = copy_target_;
    }
    for (const unsigned threads : plan_.copy_threads) {
      for (const CopyMethod method : {CopyMethod::library, CopyMethod::non_temporal}) {
        copies_.push_back(make_copy_contestant(method, source, target, threads));
      }
    }
  }

 public:
  /// Copies move the traffic of this many f32 pairs: 256 MB each way, far beyond any cache.
  static constexpr std::size_t kCopyPairs = 8000000;

 private:
  const PairsPlan& plan_;
  const Interrupted& interrupted_;
  std::optional<Recording> recording_;
  IndexedScene scene_;
  std::shared_ptr<PairMemory<float>> f32_memory_;  ///< of records; null for other formats
  std::vector<std::byte> copy_source_;
  std::vector<std::byte> copy_target_;
  std::vector<std::unique_ptr<Contestant>> contestants_;
  std::vector<std::unique_ptr<Contestant>> copies_;
  std::vector<std::string> notes_;
};

// Figure 5's series, one run of the world per round.
class Figure5Series {
 public:
  explicit Figure5Series(const PairsPlan& plan)
      : plan_(plan), counts_(counts_of(plan)), totals_(counts_.size()) {}

  /// Each collision costs a run of the world, so only batches of the paper's size are timed.
  static std::vector<std::size_t> counts_of(const PairsPlan& plan) {
    if (!plan.figure5 || plan.format == Format::indexed || plan.type == PairType::grazing) {
      return {};
    }
    return {plan.counts.begin(),
            std::upper_bound(plan.counts.begin(), plan.counts.end(), kMostRecordedPairs)};
  }

  [[nodiscard]] bool applies() const { return !counts_.empty(); }

  Result<bool> round(const Interrupted& interrupted) {
    const Result<Figure5Run> run = time_as_figure5(plan_.diamond, plan_.type, counts_, interrupted);
    if (!run) {
      return run.error();
    }
    for (std::size_t i = 0; i < run->total_ns.size(); ++i) {
      totals_[i].push_back(run->total_ns[i]);
    }
    return true;
  }

  [[nodiscard]] Series series() const {
    Series series{{kOdeFigure5Device, "f64", 1, "geoms", false, 128}, {}};
    for (std::size_t i = 0; i < totals_.size(); ++i) {
      if (!totals_[i].empty()) {
        series.points.push_back({counts_[i], summarize(totals_[i]),
                                 totals_[i].size() * std::uint64_t{kFigure5Executions}});
      }
    }
    return series;
  }

 private:
  const PairsPlan& plan_;
  std::vector<std::size_t> counts_;
  std::vector<std::vector<double>> totals_;
};

bool out_of_time(const PairsPlan& plan, unsigned rounds_done, double start_ns) {
  constexpr unsigned kLeastRounds = 3;
  return plan.time_limit_s > 0 && rounds_done >= kLeastRounds &&
         now_ns() - start_ns > plan.time_limit_s * 1e9;
}

}  // namespace

Result<PairsOutcome> run_pairs(const PairsPlan& plan, const ShareDone& share_done,
                               const Interrupted& interrupted) {
  const OdeRuntime runtime;
  Arena arena(plan, interrupted);
  if (const Result<bool> prepared = arena.prepare(); !prepared) {
    return prepared.error();
  }
  PairsOutcome outcome;
  outcome.timer_overhead_ns = measure_timer_overhead_ns();
  outcome.notes = arena.notes();
  if (arena.recording()) {
    outcome.census = arena.recording()->census;
  }

  RoundRobin robin(arena.contestants(), plan.counts);
  RoundRobin copies(arena.copies(), {Arena::kCopyPairs});
  Figure5Series figure5(plan);
  std::size_t ticks = 0;
  const auto tick = [&] {
    ++ticks;
    if (share_done) {
      const std::size_t all = std::size_t{plan.rounds} * plan.counts.size();
      share_done(static_cast<double>(ticks) / static_cast<double>(all));
    }
  };
  const double start_ns = now_ns();
  for (unsigned r = 0; r < plan.rounds && !must_stop(interrupted); ++r) {
    if (out_of_time(plan, r, start_ns)) {
      break;
    }
    if (figure5.applies()) {
      if (const Result<bool> done = figure5.round(interrupted); !done) {
        return done.error();
      }
    }
    if (const Result<bool> done = robin.round(tick, interrupted); !done) {
      return done.error();
    }
    if (const Result<bool> done = copies.round({}, interrupted); !done) {
      return done.error();
    }
  }
  outcome.series = robin.series();
  if (figure5.applies()) {
    outcome.series.insert(outcome.series.begin() + 1, figure5.series());
  }
  outcome.copy_series = copies.series();
  return outcome;
}

}  // namespace harpoon::bench
