// The AFU as a device: the same bits as everywhere, batches of every size and format, and errors
// that leave it ready for the next batch.

#include "device/afu/device.hpp"

#include "device/afu/rig.hpp"

namespace harpoon::afu {
namespace {

using afu_test::make_rig;
using afu_test::profile;
using afu_test::Rig;

AfuOptions small_transactions(std::uint64_t pairs) {
  AfuOptions options;
  options.transaction_pairs = pairs;
  options.workspace_bytes = std::uint64_t{4} << 20;
  return options;
}

TEST(AfuDevice, SaysWhatItIs) {
  const Rig rig = make_rig({profile("harp")});
  EXPECT_EQ(rig.device->name(), "afu");
  const Capabilities& can = rig.device->capabilities();
  EXPECT_TRUE(can.f32 && can.pair_batches && can.indexed_batches && can.modelled);
  EXPECT_FALSE(can.f64 || can.array_batches);
  EXPECT_NE(can.description.find("10 SCPUs at 200 MHz"), std::string::npos) << can.description;
}

TEST(AfuDevice, GivesTheBitsOfTheScalarCollider) {
  for (const bool hits_only : {false, true}) {
    AfuOptions options = small_transactions(0);
    options.hits_only = hits_only;
    const Rig rig = make_rig({profile("harp")}, options);
    for (const std::size_t count : {0, 1, 2, 3, 19, 20, 21, 500}) {
      const auto pairs = afu_test::any_pairs(count, count);
      std::vector<Contact> contacts(count + 1);
      contacts.back().depth = -1;
      const auto outcome = rig.device->run(PairBatch<float>{pairs, contacts});
      ASSERT_TRUE(outcome.ok()) << outcome.error().message;
      EXPECT_EQ(afu_test::first_wrong(pairs, contacts), -1) << count << " pairs";
      EXPECT_EQ(contacts.back().depth, -1) << "wrote beyond the batch";
      EXPECT_EQ(outcome->pairs, count);
      ASSERT_TRUE(outcome->modelled_ns.has_value());
      EXPECT_EQ(*outcome->modelled_ns,
                static_cast<double>(rig.device->last_run().total_cycles) * 5);
    }
  }
}

TEST(AfuDevice, CutsLargeBatches) {
  for (const bool hits_only : {false, true}) {
    AfuOptions options = small_transactions(300);
    options.hits_only = hits_only;
    const Rig rig = make_rig({profile("harp")}, options);
    const auto pairs = afu_test::any_pairs(11, 1000);
    std::vector<Contact> contacts(1000);
    ASSERT_TRUE(rig.device->run(PairBatch<float>{pairs, contacts}).ok());
    EXPECT_EQ(afu_test::first_wrong(pairs, contacts), -1);
    EXPECT_EQ(rig.device->last_run().transactions, 4u);
  }
}

TEST(AfuDevice, FindsIndexedContacts) {
  const Rig rig = make_rig({profile("harp")}, small_transactions(700));
  const auto scene = afu_test::indexed_scene(3, 1000, 2000, 0.2);
  const auto expected = afu_test::expected_contacts(scene.spheres, scene.pairs);
  ASSERT_GT(expected.size(), 300u);
  std::vector<BodyContact> contacts(expected.size());
  const auto outcome = rig.device->run(IndexedBatch<float>{scene.spheres, scene.pairs, contacts});
  ASSERT_TRUE(outcome.ok()) << outcome.error().message;
  EXPECT_EQ(outcome->hits, expected.size());
  EXPECT_TRUE(afu_test::same_contacts(expected, contacts.data()));
  EXPECT_EQ(rig.device->last_run().transactions, 3u);
}

TEST(AfuDevice, TakesMoreSpheresThanItsTableHolds) {
  const Rig rig = make_rig({profile("harp")});
  const auto scene = afu_test::indexed_scene(4, 50000, 12000, 0.3);
  const auto expected = afu_test::expected_contacts(scene.spheres, scene.pairs);
  std::vector<BodyContact> contacts(expected.size());
  const auto outcome = rig.device->run(IndexedBatch<float>{scene.spheres, scene.pairs, contacts});
  ASSERT_TRUE(outcome.ok()) << outcome.error().message;
  EXPECT_TRUE(afu_test::same_contacts(expected, contacts.data()));
  EXPECT_GE(rig.device->last_run().transactions, 2u);
}

TEST(AfuDevice, SaysHowManyContactsThereAre) {
  const Rig rig = make_rig({profile("harp")}, small_transactions(0));
  const auto scene = afu_test::indexed_scene(5, 100, 400, 0.5);
  const auto expected = afu_test::expected_contacts(scene.spheres, scene.pairs);
  std::vector<BodyContact> contacts(10);
  const auto outcome = rig.device->run(IndexedBatch<float>{scene.spheres, scene.pairs, contacts});
  ASSERT_FALSE(outcome.ok());
  EXPECT_EQ(outcome.error().code, Errc::capacity);
  EXPECT_EQ(outcome.error().needed, expected.size());
  const std::vector<BodyContact> first(expected.begin(), expected.begin() + 10);
  EXPECT_TRUE(afu_test::same_contacts(first, contacts.data()));
}

TEST(AfuDevice, RefusesWhatItCannotDo) {
  const Rig rig = make_rig({profile("harp")}, small_transactions(0));
  const std::vector<Sphere> spheres(3);
  const std::vector<IndexPair> pairs{{0, 1}, {1, 3}};
  std::vector<BodyContact> contacts(2);
  const auto index = rig.device->run(IndexedBatch<float>{spheres, pairs, contacts});
  ASSERT_FALSE(index.ok());
  EXPECT_EQ(index.error().code, Errc::invalid_index);

  const std::vector<SpherePairF64> doubles(1);
  std::vector<ContactF64> out(1);
  const auto f64 = rig.device->run(PairBatch<double>{doubles, out});
  ASSERT_FALSE(f64.ok());
  EXPECT_EQ(f64.error().code, Errc::unsupported);

  const std::vector<SpherePair> two(2);
  std::vector<Contact> one(1);
  const auto room = rig.device->run(PairBatch<float>{two, one});
  ASSERT_FALSE(room.ok());
  EXPECT_EQ(room.error().code, Errc::capacity);
}

TEST(AfuDevice, RefusesANullLinkAndAHugeWorkspace) {
  EXPECT_EQ(make_afu_device(nullptr).error().code, Errc::invalid_argument);
  AfuOptions options;
  options.workspace_bytes = contract::kMaxWorkspaceBytes + 1;
  auto link = sim::SimulatedLink::create({profile("harp")});
  ASSERT_TRUE(link.ok());
  EXPECT_EQ(make_afu_device(std::move(*link), options).error().code, Errc::invalid_argument);
}

// A limit that suits one link ends every batch on another.
TEST(AfuDevice, WaitsAsLongAsTheSlowestLinkTakes) {
  for (const char* link : {"harp,latency_ns=5000", "harp,latency_ns=100000,write_latency_ns=100000",
                           "harp,gbps=0.1", "harp,clock_mhz=1", "f2,in_flight=1,latency_ns=20000",
                           "pcie3x16,clock_mhz=2000,gbps=0.1"}) {
    for (const bool as_published : {false, true}) {
      AfuOptions options;
      if (as_published) options.puc = {4, true};
      Rig rig = make_rig({*sim::parse_profile(link)}, options);
      const auto pairs = afu_test::any_pairs(5, 333);
      std::vector<Contact> contacts(333);
      const auto outcome = rig.device->run(PairBatch<float>{pairs, contacts});
      ASSERT_TRUE(outcome.ok()) << link << ": " << outcome.error().message;
      EXPECT_EQ(afu_test::first_wrong(pairs, contacts), -1) << link;
    }
  }
}

TEST(AfuDevice, FallsBackToTheCpuWithNothingLost) {
  AfuOptions options = small_transactions(100);
  options.timeouts.transaction_us = 30;
  Rig rig = make_rig({profile("harp")}, options);
  auto cpu = make_cpu_device();
  ASSERT_TRUE(cpu.ok());
  std::vector<std::string> said;
  FallbackDevice device(std::move(rig.device), std::move(*cpu),
                        [&](LogLevel, std::string_view line) { said.emplace_back(line); });
  const auto pairs = afu_test::any_pairs(21, 350);
  for (int round = 0; round < 3; ++round) {
    // The second of four transactions loses a result line, or the device hangs in the third.
    rig.link->model().arm(round == 0 ? sim::Fault{sim::FaultKind::drop_write, 70, 0}
                                     : sim::Fault{sim::FaultKind::hang, 2000, 0});
    std::vector<Contact> contacts(350);
    ASSERT_TRUE(device.run(PairBatch<float>{pairs, contacts}).ok());
    EXPECT_EQ(afu_test::first_wrong(pairs, contacts), -1);
    EXPECT_EQ(device.fallbacks(), static_cast<std::uint64_t>(round + 1));
  }
  EXPECT_EQ(said.size(), 1u) << "a fallback is said once";
  rig.link->model().arm({});
  std::vector<Contact> contacts(350);
  ASSERT_TRUE(device.run(PairBatch<float>{pairs, contacts}).ok());
  EXPECT_EQ(device.fallbacks(), 3u) << "the AFU did not come back after its reset";
}

}  // namespace
}  // namespace harpoon::afu
