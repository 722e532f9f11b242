#include "bench/round_robin.hpp"

#include <gtest/gtest.h>

#include "bench/contestant.hpp"

namespace harpoon::bench {
namespace {

// Takes 2 ns a pair, one more in every round, and notes its turns.
class Scripted final : public Contestant {
 public:
  Scripted(std::string name, std::vector<std::string>& log, bool modelled)
      : label_{std::move(name), "f32", 1, "records", modelled, 64}, log_(log) {}

  [[nodiscard]] const Label& label() const override { return label_; }
  Result<Turn> take_turn(std::size_t count) override {
    log_.push_back(label_.device + std::to_string(count));
    if (count == fail_at_) {
      return Error{Errc::device_fault, "It broke."};
    }
    return Turn{{2.0 * static_cast<double>(count) + turns_++}, 10};
  }

  std::size_t fail_at_ = 0;

 private:
  Label label_;
  std::vector<std::string>& log_;
  int turns_ = 0;
};

struct Two {
  std::vector<std::string> log;
  std::vector<std::unique_ptr<Contestant>> contestants;

  explicit Two(bool second_is_modelled = false) {
    contestants.push_back(std::make_unique<Scripted>("a", log, false));
    contestants.push_back(std::make_unique<Scripted>("b", log, second_is_modelled));
  }
};

TEST(RoundRobin, TakesTurnsWithinEveryCount) {
  Two two;
  RoundRobin robin(two.contestants, {1, 5});
  int ticks = 0;
  ASSERT_TRUE(robin.round([&] { ++ticks; }, {}));
  EXPECT_EQ(two.log, (std::vector<std::string>{"a1", "b1", "a5", "b5"}));
  EXPECT_EQ(ticks, 2);
}

TEST(RoundRobin, GivesTheMedianOverRoundsAndAllRuns) {
  Two two;
  RoundRobin robin(two.contestants, {100});
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(robin.round({}, {}));
  }
  const Measurement m = robin.series()[0].points[0];
  EXPECT_EQ(m.ns.median, 201);
  EXPECT_EQ(m.ns.min, 200);
  EXPECT_EQ(m.ns.samples, 3U);
  EXPECT_EQ(m.runs, 30U);
  EXPECT_DOUBLE_EQ(m.ns_per_pair(), 2.01);
}

TEST(RoundRobin, AModelledContestantRunsOnceAndOnFewCounts) {
  Two two(true);
  std::vector<std::size_t> counts;
  for (std::size_t i = 1; i <= 25; ++i) {
    counts.push_back(i * kFewModelledPairs / 10);
  }
  RoundRobin robin(two.contestants, counts);
  ASSERT_TRUE(robin.round({}, {}));
  ASSERT_TRUE(robin.round({}, {}));
  const std::vector<Series> series = robin.series();
  EXPECT_EQ(series[0].points.size(), 25U);
  ASSERT_EQ(series[1].points.size(), 13U);
  EXPECT_EQ(series[1].points[9].count, counts[9]);
  EXPECT_EQ(series[1].points[10].count, counts[10]);
  EXPECT_EQ(series[1].points[11].count, counts[20]);
  EXPECT_EQ(series[1].points[12].count, counts[24]);
  EXPECT_EQ(series[1].points[0].ns.samples, 1U);
}

TEST(RoundRobin, AModelledContestantIsSparedTheLargestBatches) {
  Two two(true);
  RoundRobin robin(two.contestants, {10, kMostModelledPairs, kMostModelledPairs + 1});
  ASSERT_TRUE(robin.round({}, {}));
  const std::vector<Series> series = robin.series();
  EXPECT_EQ(series[0].points.size(), 3U);
  ASSERT_EQ(series[1].points.size(), 1U);
  EXPECT_EQ(series[1].points[0].count, 10U);
}

TEST(RoundRobin, AnErrorNamesTheContestantAndTheCount) {
  Two two;
  dynamic_cast<Scripted&>(*two.contestants[1]).fail_at_ = 7;
  RoundRobin robin(two.contestants, {7});
  const Result<bool> done = robin.round({}, {});
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().code, Errc::device_fault);
  EXPECT_EQ(done.error().message, "Device b (f32, 7 pairs): It broke.");
}

TEST(RoundRobin, StopsWhenInterrupted) {
  Two two;
  RoundRobin robin(two.contestants, {1, 2, 3});
  ASSERT_TRUE(robin.round({}, [&] { return two.log.size() >= 3; }));
  EXPECT_EQ(two.log.size(), 3U);
}

TEST(TurnShape, ShortRunsAreAveragedAndLongOnesAreFew) {
  const TurnShape tiny = shape_turn(100);
  EXPECT_EQ(tiny.samples, 10U);
  EXPECT_EQ(tiny.runs_per_sample, 200U);
  EXPECT_EQ(shape_turn(1e6).samples, 10U);
  EXPECT_EQ(shape_turn(1e6).runs_per_sample, 1U);
  EXPECT_EQ(shape_turn(1e8).samples, 3U);
  EXPECT_EQ(shape_turn(0).runs_per_sample, 20000U);
}

TEST(TurnShape, ASampleIsTheTimeOfOneRun) {
  const auto turn = take_samples(
      100, [](std::uint64_t runs) -> Result<double> { return 7.0 * static_cast<double>(runs); });
  ASSERT_TRUE(turn);
  EXPECT_EQ(turn->samples_ns, std::vector<double>(10, 7.0));
  EXPECT_EQ(turn->runs, 2000U);
  const auto failed = take_samples(100, [](std::uint64_t) -> Result<double> {
    return Error{Errc::device_fault, "It broke."};
  });
  EXPECT_FALSE(failed);
}

}  // namespace
}  // namespace harpoon::bench
