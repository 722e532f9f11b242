// The parts that need ODE: the diamond world, the recorder, both ways of timing ODE, the oracle.

#include <gtest/gtest.h>

#include <cmath>

#include "bench/algorithm1.hpp"
#include "bench/fake_devices.hpp"
#include "bench/ode/cold.hpp"
#include "bench/ode/diamond.hpp"
#include "bench/ode/figure5.hpp"
#include "bench/ode/geom_set.hpp"
#include "bench/ode/oracle.hpp"
#include "bench/ode/pairs_bench.hpp"
#include "bench/ode/recorder.hpp"
#include "bench/ode/replay.hpp"
#include "bench/pair_cases.hpp"
#include "bench/results.hpp"

namespace harpoon::bench {
namespace {

std::unique_ptr<DiamondWorld> make_world(const DiamondParameters& parameters) {
  Result<std::unique_ptr<DiamondWorld>> world = DiamondWorld::create(parameters);
  EXPECT_TRUE(world) << world.error().message;
  return std::move(world.value());
}

double mean_distance(const DiamondWorld& world) {
  double sum = 0;
  for (const Point& p : world.positions()) {
    sum += std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
  }
  return sum / static_cast<double>(world.size());
}

DiamondParameters gapped() {
  DiamondParameters parameters;
  parameters.h_max = 2;
  parameters.d_sph = 0.1;
  return parameters;
}

TEST(DiamondWorld, SpheresMoveTowardTheCentreAndThenCollide) {
  const auto world = make_world(gapped());
  ASSERT_EQ(world->size(), 25U);
  const double start = mean_distance(*world);
  int hits_at_start = 0;
  world->step([&](const Candidate& c) { hits_at_start += c.flow == Flow::fake ? 0 : 1; });
  EXPECT_EQ(hits_at_start, 0);
  int hits_later = 0;
  for (int i = 0; i < 100; ++i) {
    world->step([&](const Candidate& c) { hits_later += c.flow == Flow::real ? 1 : 0; });
  }
  EXPECT_LT(mean_distance(*world), 0.9 * start);
  EXPECT_GT(hits_later, 100);
}

TEST(DiamondWorld, WithoutForceNothingMoves) {
  DiamondParameters parameters = gapped();
  parameters.force = 0;
  const auto world = make_world(parameters);
  const std::vector<Point> before = world->positions();
  for (int i = 0; i < 10; ++i) {
    world->step([](const Candidate&) {});
  }
  EXPECT_EQ(world->positions(), before);
}

TEST(DiamondWorld, ShowsOdesOwnContactOfEachCandidate) {
  const auto world = make_world({});
  int real = 0;
  int fake = 0;
  for (int i = 0; i < 50; ++i) {
    const std::vector<Point> positions = world->positions();
    world->step([&](const Candidate& c) {
      const Point& p = positions[c.spheres.g1];
      const Point& q = positions[c.spheres.g2];
      const ContactF64 expected =
          algorithm1(SpherePairF64{{p[0], p[1], p[2], 0.1}, {q[0], q[1], q[2], 0.1}});
      ASSERT_EQ(c.flow, expected.flow());
      ASSERT_EQ(c.contact == nullptr, c.flow == Flow::fake);
      if (c.contact != nullptr) {
        ASSERT_TRUE(same_bits(*c.contact, expected));
      }
      (c.flow == Flow::real ? real : fake) += 1;
    });
  }
  EXPECT_GT(real, 1000);
  EXPECT_GT(fake, 1000);
}

TEST(DiamondWorld, RefusesBadParametersByName) {
  const auto message = [](auto change) {
    DiamondParameters parameters;
    change(parameters);
    const auto world = DiamondWorld::create(parameters);
    EXPECT_FALSE(world);
    EXPECT_EQ(world.error().code, Errc::invalid_argument);
    return world.error().message;
  };
  EXPECT_NE(message([](auto& p) { p.h_max = 46; }).find("hmax is 46"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.d_sph = -1; }).find("dsph is -1"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.radius = 0; }).find("radius"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.force = NAN; }).find("force"), std::string::npos);
  EXPECT_NE(message([](auto& p) { p.time_step = INFINITY; }).find("time step"), std::string::npos);
}

class RecorderOfType : public testing::TestWithParam<PairType> {};

TEST_P(RecorderOfType, FindsTheTypeItClaims) {
  const Result<Recording> recording = record({}, GetParam(), 500);
  ASSERT_TRUE(recording) << recording.error().message;
  ASSERT_EQ(recording->pairs.size(), 500U);
  EXPECT_EQ(recording->constructed, GetParam() == PairType::grazing);
  EXPECT_GT(recording->census.real, 0U);
  EXPECT_GT(recording->census.fake, 0U);
  int flows[4] = {};
  for (const SpherePairF64& pair : to_records<double>(*recording, 500)) {
    const Flow flow = algorithm1(pair).flow();
    EXPECT_TRUE(matches(GetParam(), flow));
    ++flows[static_cast<int>(flow)];
  }
  if (GetParam() == PairType::mixed) {
    EXPECT_GT(flows[static_cast<int>(Flow::fake)], 50);
    EXPECT_GT(flows[static_cast<int>(Flow::real)], 50);
  }
}

INSTANTIATE_TEST_SUITE_P(Types, RecorderOfType,
                         testing::Values(PairType::fake, PairType::grazing, PairType::real,
                                         PairType::mixed),
                         [](const auto& type) { return std::string(to_string(type.param)); });

TEST(Recorder, FramesCoverAllPairsInOrder) {
  const Result<Recording> recording = record({}, PairType::real, 300);
  ASSERT_TRUE(recording);
  std::size_t next = 0;
  for (const Frame& frame : recording->frames) {
    EXPECT_EQ(frame.first_pair, next);
    EXPECT_GT(frame.pair_count, 0U);
    EXPECT_EQ(frame.positions.size(), 63U);
    next += frame.pair_count;
  }
  EXPECT_EQ(next, 300U);
}

TEST(Recorder, RecordsRepeatWhenMoreAreAsked) {
  const Result<Recording> recording = record({}, PairType::real, 50);
  ASSERT_TRUE(recording);
  const auto records = to_records<double>(*recording, 120);
  ASSERT_EQ(records.size(), 120U);
  EXPECT_EQ(records[7].s2.y, records[57].s2.y);
  EXPECT_EQ(records[19].s1.x, records[119].s1.x);
}

TEST(Recorder, SaysWhenTheTypeDoesNotOccur) {
  DiamondParameters apart = gapped();
  apart.h_max = 1;
  apart.force = 0;
  const Result<Recording> recording = record(apart, PairType::real, 1);
  ASSERT_FALSE(recording);
  EXPECT_NE(recording.error().message.find("no real pair"), std::string::npos);
}

TEST(Figure5, TotalsGrowWithTheCount) {
  const std::vector<std::size_t> counts = {10, 100, 1000};
  const Result<Figure5Run> run = time_as_figure5({}, PairType::real, counts);
  ASSERT_TRUE(run);
  ASSERT_EQ(run->total_ns.size(), 3U);
  EXPECT_GT(run->total_ns[1], run->total_ns[0]);
  EXPECT_GT(run->total_ns[2], run->total_ns[1]);
  EXPECT_GT(run->timer_overhead_ns, 0);
}

TEST(Figure5, RefusesATypeThatNeverHappens) {
  const std::vector<std::size_t> counts = {1};
  DiamondParameters small;
  small.h_max = 1;
  const Result<Figure5Run> run = time_as_figure5(small, PairType::grazing, counts);
  ASSERT_FALSE(run);
  EXPECT_NE(run.error().message.find("no grazing collision"), std::string::npos);
}

TEST(GeomSet, AnswersAsStockOdeForTheGivenPositions) {
  const IndexedScene scene = make_indexed_scene(PairType::mixed, 50, 400, 1);
  GeomSet geoms(scene.spheres);
  const auto hits = static_cast<std::size_t>(scene.hit_share * 400 + 0.5);
  EXPECT_EQ(collide_all(geoms, scene.pairs), hits);
  EXPECT_GT(hits, 100U);
  std::vector<Point> far_apart;
  for (int i = 0; i < 50; ++i) {
    far_apart.push_back({1.0 * i, 0, 0});
  }
  geoms.move(far_apart);
  EXPECT_EQ(collide_all(geoms, scene.pairs), 0U);
}

TEST(OdeContestants, TakeTimeForEveryCount) {
  const Result<Recording> recording = record({}, PairType::real, 500);
  ASSERT_TRUE(recording);
  const auto replay = make_ode_replay(*recording);
  const IndexedScene scene = make_indexed_scene(PairType::real, 50, 400, 1);
  const auto cold = make_ode_cold(scene);
  for (const std::size_t count : {1U, 10U, 400U}) {
    EXPECT_GT(summarize(replay->take_turn(count)->samples_ns).min, 0);
    EXPECT_GT(summarize(cold->take_turn(count)->samples_ns).min, 0);
  }
  EXPECT_GT(summarize(replay->take_turn(1200)->samples_ns).min,
            summarize(replay->take_turn(100)->samples_ns).min);
  EXPECT_EQ(replay->label().device, kOdeDevice);
}

TEST(OdeOracle, IsStockOdeAndAgreesWithAlgorithm1) {
  const Oracle oracle = make_ode_oracle();
  int flows[4] = {};
  for (const SpherePairF64& pair : hard_pairs<double>(5, 20000, true)) {
    const ContactF64 expected = algorithm1(pair);
    ASSERT_TRUE(same_bits(oracle.collide(pair), expected));
    ++flows[static_cast<int>(expected.flow())];
  }
  EXPECT_GT(flows[1], 1000);
  EXPECT_GT(flows[2], 1000);
  EXPECT_GT(flows[3], 1000);
}

PairsPlan small_plan() {
  PairsPlan plan;
  plan.counts = {10, 200};
  plan.rounds = 2;
  plan.devices = {{"plain", 1, std::make_shared<PlainDevice>()}};
  return plan;
}

TEST(PairsBench, ComparesOdeFigure5AndEachPrecisionAtEachCount) {
  PairsPlan plan = small_plan();
  plan.figure5 = true;
  double last_share = 0;
  const Result<PairsOutcome> outcome = run_pairs(plan, [&](double share) {
    EXPECT_GE(share, last_share);
    last_share = share;
  });
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(last_share, 1);
  ASSERT_EQ(outcome->series.size(), 4U);
  EXPECT_EQ(outcome->series[0].label.device, kOdeDevice);
  EXPECT_EQ(outcome->series[1].label.device, kOdeFigure5Device);
  EXPECT_EQ(outcome->series[2].label.precision, "f32");
  EXPECT_EQ(outcome->series[3].label.precision, "f64");
  for (const Series& series : outcome->series) {
    ASSERT_EQ(series.points.size(), 2U) << series.label.device;
    EXPECT_EQ(series.points[1].count, 200U);
    const bool is_figure5 = series.label.device == kOdeFigure5Device;
    EXPECT_EQ(series.points[1].ns.samples, is_figure5 ? 2U : 20U);
    EXPECT_GT(series.points[1].ns.median, 0);
  }
  EXPECT_TRUE(outcome->notes.empty());
  EXPECT_GT(outcome->census.candidates(), 200U);
}

TEST(PairsBench, SaysWhatIsConstructedRepeatedAndLeftOut) {
  PairsPlan plan = small_plan();
  plan.type = PairType::grazing;
  plan.figure5 = true;
  auto device = std::make_shared<PlainDevice>();
  device->capabilities_.f64 = false;
  plan.devices = {{"plain", 1, device}};
  const Result<PairsOutcome> outcome = run_pairs(plan);
  ASSERT_TRUE(outcome) << outcome.error().message;
  EXPECT_EQ(outcome->series.size(), 2U);  // ode, plain f32; Figure 5 cannot time grazing
  ASSERT_EQ(outcome->notes.size(), 2U);
  EXPECT_NE(outcome->notes[0].find("Grazing"), std::string::npos);
  EXPECT_NE(outcome->notes[1].find("plain does not do records in f64"), std::string::npos);
}

TEST(PairsBench, DoesArraysAndIndexed) {
  PairsPlan plan = small_plan();
  plan.format = Format::arrays;
  ASSERT_EQ(run_pairs(plan)->series.size(), 3U);
  plan.format = Format::indexed;
  plan.indexed_spheres = 100;
  const Result<PairsOutcome> outcome = run_pairs(plan);
  ASSERT_EQ(outcome->series.size(), 3U);
  EXPECT_EQ(outcome->series[2].label.format, "indexed");
  EXPECT_NE(outcome->notes.at(0).find("100 distinct spheres"), std::string::npos);
}

TEST(PairsBench, StopsAtItsTimeLimitAfterThreeRounds) {
  PairsPlan plan = small_plan();
  plan.rounds = 1000;
  plan.time_limit_s = 1e-9;
  EXPECT_EQ(run_pairs(plan)->series[0].points[0].ns.samples, 30U);
}

}  // namespace
}  // namespace harpoon::bench
