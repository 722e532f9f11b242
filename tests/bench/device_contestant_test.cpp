#include "bench/device_contestant.hpp"

#include <gtest/gtest.h>

#include "bench/copy_bandwidth.hpp"
#include "bench/fake_devices.hpp"
#include "bench/pair_cases.hpp"
#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

constexpr std::uint64_t kSeed = 3;

NamedDevice plain_device(bool modelled = false) {
  auto device = std::make_shared<PlainDevice>();
  device->capabilities_.modelled = modelled;
  return {"plain", 2, device};
}

TEST(DeviceContestant, ReallyRunsTheBatchOfRecords) {
  const auto memory = std::make_shared<PairMemory<float>>(hard_pairs<float>(kSeed, 64, true));
  const auto contestant = make_records_contestant<float>(plain_device(), memory);
  const Result<Turn> turn = contestant->take_turn(40);
  ASSERT_TRUE(turn);
  EXPECT_EQ(turn->samples_ns.size(), 10U);
  EXPECT_GT(turn->samples_ns.front(), 0);
  EXPECT_GE(turn->runs, 10U);
  EXPECT_NE(memory->contacts[39].flow_word, 0U);
  EXPECT_EQ(memory->contacts[40].flow_word, 0U);
  EXPECT_EQ(contestant->label().bytes_per_pair, 64);
  EXPECT_EQ(contestant->label().precision, "f32");
  EXPECT_EQ(contestant->label().threads, 2U);
}

TEST(DeviceContestant, ReallyRunsArraysAndIndexed) {
  const auto pairs = hard_pairs<double>(kSeed, 64, true);
  const auto arrays = std::make_shared<ArrayMemory<double>>(pairs);
  ASSERT_TRUE(make_arrays_contestant<double>(plain_device(), arrays)->take_turn(64));
  const PairArraysBatch<double> batch = arrays->batch(64);
  EXPECT_EQ(batch.pairs.r2[63], pairs[63].s2.r);
  EXPECT_EQ(batch.contacts.flow[2], static_cast<std::uint64_t>(Flow::fake));

  const IndexedScene scene = make_indexed_scene(PairType::real, 10, 64, kSeed);
  const auto contestant = make_indexed_contestant<float>(plain_device(), scene);
  ASSERT_TRUE(contestant->take_turn(64));
  EXPECT_EQ(contestant->label().bytes_per_pair, 8 + 36);
}

TEST(DeviceContestant, AModelledDeviceTellsItsOwnTime) {
  const auto memory = std::make_shared<PairMemory<float>>(hard_pairs<float>(kSeed, 64, true));
  const auto contestant = make_records_contestant<float>(plain_device(true), memory);
  const Result<Turn> turn = contestant->take_turn(64);
  ASSERT_TRUE(turn);
  EXPECT_EQ(turn->samples_ns, std::vector<double>{320});
  EXPECT_EQ(turn->runs, 1U);
  EXPECT_TRUE(contestant->label().modelled);
}

TEST(DeviceContestant, SupportsWhatTheCapabilitiesSay) {
  Capabilities f32_records;
  f32_records.f32 = true;
  f32_records.pair_batches = true;
  EXPECT_TRUE(supports(f32_records, Format::records, false));
  EXPECT_FALSE(supports(f32_records, Format::records, true));
  EXPECT_FALSE(supports(f32_records, Format::arrays, false));
  EXPECT_FALSE(supports(f32_records, Format::indexed, false));
  EXPECT_EQ(parse_format("indexed"), Format::indexed);
  EXPECT_FALSE(parse_format("soa"));
}

TEST(CopyBandwidth, CopiesEveryByteWhateverTheSizeAlignmentAndThreads) {
  std::vector<std::byte> source(5000);
  for (std::size_t i = 0; i < source.size(); ++i) {
    source[i] = static_cast<std::byte>(i * 7 + 1);
  }
  for (const CopyMethod method : {CopyMethod::library, CopyMethod::non_temporal}) {
    for (const unsigned threads : {1U, 2U, 3U}) {
      for (const std::size_t size : {0U, 1U, 63U, 64U, 65U, 1000U, 4900U}) {
        for (const std::size_t offset : {0U, 1U, 33U}) {
          std::vector<std::byte> target(source.size(), std::byte{0});
          copy_with(method, std::span(source).subspan(offset, size),
                    std::span(target).subspan(offset, size), threads);
          for (std::size_t i = 0; i < target.size(); ++i) {
            const bool copied = i >= offset && i < offset + size;
            ASSERT_EQ(target[i], copied ? source[i] : std::byte{0})
                << "byte " << i << " of " << size << " at " << offset << ", threads " << threads;
          }
        }
      }
    }
  }
}

TEST(CopyBandwidth, ATurnTakesTime) {
  std::vector<std::byte> source(1 << 16, std::byte{1});
  std::vector<std::byte> target(source.size());
  const auto copy = make_copy_contestant(CopyMethod::library, source, target, 1);
  const Result<Turn> turn = copy->take_turn(2048);
  ASSERT_TRUE(turn);
  EXPECT_GT(turn->samples_ns.front(), 0);
  EXPECT_EQ(target.back(), std::byte{1});
}

TEST(Timer, TheClocksOwnTimeIsSmallAndNotNegative) {
  const double overhead = measure_timer_overhead_ns();
  EXPECT_GE(overhead, 0);
  EXPECT_LT(overhead, 1e5);
}

}  // namespace
}  // namespace harpoon::bench
