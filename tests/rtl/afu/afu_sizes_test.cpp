// The AFU with N SCPUs, HARPOON_SCPUS of this build: says so, is bit-exact in all formats over any
// link, and decides N index pairs a cycle where the link brings them.

#include <algorithm>
#include <array>

#include "device/afu/rig.hpp"

namespace harpoon::afu_test {
namespace {

constexpr std::uint32_t kScpus = HARPOON_SCPUS;

constexpr const char* kWideLink = "harp,gbps=200,shared=0,latency_ns=200";

TEST(AfuSizes, SaysHowManyScpusItHas) {
  const Rig rig = make_rig({profile("harp")});
  std::vector<Contact> none;
  ASSERT_TRUE(rig.device->run(PairBatch<float>{{}, none}).ok());
  EXPECT_EQ(rig.device->last_run().identity.scpus, kScpus);
  EXPECT_EQ(rig.device->last_run().identity.lanes, kScpus);
  const std::string expected = std::to_string(kScpus) + " SCPUs at 200 MHz";
  EXPECT_NE(rig.device->capabilities().description.find(expected), std::string::npos);
}

TEST(AfuSizes, IsExactInEveryFormatOverAnyLink) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const auto jitter = static_cast<std::uint32_t>(seed * 71 % 200);
    const auto pressure = static_cast<std::uint32_t>(seed % 3 * 20);
    afu::AfuOptions options;
    options.workspace_bytes = std::uint64_t{4} << 20;
    options.timeouts.transaction_us = 2000;
    options.hits_only = seed % 2 == 1;
    options.puc.batch_barrier = seed == 5;
    const char* const link = seed == 4 ? kWideLink : "harp";
    const Rig rig =
        make_rig({*sim::parse_profile(link), {seed, jitter, pressure}, seed, {}}, options);

    const auto pairs = any_pairs(seed, 1001 + seed);
    std::vector<Contact> contacts(pairs.size());
    const auto direct = rig.device->run(PairBatch<float>{pairs, contacts});
    ASSERT_TRUE(direct.ok()) << "seed " << seed << ": " << direct.error().message;
    EXPECT_EQ(first_wrong(pairs, contacts), -1) << "seed " << seed;

    const auto scene = indexed_scene(seed, 300, 995 + 7 * seed, 0.1 + 0.15 * double(seed));
    const auto expected = expected_contacts(scene.spheres, scene.pairs);
    std::vector<BodyContact> hits(scene.pairs.size());
    const auto indexed = rig.device->run(IndexedBatch<float>{scene.spheres, scene.pairs, hits});
    ASSERT_TRUE(indexed.ok()) << "seed " << seed << ": " << indexed.error().message;
    EXPECT_EQ(indexed->hits, expected.size()) << "seed " << seed;
    EXPECT_TRUE(same_contacts(expected, hits.data())) << "seed " << seed;
    EXPECT_EQ(rig.link->model().breach(), "");
  }
}

// Results that leave so slowly that every queue before them fills up, and a workspace of two pages.
TEST(AfuSizes, IsExactWhereTheLinkHardlyTakesResults) {
  const Rig slow = make_rig({*sim::parse_profile("harp,in_flight=2,write_latency_ns=1000")});
  const auto scene = indexed_scene(8, 300, 1500, 0.95);
  const auto expected = expected_contacts(scene.spheres, scene.pairs);
  std::vector<BodyContact> hits(scene.pairs.size());
  const auto indexed = slow.device->run(IndexedBatch<float>{scene.spheres, scene.pairs, hits});
  ASSERT_TRUE(indexed.ok()) << indexed.error().message;
  EXPECT_TRUE(same_contacts(expected, hits.data()));

  const Rig rig = make_rig({profile("harp")});
  const auto pairs = pairs_with_hits(9, 40000, 0.5);
  std::vector<Contact> contacts(pairs.size());
  ASSERT_TRUE(rig.device->run(PairBatch<float>{pairs, contacts}).ok());
  EXPECT_EQ(first_wrong(pairs, contacts), -1);
}

// Index pairs of which none hits; a link that brings a line of 16 almost every cycle.
TEST(AfuSizes, DecidesAPairAnScpuAndCycle) {
  constexpr std::size_t kPairs = 40000;
  const Rig rig = make_rig({*sim::parse_profile(kWideLink)});
  const auto scene = indexed_scene(1, 64, kPairs, 0);
  std::vector<BodyContact> none;
  ASSERT_TRUE(rig.device->run(IndexedBatch<float>{scene.spheres, scene.pairs, none}).ok());
  const auto cycles = static_cast<double>(rig.device->last_run().counters.cycles);
  constexpr double kLinkPairs = 15.9;  // the most that comes: a line a cycle
  const double per_cycle = kPairs / cycles;
  RecordProperty("pairs_per_cycle", std::to_string(per_cycle));
  EXPECT_GT(per_cycle, 0.93 * std::min<double>(kScpus, kLinkPairs));
  EXPECT_LE(per_cycle, kScpus);
}

// Golden, as in afu_cycles_test.cpp: one SCPU already keeps the link of the harp profile full.
TEST(AfuSizes, TakesTheseCycles) {
  struct Golden {
    std::uint32_t scpus;
    std::uint64_t direct, indexed;
  };
  constexpr std::array kGolden{Golden{1, 8516, 20901}, Golden{2, 8516, 10901},
                               Golden{4, 8516, 5917},  Golden{6, 8516, 4440},
                               Golden{10, 8516, 4372}, Golden{16, 8516, 4339}};
  const auto golden = std::find_if(kGolden.begin(), kGolden.end(),
                                   [](const Golden& g) { return g.scpus == kScpus; });
  ASSERT_NE(golden, kGolden.end());
  const Rig rig = make_rig({profile("harp")});
  const auto pairs = pairs_with_hits(1, 5000, 0.5);
  std::vector<Contact> contacts(pairs.size());
  ASSERT_TRUE(rig.device->run(PairBatch<float>{pairs, contacts}).ok());
  EXPECT_EQ(rig.device->last_run().total_cycles, golden->direct);
  const auto scene = indexed_scene(2, 500, 20000, 0.1);
  std::vector<BodyContact> hits(scene.pairs.size());
  ASSERT_TRUE(rig.device->run(IndexedBatch<float>{scene.spheres, scene.pairs, hits}).ok());
  EXPECT_EQ(rig.device->last_run().total_cycles, golden->indexed);
}

}  // namespace
}  // namespace harpoon::afu_test
