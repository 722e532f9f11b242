#include "bench/ode/targets.hpp"

#include <fmt/format.h>

#include "bench/results.hpp"

namespace harpoon::bench {
namespace {

constexpr std::size_t kInCaches = 300000;
constexpr std::size_t kMany = 1000000;
constexpr std::size_t kBeyondCaches = 8000000;

/// Of the copy bandwidth, what a batch that lives in memory must reach.
constexpr double kBandwidthShare = 0.85;

struct RowKey {
  const char* precision;
  unsigned threads;
  std::size_t count;
};

const ResultRow* find_row(const std::vector<ResultRow>& rows, const RowKey& key) {
  for (const ResultRow& row : rows) {
    if (row.label.device != kOdeDevice && row.label.precision == key.precision &&
        row.label.threads == key.threads && row.measured.count == key.count) {
      return &row;
    }
  }
  return nullptr;
}

// The share of a copy's bandwidth that a row's fastest batches reached.
Range share_of(const ResultRow& row, const CopyBandwidth& copy) {
  const double rate = row.gb_per_s();
  const Range rates = {rate / (1 + row.measured.ns.undisturbed().width()), rate};
  return ratio_of(rates, copy.best_range);
}

class TargetCheck {
 public:
  TargetCheck(const TargetPlan& plan, const ShareDone& share_done, const Interrupted& interrupted)
      : plan_(plan), share_done_(share_done), interrupted_(interrupted) {}

  Result<std::vector<Target>> run() {
    using Part = Result<bool> (TargetCheck::*)();
    const Part parts[kParts] = {&TargetCheck::hot_records, &TargetCheck::cold_indexed,
                                &TargetCheck::two_threads, &TargetCheck::bandwidth};
    for (; part_ < kParts && !must_stop(interrupted_); ++part_) {
      if (const Result<bool> done = (this->*parts[part_])(); !done) {
        return done.error();
      }
    }
    return std::move(targets_);
  }

 private:
  static constexpr int kParts = 4;

  Result<PairsOutcome> measure(const PairsPlan& plan) {
    const auto share = [this](double part_share) {
      if (share_done_) {
        share_done_((part_ + part_share) / kParts);
      }
    };
    return run_pairs(plan, share, interrupted_);
  }

  void add(std::string what, double measured, const Range& sure, double required,
           std::string command) {
    targets_.push_back({std::move(what), measured, sure, required, std::move(command)});
  }

  Result<bool> hot_records() {
    PairsPlan plan;
    plan.counts = {10, 10000, 90000};
    plan.rounds = plan_.rounds;
    plan.devices = {plan_.one_thread};
    const Result<PairsOutcome> outcome = measure(plan);
    if (!outcome) {
      return outcome.error();
    }
    const std::vector<ResultRow> rows = to_rows(outcome->series, plan.type);
    const struct {
      const char* precision;
      std::size_t count;
      double required;
    } wanted[] = {{"f32", 10, 1},      {"f64", 10, 1},      {"f32", 10000, 7},
                  {"f64", 10000, 3.5}, {"f32", 90000, 3.5}, {"f64", 90000, 1.75}};
    for (const auto& w : wanted) {
      if (const ResultRow* row = find_row(rows, {w.precision, 1, w.count})) {
        add(fmt::format("{} records, {} recorded real pairs: times faster than dCollide",
                        w.precision, w.count),
            row->speedup_vs_ode, row->speedup_range, w.required,
            fmt::format("harpoon bench pairs --device cpu --count {} --precision {}", w.count,
                        w.precision));
      }
    }
    return true;
  }

  Result<bool> cold_indexed() {
    constexpr double kRequired = 12;
    for (const PairType type : {PairType::real, PairType::mixed, PairType::fake}) {
      PairsPlan plan;
      plan.format = Format::indexed;
      plan.type = type;
      plan.f64 = false;
      plan.counts = {kMany};
      plan.rounds = plan_.rounds / 2 + 1;
      plan.devices = {plan_.one_thread};
      const Result<PairsOutcome> outcome = measure(plan);
      if (!outcome) {
        return outcome.error();
      }
      const std::vector<ResultRow> rows = to_rows(outcome->series, type);
      if (const ResultRow* row = find_row(rows, {"f32", 1, kMany})) {
        add(fmt::format("f32 indexed, {} spheres, {} random {} pairs: times faster than dCollide",
                        plan.indexed_spheres, kMany, to_string(type)),
            row->speedup_vs_ode, row->speedup_range, kRequired,
            fmt::format("harpoon bench pairs --device cpu --format indexed --type {} --count {} "
                        "--precision f32",
                        to_string(type), kMany));
      }
    }
    return true;
  }

  // Where both cores together reach the memory's limit, no more than that can be asked for: the
  // faster one thread is, the less a second one can add.
  Result<bool> two_threads() {
    constexpr double kRequired = 1.7;
    if (plan_.all_threads.threads < 2) {
      return true;
    }
    PairsPlan plan;
    plan.counts = {kInCaches, kMany};
    plan.f64 = false;
    plan.rounds = plan_.rounds;
    plan.devices = {plan_.one_thread, plan_.two_threads};
    plan.copy_threads = {2};
    const Result<PairsOutcome> outcome = measure(plan);
    if (!outcome) {
      return outcome.error();
    }
    const std::vector<ResultRow> rows = to_rows(outcome->series, plan.type);
    const double copy = to_copy_bandwidths(outcome->copy_series).front().best_gb_per_s();
    for (const std::size_t count : plan.counts) {
      const ResultRow* one = find_row(rows, {"f32", 1, count});
      const ResultRow* two = find_row(rows, {"f32", 2, count});
      if (one == nullptr || two == nullptr) {
        continue;
      }
      const double bandwidth_allows = kBandwidthShare * copy / one->gb_per_s();
      const bool bound = count == kMany && bandwidth_allows < kRequired;
      add(fmt::format("f32 records, {} pairs: two threads against one{}", count,
                      bound ? fmt::format(" (at {:.0f} % of {:.1f} GB/s of copying)",
                                          100 * kBandwidthShare, copy)
                            : ""),
          one->measured.ns.min / two->measured.ns.min,
          ratio_of(one->measured.ns.undisturbed(), two->measured.ns.undisturbed()),
          bound ? bandwidth_allows : kRequired,
          fmt::format("harpoon bench pairs --device cpu --count {} --precision f32 --threads 1,2 "
                      "--copy",
                      count));
    }
    return true;
  }

  Result<bool> bandwidth() {
    PairsPlan plan;
    plan.counts = {kBeyondCaches};
    plan.f64 = false;
    plan.rounds = plan_.rounds / 2 + 1;
    plan.devices = {plan_.one_thread};
    plan.copy_threads = {1};
    if (plan_.all_threads.threads > 1) {
      plan.devices.push_back(plan_.all_threads);
      plan.copy_threads.push_back(plan_.all_threads.threads);
    }
    const Result<PairsOutcome> outcome = measure(plan);
    if (!outcome) {
      return outcome.error();
    }
    const std::vector<ResultRow> rows = to_rows(outcome->series, plan.type);
    for (const CopyBandwidth& copy : to_copy_bandwidths(outcome->copy_series)) {
      if (const ResultRow* row = find_row(rows, {"f32", copy.threads, kBeyondCaches})) {
        add(fmt::format("f32 records, {} pairs, {} thread(s): share of the copy bandwidth, "
                        "{:.1f} GB/s",
                        kBeyondCaches, copy.threads, copy.best_gb_per_s()),
            row->gb_per_s() / copy.best_gb_per_s(), share_of(*row, copy), kBandwidthShare,
            fmt::format(
                "harpoon bench pairs --device cpu --count {} --precision f32 --threads {} --copy",
                kBeyondCaches, copy.threads));
      }
    }
    return true;
  }

  const TargetPlan& plan_;
  const ShareDone& share_done_;
  const Interrupted& interrupted_;
  int part_ = 0;
  std::vector<Target> targets_;
};

}  // namespace

Result<std::vector<Target>> check_targets(const TargetPlan& plan, const ShareDone& share_done,
                                          const Interrupted& interrupted) {
  return TargetCheck(plan, share_done, interrupted).run();
}

}  // namespace harpoon::bench
