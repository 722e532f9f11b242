#include "apps/claims.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "apps/figures.hpp"
#include "bench/results.hpp"
#include "bench/stats.hpp"

namespace harpoon::app {
namespace {

using bench::Range;

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

constexpr const char* kTooNoisy = "too noisy to say";
constexpr const char* kHolds = "holds";
constexpr const char* kDoesNotHold = "does not hold here";
/// A quotient whose ends are further apart is no number to print.
constexpr double kWide = 0.1;

Range last_ns(const bench::Series& series) {
  const bench::Measurement& last = series.points.back();
  const auto count = static_cast<double>(last.count);
  return {last.ns.undisturbed().low / count, last.ns.undisturbed().high / count};
}

// "8.1" or, where that is not sure, "8.1 to 9.4".
std::string shown(const Range& range, int digits) {
  const std::string low = fmt::format("{:.{}f}", range.low, digits);
  return range.width() <= kWide ? low : fmt::format("{} to {:.{}f}", low, range.high, digits);
}

// The series that the claims are about; none of the claims can be judged without the first four.
struct Evidence {
  const bench::Series& ode;
  const bench::Series& ode_figure5;
  const bench::Series& f32;
  const bench::Series& f64;
  const bench::Series* afu;  ///< null where there is no AFU
};

// How straight a series is: at its fastest times and at those that were seen again.
struct Straightness {
  double explained = 0;
  std::string verdict;
};

Straightness judge_straightness(const bench::Series& series) {
  constexpr double kStraight = 0.98;
  std::vector<double> counts;
  std::vector<double> fastest;
  std::vector<double> again;
  std::vector<double> unsure;
  for (const bench::Measurement& m : series.points) {
    const Range ns = m.ns.undisturbed();
    counts.push_back(static_cast<double>(m.count));
    fastest.push_back(ns.low);
    again.push_back(ns.high);
    unsure.push_back(ns.high - ns.low);
  }
  const bench::LineFit fit = bench::fit_line(counts, fastest);
  const bool straight = fit.explained >= kStraight;
  const bool straight_again = bench::fit_line(counts, again).explained >= kStraight;
  // What bends the line must be more than what the times themselves are unsure by.
  const bool bent = fit.residual > 2 * bench::quantile_of(unsure, 0.75);
  return {fit.explained, straight && straight_again             ? kHolds
                         : !straight && !straight_again && bent ? kDoesNotHold
                                                                : kTooNoisy};
}

Claim judge_linearity(const Evidence& figure7) {
  const Straightness ode = judge_straightness(figure7.ode);
  const Straightness f32 = judge_straightness(figure7.f32);
  std::string verdict = kHolds;
  for (const Straightness& one : {ode, f32}) {
    if (one.verdict != kHolds && verdict != kDoesNotHold) {
      verdict = one.verdict;
    }
  }
  return {"The time grows linearly with the number of collisions (Figures 6 and 7).",
          fmt::format("From {} to {} a straight line explains {:.2f} % of ODE's variation and "
                      "{:.2f} % of cpu f32's.",
                      figure7.ode.points.front().count, figure7.ode.points.back().count,
                      100 * ode.explained, 100 * f32.explained),
          verdict};
}

// "10.2 times less ..." unless the times leave that open.
std::string times_less(double paper_ns, const Range& ns, int digits, const char* rest) {
  return ns.width() > kWide ? kTooNoisy
                            : fmt::format("{:.{}f} times less {}", paper_ns / ns.low, digits, rest);
}

Claim judge_ode(const Evidence& figure7) {
  const Range batch = last_ns(figure7.ode);
  return {fmt::format("ODE takes {} ns for a real collision.", kPaperOdeNs),
          fmt::format("Stock dCollide takes {} ns as timed in Figure 5 and {} ns on the same "
                      "pairs as one batch.",
                      shown(last_ns(figure7.ode_figure5), 1), shown(batch, 1)),
          times_less(kPaperOdeNs, batch, 1, "on this machine")};
}

Claim judge_accelerator(const Evidence& figure7) {
  const Range f32 = last_ns(figure7.f32);
  std::string ours = fmt::format(
      "One thread of the cpu device takes {} ns in f32 and {} ns "
      "in f64.",
      shown(f32, 2), shown(last_ns(figure7.f64), 2));
  if (figure7.afu != nullptr) {
    ours += fmt::format(" Our AFU takes {} ns{}.", shown(last_ns(*figure7.afu), 1),
                        figure7.afu->label.modelled ? " (modelled)" : "");
  }
  return {fmt::format("The AFU with 10 SCPUs takes {} ns for a real collision.", kPaperAfuNs), ours,
          times_less(kPaperAfuNs, f32, 0, "without an FPGA")};
}

Claim judge_speedup(const Evidence& figure7) {
  constexpr double kPaperPercent = 14.5;
  const Range share = bench::ratio_of(last_ns(figure7.f32), last_ns(figure7.ode));
  const Range percent = {100 * (1 - share.high), 100 * (1 - share.low)};
  return {
      "The accelerator takes up to 14.5 % less time than ODE (the printed 86 and 102 ns give "
      "15.7 %).",
      fmt::format("cpu f32 takes {:.1f} % less time than ODE on the same {} pairs, in the same "
                  "run.",
                  100 * (1 - last_ns(figure7.f32).low / last_ns(figure7.ode).low),
                  figure7.ode.points.back().count),
      percent.low >= kPaperPercent   ? "exceeded"
      : percent.high < kPaperPercent ? "not reached here"
                                     : kTooNoisy};
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

std::string from_on(const BreakEven& found) {
  if (found.earliest == found.latest) {
    return fmt::format("from {} collisions on", *found.latest);
  }
  return found.latest ? fmt::format("from {} to {} collisions on", *found.earliest, *found.latest)
                      : fmt::format("from {} collisions on or not at all", *found.earliest);
}

// As found: the AFU's points are fewer, and its time is not measured but counted in cycles.
std::string afu_break_even(const Evidence& figure6, const Evidence& figure7) {
  const bench::Series afu = joined(*figure6.afu, *figure7.afu);
  const auto against = [&](const bench::Series& ode, const char* name) {
    const BreakEven found = break_even(afu, ode);
    return found.from ? fmt::format("ahead of {} {}", name, from_on(found))
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
  const BreakEven found = break_even(figure6.f32, figure6.ode);
  const auto verdict_at = [&](const std::optional<std::size_t>& count) {
    return !count                      ? "not reached here"
           : *count == found.first     ? "no break-even point"
           : *count <= kPaperBreakEven ? kHolds
                                       : kDoesNotHold;
  };
  if (found.mixed) {
    claim.ours = "cpu f32 is ahead of ODE at some counts and behind at others, again and again.";
    claim.verdict = kDoesNotHold;
  } else {
    claim.ours = !found.earliest
                     ? "cpu f32 does not stay ahead of ODE up to the last batch of Figure 6."
                 : found.latest == found.first
                     ? fmt::format("cpu f32 is ahead of ODE at every count, {}.", from_on(found))
                     : fmt::format("cpu f32 stays ahead of ODE {}.", from_on(found));
    const std::string verdict = verdict_at(found.earliest);
    claim.verdict = verdict == verdict_at(found.latest) ? verdict : kTooNoisy;
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

// One count at which two series were measured.
struct Meeting {
  std::size_t count;
  Range device;
  Range other;
};

// Where the meetings turn from behind to ahead: the place that leaves the fewest of them on the
// wrong side, so that a single count at which the machine did something else does not move it.
template <class Behind>
std::size_t last_step(const std::vector<Meeting>& meetings, const Behind& behind) {
  std::vector<std::ptrdiff_t> wrong(meetings.size() + 1, 0);
  wrong[0] = std::count_if(meetings.begin(), meetings.end(), behind);
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    wrong[i + 1] = wrong[i] + (behind(meetings[i]) ? -1 : 1);
  }
  return static_cast<std::size_t>(std::min_element(wrong.begin(), wrong.end()) - wrong.begin());
}

}  // namespace

BreakEven break_even(const bench::Series& device, const bench::Series& other) {
  std::vector<Meeting> meetings;
  auto rival = other.points.begin();
  for (const bench::Measurement& point : device.points) {
    rival = std::find_if(rival, other.points.end(),
                         [&](const bench::Measurement& m) { return m.count >= point.count; });
    if (rival != other.points.end() && rival->count == point.count) {
      meetings.push_back({point.count, point.ns.undisturbed(), rival->ns.undisturbed()});
    }
  }
  BreakEven found;
  if (meetings.empty()) {
    return found;
  }
  found.first = meetings.front().count;
  const auto count_at = [&](std::size_t step) -> std::optional<std::size_t> {
    return step == meetings.size() ? std::nullopt : std::optional(meetings[step].count);
  };
  const std::size_t step =
      last_step(meetings, [](const Meeting& m) { return m.device.low > m.other.low; });
  found.from = count_at(step);
  found.earliest = count_at(std::min(
      step, last_step(meetings, [](const Meeting& m) { return m.device.low > m.other.high; })));
  found.latest = count_at(std::max(
      step, last_step(meetings, [](const Meeting& m) { return m.device.high > m.other.low; })));
  std::size_t against = 0;
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    const Meeting& m = meetings[i];
    against += i < step ? m.device.high < m.other.low : m.device.low > m.other.high;
  }
  constexpr std::size_t kTolerated = 10;  // one in so many
  found.mixed = against > std::max<std::size_t>(1, meetings.size() / kTolerated);
  return found;
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
  for (Claim& claim : claims) {
    if (claim.verdict == kTooNoisy) {
      claim.ours += fmt::format(
          " The fastest times were not reached again: run `harpoon demo` on an idle machine{}.",
          experiment.quick ? ", without --quick" : "");
    }
  }
  return claims;
}

std::vector<std::string> report_notes(const Experiment& experiment) {
  std::vector<std::string> notes;
  notes.emplace_back(
      "The paper prints 2000 milliseconds of set-up. It must be nanoseconds: the break-even at 250 "
      "collisions is 250 x (102 - 86) ns = 4 us, two times 2000 ns.");
  notes.emplace_back(
      "The paper prints a speed-up of 14.5 %, for up to 1000 collisions; 102 to 86 ns per "
      "collision "
      "is 15.7 % less time.");
  notes.emplace_back(
      "hMax counts the shells of spheres around the centre one: |i| + |j| + |k| <= hMax.");
  notes.emplace_back(
      "Points and times are medians over runs, taken in rounds in which all series take turns; low "
      "and high are the 10th and 90th percentiles. ODE as Figure 5 executes each collision 10 "
      "times "
      "in the running world and adds the average; the clock's own time is taken out.");
  notes.emplace_back(
      "Verdicts, speed-ups and GB/s compare the fastest runs, which other programs on the machine "
      "cannot move; so they are not quotients of the medians beside them. A verdict is given when "
      "the fastest times were seen twice, close enough together.");
  notes.emplace_back(
      "Figure 6, Figure 7 and the table are three measurements, one after the other: the same "
      "batch "
      "can differ between them. Claims about one collision are judged at the last batch of Figure "
      "7, the break-even point by Figure 6.");
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
