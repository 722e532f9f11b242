// 1,000 seeds of injected faults: every run ends in time, with the exact result or with a typed
// error, after which cpu gives the exact result and the AFU works again.

#include <array>

#include "device/afu/rig.hpp"

namespace harpoon::afu_test {
namespace {

constexpr std::uint64_t kSeeds = 1000;
constexpr std::uint64_t kDevices = 10;

struct Tally {
  std::array<int, sim::kFaultKinds> struck{}, failed{}, exact{};
};

sim::Fault any_fault(std::mt19937_64& random) {
  const auto kind = static_cast<sim::FaultKind>(1 + random() % (sim::kFaultKinds - 1));
  const bool cycles = kind == sim::FaultKind::hang || kind == sim::FaultKind::reset;
  const bool always = kind == sim::FaultKind::page_fault || kind == sim::FaultKind::wrong_afu_id;
  return {kind, always ? 0 : random() % (cycles ? 900 : 60), random() % 2000};
}

afu::AfuOptions options_of(std::uint64_t device) {
  afu::AfuOptions options;
  options.workspace_bytes = std::uint64_t{2} << 20;
  options.timeouts.identify_us = 10;
  options.timeouts.transaction_us = 20;
  options.hits_only = device % 2 == 1;
  options.transaction_pairs = device % 3 == 0 ? 40 : 0;
  return options;
}

/// Longest that any run may take: opening, every transaction up to its deadline, the errors' reads.
constexpr std::uint64_t kDeadlineCycles = 40000;

/// Runs one batch; true when the AFU gave the exact result, false when it gave a typed error.
bool run_exactly(const Rig& rig, std::uint64_t seed, bool indexed) {
  const std::uint64_t begin = rig.link->now();
  Result<Outcome> outcome = Outcome{};
  bool right = true;
  if (indexed) {
    const auto scene = indexed_scene(seed, 64, 40 + seed % 150, 0.4);
    const auto expected = expected_contacts(scene.spheres, scene.pairs);
    std::vector<BodyContact> contacts(scene.pairs.size());
    outcome = rig.device->run(IndexedBatch<float>{scene.spheres, scene.pairs, contacts});
    if (outcome)
      right = outcome->hits == expected.size() && same_contacts(expected, contacts.data());
  } else {
    const auto pairs = any_pairs(seed, 1 + seed % 100);
    std::vector<Contact> contacts(pairs.size());
    outcome = rig.device->run(PairBatch<float>{pairs, contacts});
    if (outcome) right = first_wrong(pairs, contacts) == -1;
  }
  EXPECT_TRUE(right) << "seed " << seed << ": a wrong result without an error";
  EXPECT_LT(rig.link->now() - begin, kDeadlineCycles) << "seed " << seed;
  if (outcome) return true;
  const Error& error = outcome.error();
  EXPECT_TRUE(error.code == Errc::device_timeout || error.code == Errc::device_fault)
      << "seed " << seed << ": " << error.message;
  EXPECT_FALSE(error.message.empty());
  return false;
}

TEST(AfuFaults, EveryRunEndsExactOrWithATypedError) {
  Tally tally;
  for (std::uint64_t device = 0; device < kDevices; ++device) {
    const sim::LinkNoise noise{device, device % 2 == 0 ? 0u : 50u, device % 4 == 3 ? 30u : 0u};
    const Rig rig = make_rig({profile("harp"), noise, device + 1, {}}, options_of(device));
    for (std::uint64_t seed = device; seed < kSeeds; seed += kDevices) {
      std::mt19937_64 random(seed);
      const sim::Fault fault = any_fault(random);
      const auto kind = static_cast<std::size_t>(fault.kind);
      const std::uint64_t before = rig.link->model().counters().faults_injected;
      rig.link->model().arm(fault);
      const bool exact = run_exactly(rig, seed, seed % 3 == 2);
      tally.struck[kind] += rig.link->model().counters().faults_injected != before ? 1 : 0;
      ++(exact ? tally.exact : tally.failed)[kind];
      // Without a fault the AFU is itself again; what a stray answer broke shows once at most.
      rig.link->model().arm({});
      if (!run_exactly(rig, seed, false)) {
        ASSERT_TRUE(run_exactly(rig, seed, false))
            << "seed " << seed << ": the AFU did not recover";
      }
    }
    EXPECT_EQ(rig.link->model().breach(), "");
  }
  for (std::size_t kind = 1; kind < sim::kFaultKinds; ++kind) {
    const auto name = sim::to_string(static_cast<sim::FaultKind>(kind));
    EXPECT_GT(tally.struck[kind], 10) << name << " hardly ever struck";
    RecordProperty(std::string(name), std::to_string(tally.struck[kind]) + " struck, " +
                                          std::to_string(tally.failed[kind]) + " errors");
  }
  for (const sim::FaultKind kind :
       {sim::FaultKind::drop_read, sim::FaultKind::corrupt_read, sim::FaultKind::error_read,
        sim::FaultKind::drop_write, sim::FaultKind::corrupt_write, sim::FaultKind::page_fault,
        sim::FaultKind::wrong_afu_id, sim::FaultKind::hang, sim::FaultKind::reset}) {
    EXPECT_GT(tally.failed[static_cast<std::size_t>(kind)], 10) << sim::to_string(kind);
  }
}

}  // namespace
}  // namespace harpoon::afu_test
