// Bit-exact with the scalar collider: 10^6 pairs over 100 seeds of random latency, order and
// back-pressure, in all formats, and never a breach of the AXI rules.

#include <algorithm>
#include <array>

#include "device/afu/rig.hpp"

namespace harpoon::afu_test {
namespace {

constexpr std::size_t kSeeds = 100;
constexpr std::size_t kPairs = 10000;
constexpr std::size_t kDevices = 20;  // a device takes several seeds, one after the other

sim::LinkNoise noise_of(std::uint64_t seed) {
  return {seed, static_cast<std::uint32_t>(seed * 37 % 200),
          static_cast<std::uint32_t>(seed % 3) * 20};
}

std::array<std::size_t, 4> flows_of(const std::vector<Contact>& contacts) {
  std::array<std::size_t, 4> flows{};
  for (const Contact& contact : contacts) ++flows[contact.flow_word & 3];
  return flows;
}

void run_pairs(const Rig& rig, std::uint64_t seed) {
  const auto pairs = any_pairs(seed, kPairs);
  std::vector<Contact> contacts(kPairs);
  const auto outcome = rig.device->run(PairBatch<float>{pairs, contacts});
  ASSERT_TRUE(outcome.ok()) << "seed " << seed << ": " << outcome.error().message;
  ASSERT_EQ(first_wrong(pairs, contacts), -1) << "seed " << seed;
  const auto flows = flows_of(contacts);
  EXPECT_TRUE(flows[1] > 100 && flows[2] > 100 && flows[3] > 100) << "a flow was not reached";
}

void run_indexed(const Rig& rig, std::uint64_t seed) {
  const auto pairs = any_pairs(seed, 4000);
  std::vector<Sphere> spheres;
  for (const SpherePair& pair : pairs) spheres.insert(spheres.end(), {pair.s1, pair.s2});
  std::mt19937_64 random(seed);
  std::vector<IndexPair> indices(kPairs);
  for (IndexPair& pair : indices) {
    const auto any = [&] { return static_cast<std::uint32_t>(random() % spheres.size()); };
    pair = {any(), any()};
    if (random() % 2 == 0) pair.g2 = pair.g1 ^ 1u;
  }
  const auto expected = expected_contacts(spheres, indices);
  ASSERT_GT(expected.size(), 1000u);
  std::vector<BodyContact> contacts(kPairs);
  const auto outcome = rig.device->run(IndexedBatch<float>{spheres, indices, contacts});
  ASSERT_TRUE(outcome.ok()) << "seed " << seed << ": " << outcome.error().message;
  ASSERT_EQ(outcome->hits, expected.size()) << "seed " << seed;
  ASSERT_TRUE(same_contacts(expected, contacts.data())) << "seed " << seed;
}

TEST(AfuExact, MillionPairsInAllFormatsOverAnyLink) {
  for (std::size_t device = 0; device < kDevices; ++device) {
    const char* const link = device % 4 == 3 ? "f2" : "harp,in_flight=64";
    afu::AfuOptions options;
    options.hits_only = device % 2 == 1;
    options.workspace_bytes = std::uint64_t{8} << 20;
    options.timeouts.transaction_us = 2000;
    if (device % 5 == 4) options.transaction_pairs = 3333;
    const Rig rig = make_rig({*sim::parse_profile(link), noise_of(device), device, {}}, options);
    for (std::size_t seed = device; seed < kSeeds; seed += kDevices) {
      if (seed / kDevices % 5 < 3) {
        run_pairs(rig, seed);
      } else {
        run_indexed(rig, seed);
      }
      if (HasFatalFailure()) return;
    }
    EXPECT_EQ(rig.link->model().breach(), "");
    EXPECT_EQ(rig.link->model().counters().stray_reads, 0u);
    EXPECT_EQ(rig.link->model().counters().stray_writes, 0u);
  }
}

}  // namespace
}  // namespace harpoon::afu_test
