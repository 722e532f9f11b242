#include "apps/report_headlines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "apps/claims.hpp"

namespace harpoon::app {
namespace {

using Rows = std::vector<const bench::ResultRow*>;

// 12345, 864, 86.4, 1.06.
std::string three_digits(double number) {
  return fmt::format("{:.{}f}", number, number >= 99.95 ? 0 : number >= 9.995 ? 1 : 2);
}

// "8.61" or, where that is not sure, "8.61 to 12.2".
std::string shown(const bench::Range& range) {
  constexpr double kWide = 0.1;
  return range.width() <= kWide
             ? three_digits(range.low)
             : fmt::format("{} to {}", three_digits(range.low), three_digits(range.high));
}

std::string batch_of(const bench::ResultRow& row) {
  return fmt::format("{} {} collisions", row.measured.count, to_string(row.type));
}

std::string device_of(const bench::ResultRow& row) {
  return fmt::format("{} {}", row.label.device, row.label.precision);
}

bool same_contestant(const bench::ResultRow& a, const bench::ResultRow& b) {
  return a.label.device == b.label.device && a.label.precision == b.label.precision &&
         a.label.threads == b.label.threads;
}

bool fits_in_cache(const bench::ResultRow& row, double cache_mb) {
  return row.megabytes() <= cache_mb;
}

template <class Score>
const bench::ResultRow* best_of(const Rows& rows, const Score& score) {
  const auto best = std::max_element(rows.begin(), rows.end(), [&](const auto* a, const auto* b) {
    return score(*a) < score(*b);
  });
  return best == rows.end() ? nullptr : *best;
}

// Where the best batch fits in the caches: that it does, and what the same device reaches beyond.
template <class Value>
std::string cache_note(const bench::ResultRow& best, const bench::ResultSet& results,
                       const Value& value) {
  const double cache_mb = results.machine.cache_mb;
  if (best.label.modelled || !fits_in_cache(best, cache_mb)) {
    return "";
  }
  std::string note = fmt::format(". These {} MB fit in the cache of {} MB",
                                 three_digits(best.megabytes()), three_digits(cache_mb));
  const bench::ResultRow* beyond = nullptr;
  for (const bench::ResultRow& row : results.rows) {
    if (same_contestant(row, best) && !fits_in_cache(row, cache_mb)) {
      beyond = &row;
    }
  }
  return note +
         (beyond == nullptr
              ? "; nothing larger was measured"
              : fmt::format("; from memory ({} collisions, {} MB): {}", beyond->measured.count,
                            three_digits(beyond->megabytes()), value(*beyond)));
}

std::optional<Headline> speedup(const Rows& rows, const std::string& label,
                                const bench::ResultSet& results) {
  const bench::ResultRow* best =
      best_of(rows, [](const bench::ResultRow& row) { return row.speedup_vs_ode; });
  if (best == nullptr || best->speedup_vs_ode <= 0) {
    return std::nullopt;
  }
  const double ns = best->fastest_ns_per_pair();
  const auto times = [](const bench::ResultRow& row) { return shown(row.speedup_range) + "×"; };
  return Headline{
      times(*best), label,
      fmt::format("{}, {}: {} ns against ODE's {} ns in the fastest runs{}", device_of(*best),
                  batch_of(*best), three_digits(ns), three_digits(ns * best->speedup_vs_ode),
                  cache_note(*best, results, times)),
      best->label.modelled};
}

std::optional<Headline> throughput(const Rows& rows, const bench::ResultSet& results) {
  const bench::ResultRow* best =
      best_of(rows, [](const bench::ResultRow& row) { return row.gb_per_s(); });
  if (best == nullptr || best->gb_per_s() <= 0) {
    return std::nullopt;
  }
  const auto rate = [](const bench::ResultRow& row) {
    const double fastest = row.gb_per_s();
    return shown({fastest / (1 + row.measured.ns.undisturbed().width()), fastest}) + " GB/s";
  };
  return Headline{rate(*best), "highest throughput of records",
                  fmt::format("{}, {} thread{}, {}{}", device_of(*best), best->label.threads,
                              best->label.threads == 1 ? "" : "s", batch_of(*best),
                              cache_note(*best, results, rate)),
                  false};
}

std::optional<Headline> break_even_point(const Experiment& experiment) {
  const auto find = [&](const char* device, const char* precision) -> const bench::Series* {
    for (const bench::Series& series : experiment.figure6.series) {
      if (series.label.device == device && series.label.precision == precision) {
        return &series;
      }
    }
    return nullptr;
  };
  const bench::Series* ode = find(bench::kOdeDevice, "f64");
  const bench::Series* f32 = find("cpu", "f32");
  if (ode == nullptr || f32 == nullptr) {
    return std::nullopt;
  }
  const BreakEven found = break_even(*f32, *ode);
  if (!found.earliest || !found.latest || found.mixed) {
    return std::nullopt;
  }
  const bool is_first = found.latest == found.first;
  const std::string value = found.earliest == found.latest
                                ? fmt::format("{}{}", is_first ? "≤ " : "", *found.latest)
                                : fmt::format("{} to {}", *found.earliest, *found.latest);
  return Headline{value, "collisions to break even with ODE",
                  fmt::format("cpu f32 takes no longer than ODE from {} batch of Figure 6 on, in "
                              "the fastest runs; these batches fit in the cache",
                              is_first ? "the smallest" : "this"),
                  false};
}

}  // namespace

std::vector<Headline> headlines(const Experiment& experiment, const bench::ResultSet& results) {
  Rows measured;
  Rows single;
  Rows several;
  Rows modelled;
  for (const bench::ResultRow& row : results.rows) {
    if (row.label.device == bench::kOdeDevice || row.label.device == bench::kOdeFigure5Device) {
      continue;
    }
    if (row.label.modelled) {
      modelled.push_back(&row);
      continue;
    }
    measured.push_back(&row);
    (row.label.threads == 1 ? single : several).push_back(&row);
  }
  const bench::ResultRow* widest =
      best_of(several, [](const bench::ResultRow& row) { return row.speedup_vs_ode; });
  const unsigned threads = widest == nullptr ? 0 : widest->label.threads;
  std::vector<Headline> all;
  for (const std::optional<Headline>& one :
       {speedup(single, "faster than ODE on one thread", results),
        speedup(several, fmt::format("faster than ODE on {} threads", threads), results),
        break_even_point(experiment), throughput(measured, results),
        speedup(modelled, "faster than ODE, modelled", results)}) {
    if (one) {
      all.push_back(*one);
    }
  }
  return all;
}

}  // namespace harpoon::app
