#include "apps/claims.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/figures.hpp"
#include "bench/results.hpp"
#include "bench/stats.hpp"

namespace harpoon::app {
namespace {

const bench::Series* find_series(const std::vector<bench::Series>& all, const std::string& device,
                                 const std::string& precision) {
  for (const bench::Series& series : all) {
    if (series.label.device == device && series.label.precision == precision &&
        !series.points.empty()) {
      return &series;
    }
  }
  return nullptr;
}

double r_squared(const bench::Series& series) {
  std::vector<double> counts;
  std::vector<double> totals;
  for (const bench::Measurement& m : series.points) {
    counts.push_back(static_cast<double>(m.count));
    totals.push_back(m.ns.median);
  }
  return bench::fit_line(counts, totals).r_squared;
}

double last_ns(const bench::Series& series) {
  return series.points.back().ns_per_pair();
}

// The series that the claims are about; none of the claims can be judged without the first four.
struct Evidence {
  const bench::Series& ode;
  const bench::Series& ode_figure5;
  const bench::Series& f32;
  const bench::Series& f64;
  const bench::Series* afu;  ///< null where there is no AFU
};

Claim judge_linearity(const Evidence& figure7) {
  constexpr double kStraight = 0.98;
  const double ode = r_squared(figure7.ode);
  const double f32 = r_squared(figure7.f32);
  return {"The time grows linearly with the number of collisions (Figures 6 and 7).",
          fmt::format("From 1000 to 90000 a straight line explains {:.2f} % of ODE's variation and "
                      "{:.2f} % of cpu f32's.",
                      100 * ode, 100 * f32),
          ode >= kStraight && f32 >= kStraight ? "holds" : "does not hold here"};
}

Claim judge_ode(const Evidence& figure7) {
  const double batch = last_ns(figure7.ode);
  return {
      fmt::format("ODE takes {} ns for a real collision.", kPaperOdeNs),
      fmt::format("Stock dCollide takes {:.1f} ns as timed in Figure 5 and {:.1f} ns on the same "
                  "pairs as one batch.",
                  last_ns(figure7.ode_figure5), batch),
      fmt::format("{:.1f} times less on this machine", kPaperOdeNs / batch)};
}

Claim judge_accelerator(const Evidence& figure7) {
  const double f32 = last_ns(figure7.f32);
  std::string ours = fmt::format(
      "One thread of the cpu device takes {:.2f} ns in f32 and {:.2f} ns "
      "in f64.",
      f32, last_ns(figure7.f64));
  if (figure7.afu != nullptr) {
    ours += fmt::format(" Our AFU takes {:.1f} ns{}.", last_ns(*figure7.afu),
                        figure7.afu->label.modelled ? " (modelled)" : "");
  }
  return {fmt::format("The AFU with 10 SCPUs takes {} ns for a real collision.", kPaperAfuNs), ours,
          fmt::format("{:.0f} times less, without an FPGA", kPaperAfuNs / f32)};
}

Claim judge_speedup(const Evidence& figure7) {
  constexpr double kPaperPercent = 14.5;
  const double percent = 100 * (1 - last_ns(figure7.f32) / last_ns(figure7.ode));
  return {
      "The accelerator takes up to 14.5 % less time than ODE (the printed 86 and 102 ns give "
      "15.7 %).",
      fmt::format("cpu f32 takes {:.1f} % less time than ODE on the same 90000 pairs, in the same "
                  "run.",
                  percent),
      percent >= kPaperPercent ? "exceeded" : "not reached here"};
}

// Figure 7's points after Figure 6's, but for the counts that both have.
bench::Series joined(const bench::Series& figure6, const bench::Series& figure7) {
  bench::Series both = figure6;
  for (const bench::Measurement& point : figure7.points) {
    if (point.count > both.points.back().count) {
      both.points.push_back(point);
    }
  }
  return both;
}

// As found: the AFU's points are fewer, and its time is not measured but counted in cycles.
std::string afu_break_even(const Evidence& figure6, const Evidence& figure7) {
  const bench::Series afu = joined(*figure6.afu, *figure7.afu);
  const auto against = [&](const bench::Series& ode, const char* name) {
    const auto count = break_even(afu, ode);
    return count ? fmt::format("ahead of {} from {} collisions on", name, *count)
                 : fmt::format("not ahead of {} at {}", name, afu.points.back().count);
  };
  return fmt::format(
      "Our AFU{} is {}, and {}.", afu.label.modelled ? " (modelled)" : "",
      against(joined(figure6.ode_figure5, figure7.ode_figure5), "ODE as timed in Figure 5"),
      against(joined(figure6.ode, figure7.ode), "ODE as one batch"));
}

Claim judge_break_even(const Evidence& figure6, const std::optional<Evidence>& figure7) {
  Claim claim{fmt::format("Above {} collisions the accelerator is always better, because of 2000 "
                          "milliseconds (which must be nanoseconds) of set-up.",
                          kPaperBreakEven),
              "", ""};
  const auto count = break_even(figure6.f32, figure6.ode);
  if (!count) {
    claim.ours = "cpu f32 does not stay ahead of ODE up to the last batch of Figure 6.";
    claim.verdict = "not reached here";
  } else if (*count == figure6.f32.points.front().count) {
    claim.ours =
        fmt::format("cpu f32 is ahead of ODE at every count, from {} collisions on.", *count);
    claim.verdict = "no break-even point";
  } else {
    claim.ours = fmt::format("cpu f32 stays ahead of ODE from {} collisions on.", *count);
    claim.verdict = *count <= kPaperBreakEven ? "holds" : "does not hold here";
  }
  if (figure6.afu != nullptr && figure7 && figure7->afu != nullptr) {
    claim.ours.append(" ").append(afu_break_even(figure6, *figure7));
  }
  return claim;
}

Claim judge_grazing(const bench::Census& census) {
  constexpr double kRare = 1e-3;
  const auto candidates = static_cast<double>(census.candidates());
  const bool is_rare = static_cast<double>(census.grazing) <= kRare * candidates;
  return {"A grazing collision almost never happens.",
          fmt::format("{} of {} candidate pairs of the diamond were grazing, {} fake, {} real.",
                      census.grazing, census.candidates(), census.fake, census.real),
          is_rare ? "holds" : "does not hold here"};
}

}  // namespace

std::optional<std::size_t> break_even(const bench::Series& device, const bench::Series& other) {
  std::optional<std::size_t> from;
  auto rival = other.points.begin();
  for (const bench::Measurement& point : device.points) {
    rival = std::find_if(rival, other.points.end(),
                         [&](const bench::Measurement& m) { return m.count >= point.count; });
    if (rival == other.points.end() || rival->count != point.count) {
      continue;
    }
    if (point.ns.median > rival->ns.median) {
      from.reset();
    } else if (!from) {
      from = point.count;
    }
  }
  return from;
}

std::vector<Claim> judge_claims(const Experiment& experiment) {
  const auto evidence_of = [](const bench::PairsOutcome& figure) -> std::optional<Evidence> {
    const bench::Series* ode = find_series(figure.series, bench::kOdeDevice, "f64");
    const bench::Series* ode5 = find_series(figure.series, bench::kOdeFigure5Device, "f64");
    const bench::Series* f32 = find_series(figure.series, "cpu", "f32");
    const bench::Series* f64 = find_series(figure.series, "cpu", "f64");
    if (ode == nullptr || ode5 == nullptr || f32 == nullptr || f64 == nullptr) {
      return std::nullopt;
    }
    return Evidence{*ode, *ode5, *f32, *f64, find_series(figure.series, "afu", "f32")};
  };
  std::vector<Claim> claims;
  const auto figure6 = evidence_of(experiment.figure6);
  const auto figure7 = evidence_of(experiment.figure7);
  if (figure7) {
    claims.push_back(judge_linearity(*figure7));
    claims.push_back(judge_ode(*figure7));
    claims.push_back(judge_accelerator(*figure7));
    claims.push_back(judge_speedup(*figure7));
  }
  if (figure6) {
    claims.push_back(judge_break_even(*figure6, figure7));
  }
  claims.push_back(judge_grazing(experiment.figure7.census));
  return claims;
}

std::vector<std::string> report_notes(const Experiment& experiment) {
  std::vector<std::string> notes = {
      "The paper prints 2000 milliseconds of set-up. It must be nanoseconds: the break-even at 250 "
      "collisions is 250 x (102 - 86) ns = 4 us, two times 2000 ns.",
      "The paper prints a speed-up of 14.5 %, for up to 1000 collisions; 102 to 86 ns per "
      "collision "
      "is 15.7 % less time.",
      "hMax counts the shells of spheres around the centre one: |i| + |j| + |k| <= hMax.",
      "Points are medians over runs, taken in rounds in which all series take turns; low and high "
      "are the 10th "
      "and "
      "90th percentiles. ODE as Figure 5 executes each collision 10 times in the running world and "
      "adds the average; the clock's own time is taken out."};
  std::uint64_t pairs = 0;
  for (const bench::SelftestCheck& check : experiment.checks) {
    pairs += check.pairs;
  }
  notes.push_back(
      experiment.contacts_are_right()
          ? fmt::format("All {} contacts compared with plain Algorithm 1 are equal bit for bit.",
                        pairs)
          : "SOME CONTACTS DIFFER from plain Algorithm 1: run `harpoon selftest`.");
  return notes;
}

}  // namespace harpoon::app
