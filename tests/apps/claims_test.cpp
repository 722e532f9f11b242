// The verdicts: right for numbers that are known, and never turned around by what else a machine
// does. Times are made up, sample by sample, as a machine of known speed would give them.

#include "apps/claims.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <random>

#include "apps/figures.hpp"
#include "bench/results.hpp"

namespace harpoon::app {
namespace {

constexpr const char* kTooNoisy = "too noisy to say";

// Nanoseconds of a batch.
using Time = std::function<double(double count)>;

Time line(double fixed_ns, double ns_per_pair) {
  return [=](double count) { return fixed_ns + ns_per_pair * count; };
}

// What a machine adds to a time.
struct Noise {
  double jitter = 0;      ///< up to this part of it, each sample
  double preempted = 0;   ///< share of samples in which another program runs
  double slow_turns = 0;  ///< share of turns in which all is slower, up to three times
  double slice_ns = 4e6;  ///< mean time that another program takes
};

constexpr Noise kIdle = {0.03, 0.002, 0};
// As beside two busy loops on each core.
constexpr Noise kBusy = {0.1, 0.35, 0.1};
constexpr Noise kHopeless = {0.5, 0.98, 1};

class Machine {
 public:
  Machine(std::uint64_t seed, const Noise& noise, unsigned rounds = 9)
      : engine_(seed), noise_(noise), rounds_(rounds) {}

  bench::Series series(const char* device, const char* precision,
                       const std::vector<std::size_t>& counts, const Time& time) {
    bench::Series s{{device, precision, 1, "records", false, 64}, {}};
    for (const std::size_t count : counts) {
      const std::vector<double> samples = samples_of(time(static_cast<double>(count)));
      s.points.push_back({count, bench::summarize(samples), samples.size()});
    }
    return s;
  }

  Experiment experiment(const Time& ode, const Time& f32,
                        const std::vector<std::size_t>& counts6 = figure6_counts(),
                        const std::vector<std::size_t>& counts7 = figure7_counts()) {
    const auto outcome = [&](const std::vector<std::size_t>& counts) {
      bench::PairsOutcome o;
      o.series = {series(bench::kOdeDevice, "f64", counts, ode),
                  series(bench::kOdeFigure5Device, "f64", counts, ode),
                  series("cpu", "f32", counts, f32), series("cpu", "f64", counts, f32)};
      o.census = {600, 0, 400};
      return o;
    };
    Experiment made;
    made.figure6 = outcome(counts6);
    made.figure7 = outcome(counts7);
    return made;
  }

 private:
  static constexpr int kSamplesOfATurn = 10;

  double uniform() { return std::uniform_real_distribution<double>(0, 1)(engine_); }

  std::vector<double> samples_of(double ns) {
    std::vector<double> samples;
    for (unsigned round = 0; round < rounds_; ++round) {
      const double slowness = uniform() < noise_.slow_turns ? 1 + 2 * uniform() : 1;
      for (int i = 0; i < kSamplesOfATurn; ++i) {
        double sample = ns * slowness * (1 + noise_.jitter * uniform());
        // The longer a sample lasts, the more likely another program's turn comes.
        if (uniform() < noise_.preempted) {
          sample += std::exponential_distribution<double>(1 / noise_.slice_ns)(engine_);
        }
        samples.push_back(sample);
      }
    }
    return samples;
  }

  std::mt19937_64 engine_;
  Noise noise_;
  unsigned rounds_;
};

enum Which { kLinear, kOde, kAccelerator, kSpeedup, kBreakEvenPoint, kGrazing };

std::vector<std::string> verdicts(const Experiment& experiment) {
  std::vector<std::string> all;
  for (const Claim& claim : judge_claims(experiment)) {
    all.push_back(claim.verdict);
  }
  return all;
}

bench::Series plain(const char* device, double fixed_ns, double ns_per_pair,
                    const std::vector<std::size_t>& counts) {
  return Machine(1, {}, 1).series(device, "f32", counts, line(fixed_ns, ns_per_pair));
}

TEST(BreakEven, IsWhereTheDeviceStaysAhead) {
  const bench::Series ode = plain("ode", 0, 10, {10, 20, 30, 40});
  EXPECT_EQ(break_even(plain("cpu", 0, 1, {10, 20, 30, 40}), ode).from, 10U);
  EXPECT_EQ(break_even(plain("cpu", 250, 1, {10, 20, 30, 40}), ode).from, 30U);
  EXPECT_FALSE(break_even(plain("cpu", 0, 11, {10, 20, 30, 40}), ode).from);
  EXPECT_EQ(break_even(plain("afu", 150, 1, {10, 30, 40}), ode).from, 30U);
  EXPECT_FALSE(break_even(plain("afu", 0, 1, {11, 12}), ode).from);
}

TEST(BreakEven, IsNotMovedByOneCountThatWasDisturbed) {
  const bench::Series ode = plain("ode", 0, 10, figure6_counts());
  bench::Series cpu = plain("cpu", 450, 1, figure6_counts());
  bench::Summary& disturbed = cpu.points[80].ns;
  disturbed.min *= 100;
  disturbed.min_again *= 100;
  const BreakEven found = break_even(cpu, ode);
  EXPECT_EQ(found.from, 50U);
  EXPECT_EQ(found.earliest, found.latest);
  EXPECT_FALSE(found.mixed);
}

TEST(BreakEven, IsNowhereWhereADeviceIsAheadAndBehindByTurns) {
  const bench::Series ode = plain("ode", 0, 10, figure6_counts());
  bench::Series cpu = plain("cpu", 0, 1, figure6_counts());
  for (std::size_t i = 0; i < cpu.points.size(); i += 3) {
    cpu.points[i].ns.min *= 100;
    cpu.points[i].ns.min_again *= 100;
  }
  EXPECT_TRUE(break_even(cpu, ode).mixed);
}

TEST(BreakEven, IsARangeWhereTimesAreUnsure) {
  const bench::Series ode = plain("ode", 0, 10, figure6_counts());
  bench::Series cpu = plain("cpu", 450, 1, figure6_counts());
  for (bench::Measurement& m : cpu.points) {
    m.ns.min_again += 450;
  }
  const BreakEven found = break_even(cpu, ode);
  EXPECT_EQ(found.from, 50U);
  EXPECT_EQ(found.earliest, 50U);
  EXPECT_EQ(found.latest, 100U);
}

TEST(Claims, VerdictsFollowFromTheNumbers) {
  const Experiment experiment = Machine(1, {}).experiment(line(0, 10), line(450, 1));
  const std::vector<Claim> claims = judge_claims(experiment);
  ASSERT_EQ(claims.size(), 6U);
  EXPECT_EQ(claims[kLinear].verdict, "holds");
  EXPECT_EQ(claims[kOde].verdict, "10.2 times less on this machine");
  EXPECT_EQ(claims[kSpeedup].verdict, "exceeded");
  EXPECT_EQ(claims[kBreakEvenPoint].verdict, "holds");
  EXPECT_NE(claims[kBreakEvenPoint].ours.find("from 50 collisions"), std::string::npos)
      << claims[kBreakEvenPoint].ours;
  EXPECT_EQ(claims[kGrazing].verdict, "holds");
  EXPECT_NE(claims[kGrazing].ours.find("0 of 1000"), std::string::npos);
}

TEST(Claims, NameOurAfuAndThatItIsModelled) {
  Experiment experiment = Machine(1, {}).experiment(line(0, 10), line(450, 1));
  EXPECT_EQ(judge_claims(experiment)[kAccelerator].ours.find("Our AFU"), std::string::npos);
  bench::Series afu = plain("afu", 0, 8, {1000, 90000});
  afu.label.modelled = true;
  experiment.figure7.series.push_back(afu);
  EXPECT_NE(judge_claims(experiment)[kAccelerator].ours.find("Our AFU takes 8.0 ns (modelled)."),
            std::string::npos);
}

TEST(Claims, StateTheBreakEvenOfOurAfuAsFound) {
  Experiment experiment = Machine(1, {}).experiment(line(0, 10), line(450, 1));
  EXPECT_EQ(judge_claims(experiment)[kBreakEvenPoint].ours.find("Our AFU"), std::string::npos);
  bench::Series afu = plain("afu", 1600, 8, {10, 110, 510, 900, 1000});
  afu.label.modelled = true;
  experiment.figure6.series.push_back(afu);
  experiment.figure7.series.push_back(plain("afu", 1600, 8, {1000, 2000, 12000, 90000}));
  const auto as_figure5 = [&](double ns_per_pair) {
    for (auto* figure : {&experiment.figure6, &experiment.figure7}) {
      std::vector<std::size_t> counts;
      for (const bench::Measurement& m : figure->series[1].points) {
        counts.push_back(m.count);
      }
      figure->series[1] =
          Machine(1, {}).series(bench::kOdeFigure5Device, "f64", counts, line(0, ns_per_pair));
    }
  };
  as_figure5(9);
  const std::string ours = judge_claims(experiment)[kBreakEvenPoint].ours;
  EXPECT_NE(ours.find("Our AFU (modelled) is ahead of ODE as timed in Figure 5 from 2000 "
                      "collisions on, and ahead of ODE as one batch from 900 collisions on."),
            std::string::npos)
      << ours;
  as_figure5(7);
  EXPECT_NE(judge_claims(experiment)[kBreakEvenPoint].ours.find(
                "not ahead of ODE as timed in Figure 5 at 90000"),
            std::string::npos);
}

TEST(Claims, AreNotWonByDefault) {
  const Time curve = [](double count) { return 20 * count * (1 + count / 30000); };
  Experiment slow = Machine(1, {}).experiment(line(0, 10), curve);
  slow.figure7.census = {10, 5, 5};
  const std::vector<std::string> all = verdicts(slow);
  EXPECT_EQ(all[kLinear], "does not hold here");
  EXPECT_EQ(all[kSpeedup], "not reached here");
  EXPECT_EQ(all[kBreakEvenPoint], "not reached here");
  EXPECT_EQ(all[kGrazing], "does not hold here");
}

TEST(Claims, OfABusyMachineAreThoseOfAnIdleOne) {
  for (const Noise& noise : {kIdle, kBusy}) {
    const std::vector<std::string> all =
        verdicts(Machine(2, noise).experiment(line(0, 10), line(450, 1)));
    EXPECT_EQ(all[kLinear], "holds");
    EXPECT_EQ(all[kSpeedup], "exceeded");
    EXPECT_EQ(all[kBreakEvenPoint], "holds");
  }
}

TEST(Claims, ThatAreViolatedAreSeenToBeOnABusyMachine) {
  const Time curve = [](double count) { return 5 * count * (1 + count / 30000); };
  const Time steps = [](double count) { return count * (count > 45000 ? 6.0 : 1.0); };
  for (const Noise& noise : {kIdle, kBusy}) {
    Machine machine(3, noise);
    EXPECT_EQ(verdicts(machine.experiment(line(0, 10), curve))[kLinear], "does not hold here");
    EXPECT_EQ(verdicts(machine.experiment(line(0, 10), steps))[kLinear], "does not hold here");
    const std::vector<std::string> late = verdicts(machine.experiment(line(0, 10), line(4500, 1)));
    EXPECT_EQ(late[kBreakEvenPoint], "does not hold here");
    const std::vector<std::string> slow = verdicts(machine.experiment(line(0, 10), line(0, 12)));
    EXPECT_EQ(slow[kSpeedup], "not reached here");
    EXPECT_EQ(slow[kBreakEvenPoint], "not reached here");
  }
}

TEST(Claims, OfAHopelessRunAreTooNoisyAndSayWhatToDo) {
  Experiment experiment = Machine(4, kHopeless, 3).experiment(line(0, 10), line(0, 8));
  experiment.quick = true;
  bool found = false;
  for (const Claim& claim : judge_claims(experiment)) {
    if (claim.verdict == kTooNoisy) {
      found = true;
      EXPECT_NE(claim.ours.find("run `harpoon demo` on an idle machine, without --quick"),
                std::string::npos)
          << claim.ours;
    }
  }
  EXPECT_TRUE(found);
}

// The verdicts that follow from the speeds themselves.
struct Truth {
  std::string speedup;
  std::string break_even;
};

std::optional<Truth> truth_of(double ode_ns, double fixed_ns, double f32_ns) {
  const double at_90000 = (fixed_ns + f32_ns * 90000) / (ode_ns * 90000);
  const double percent = 100 * (1 - at_90000);
  const double crossing = f32_ns < ode_ns ? fixed_ns / (ode_ns - f32_ns) : 1e9;
  const auto is_near = [](double value, double border) {
    return std::abs(value / border - 1) < 0.25;
  };
  if (std::abs(percent - 14.5) < 5 || std::abs(f32_ns / ode_ns - 1) < 0.1 ||
      is_near(crossing, 10) || is_near(crossing, 250) || is_near(crossing, 1000)) {
    return std::nullopt;  // too close to a border for any statistics
  }
  return Truth{percent >= 14.5 ? "exceeded" : "not reached here",
               crossing <= 10     ? "no break-even point"
               : crossing <= 250  ? "holds"
               : crossing <= 1000 ? "does not hold here"
                                  : "not reached here"};
}

TEST(Claims, AreNeverTurnedAroundByNoise) {
  std::mt19937_64 engine(5);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine);
  };
  const auto few = [](const std::vector<std::size_t>& all) {
    std::vector<std::size_t> some;
    for (std::size_t i = 0; i < all.size(); i += 4) {
      some.push_back(all[i]);
    }
    return some;
  };
  std::map<std::string, int> seen;
  int judged = 0;
  int given_up = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const double ode_ns = uniform(5, 20);
    const double fixed_ns = std::exp(uniform(0, 10));
    const double f32_ns = uniform(0.5, 25);
    const std::optional<Truth> truth = truth_of(ode_ns, fixed_ns, f32_ns);
    if (!truth) {
      continue;
    }
    const Noise noise = {uniform(0, 0.1), uniform(0, 0.6), uniform(0, 0.3)};
    const std::uint64_t seed = engine();
    const std::vector<std::string> all =
        verdicts(Machine(seed, noise, 5)
                     .experiment(line(0, ode_ns), line(fixed_ns, f32_ns), few(figure6_counts()),
                                 few(figure7_counts())));
    const std::string what = ::testing::PrintToString(std::tuple(
        seed, ode_ns, fixed_ns, f32_ns, noise.jitter, noise.preempted, noise.slow_turns));
    const std::pair<std::string, std::string> pairs[] = {{all[kLinear], "holds"},
                                                         {all[kSpeedup], truth->speedup},
                                                         {all[kBreakEvenPoint], truth->break_even}};
    for (const auto& [verdict, right] : pairs) {
      ++judged;
      if (verdict == kTooNoisy) {
        ++given_up;
      } else {
        EXPECT_EQ(verdict, right) << what;
      }
    }
    ++seen[truth->speedup];
    ++seen[truth->break_even];
  }
  for (const char* verdict :
       {"exceeded", "not reached here", "no break-even point", "holds", "does not hold here"}) {
    EXPECT_GT(seen[verdict], 5) << verdict;
  }
  EXPECT_LT(given_up, judged / 10);
}

}  // namespace
}  // namespace harpoon::app
