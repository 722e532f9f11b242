// The simulated AFU as a whole: time, repeatability, waveform.

#include "sim/simulated_link.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "device/afu/rig.hpp"

namespace harpoon::sim {
namespace {

using afu_test::make_rig;
using afu_test::profile;

TEST(SimulatedLink, TimeAdvancesOnlyWhenAsked) {
  auto link = afu_test::take(SimulatedLink::create({profile("harp")}));
  const std::uint64_t begin = link->now();
  auto memory = link->allocate(100);
  ASSERT_TRUE(memory.ok());
  link->release(*memory);
  EXPECT_EQ(link->now(), begin);
  link->advance(17);
  EXPECT_EQ(link->now(), begin + 17);
  link->write_register(afu::contract::kRegInFlight, 5);
  EXPECT_EQ(link->now(), begin + 17 + 4) << "20 ns at 200 MHz";
  EXPECT_EQ(link->read_register(afu::contract::kRegInFlight), 5u);
}

TEST(SimulatedLink, TheSameSeedGivesTheSameCycles) {
  std::vector<std::uint64_t> cycles;
  for (const std::uint64_t seed : {1u, 1u, 2u}) {
    const auto rig = make_rig({profile("harp"), {seed, 60, 20}, 1, {}});
    const auto pairs = afu_test::any_pairs(1, 400);
    std::vector<Contact> contacts(400);
    ASSERT_TRUE(rig.device->run(PairBatch<float>{pairs, contacts}).ok());
    cycles.push_back(rig.device->last_run().total_cycles);
  }
  EXPECT_EQ(cycles[0], cycles[1]);
  EXPECT_NE(cycles[0], cycles[2]);
}

// A program may hold several at once and let them go in any order.
TEST(SimulatedLink, SeveralEndInAnyOrder) {
  for (const bool first_goes_first : {true, false}) {
    auto first = afu_test::take(SimulatedLink::create({profile("harp")}));
    auto second = afu_test::take(SimulatedLink::create({profile("f2")}));
    auto& goes = first_goes_first ? first : second;
    auto& stays = first_goes_first ? second : first;
    goes.reset();
    stays->advance(10);
    stays.reset();
  }
}

TEST(SimulatedLink, GivesAWaveformPieceByPiece) {
  std::string text;
  {
    const auto rig =
        make_rig({profile("harp"), {}, 1, [&](std::string_view piece) { text += piece; }});
    const auto pairs = afu_test::any_pairs(1, 2);
    std::vector<Contact> contacts(2);
    ASSERT_TRUE(rig.device->run(PairBatch<float>{pairs, contacts}).ok());
  }
  EXPECT_NE(text.find("$enddefinitions"), std::string::npos);
  EXPECT_NE(text.find("araddr"), std::string::npos);
  EXPECT_NE(text.find("\n#40000\n"), std::string::npos)
      << "cycle 8 of 5 ns, the first after two resets";
}

TEST(SimulatedLink, RefusesALinkThatNoProfileDescribes) {
  LinkProfile never = profile("harp");
  never.gigabytes_per_s = 0;
  const auto link = SimulatedLink::create({.profile = never});
  ASSERT_FALSE(link.ok());
  EXPECT_EQ(link.error().code, Errc::invalid_argument);
}

}  // namespace
}  // namespace harpoon::sim
