// Cycle counts as golden data. They are a function of the input, so they are compared exactly; a
// commit that changes one says why. The bounds are what the design promises.

#include "device/afu/rig.hpp"

namespace harpoon::afu_test {
namespace {

struct Measured {
  std::uint64_t cycles;
  afu::AfuReport report;
  std::uint32_t most_reads = 0;  // lines in flight at once
};

Measured run_pairs(const char* link, const std::vector<SpherePair>& pairs,
                   const afu::AfuOptions& options = {}) {
  const Rig rig = make_rig({*sim::parse_profile(link)}, options);
  std::vector<Contact> contacts(pairs.size());
  const auto outcome = rig.device->run(PairBatch<float>{pairs, contacts});
  EXPECT_TRUE(outcome.ok());
  EXPECT_EQ(first_wrong(pairs, contacts), -1);
  EXPECT_EQ(rig.link->model().breach(), "");
  return {rig.device->last_run().total_cycles, rig.device->last_run(),
          rig.link->model().counters().most_reads};
}

double per_pair(const Measured& run, std::size_t pairs) {
  return static_cast<double>(run.cycles) / static_cast<double>(pairs);
}

TEST(AfuCycles, EmptyBatchWithTheServiceOpen) {
  const Measured run = run_pairs("harp", {});
  EXPECT_LE(run.cycles, 400u);
  EXPECT_EQ(run.cycles, 376u);
}

TEST(AfuCycles, DirectNinetyThousandRealCollisions) {
  const Measured run = run_pairs("harp", pairs_with_hits(1, 90000, 1));
  EXPECT_LE(per_pair(run, 90000), 1.63);
  EXPECT_GT(run.report.link_occupancy, 0.99);
  EXPECT_EQ(run.most_reads, 64u);
  EXPECT_EQ(run.cycles, 144519u);
}

TEST(AfuCycles, DirectHitsOnlyHalfHits) {
  afu::AfuOptions options;
  options.hits_only = true;
  const Measured run = run_pairs("harp", pairs_with_hits(2, 90000, 0.5), options);
  EXPECT_LE(per_pair(run, 90000), 1.25);
  EXPECT_EQ(run.cycles, 108777u);
}

TEST(AfuCycles, IndexedTenPercentHits) {
  constexpr std::size_t kPairs = 1000000;
  const Rig rig = make_rig({profile("harp")});
  const auto scene = indexed_scene(3, 16384, kPairs, 0.1);
  const auto expected = expected_contacts(scene.spheres, scene.pairs);
  std::vector<BodyContact> contacts(expected.size());
  const auto outcome = rig.device->run(IndexedBatch<float>{scene.spheres, scene.pairs, contacts});
  ASSERT_TRUE(outcome.ok());
  EXPECT_TRUE(same_contacts(expected, contacts.data()));
  const Measured run{rig.device->last_run().total_cycles, rig.device->last_run()};
  EXPECT_LE(per_pair(run, kPairs), 0.20);
  EXPECT_EQ(run.cycles, 187557u);
}

// The published AFU: 4 lines in flight and a barrier per 10 pairs. It took 172 cycles a batch; ours
// waits for the link twice a batch (5 lines, 4 in flight) and for a deeper, exact pipeline.
TEST(AfuCycles, PublishedBehaviour) {
  afu::AfuOptions options;
  options.puc = {4, true};
  const Measured run = run_pairs("harp", pairs_with_hits(4, 1000, 1), options);
  EXPECT_EQ(run.cycles, 27046u);
  EXPECT_EQ(run.most_reads, 4u);
  EXPECT_GT(run.cycles, 10 * run_pairs("harp", pairs_with_hits(4, 1000, 1)).cycles);
}

TEST(AfuCycles, OtherLinks) {
  EXPECT_EQ(run_pairs("pcie3x16", pairs_with_hits(5, 20000, 1)).cycles, 37402u);
  const Measured f2 = run_pairs("f2", pairs_with_hits(5, 20000, 1));
  EXPECT_EQ(f2.cycles, 65146u);
  EXPECT_EQ(f2.most_reads, 32u);
}

}  // namespace
}  // namespace harpoon::afu_test
