// One hash over instruction sets, threads, compilers and optimisation levels.

#include <gtest/gtest.h>

#include "harpoon/device.hpp"
#include "support/pairs.hpp"

namespace harpoon {
namespace {

constexpr std::size_t kPairs = 100000;  // enough to be cut into tasks
constexpr std::uint64_t kHashF32 = 17401058096056631315u;
constexpr std::uint64_t kHashF64 = 5498138501796560639u;

template <class Real>
std::uint64_t hash_of(Device& device) {
  const auto pairs = test::random_pairs<Real>(7, kPairs);
  std::vector<ContactOf<Real>> contacts(kPairs);
  const auto outcome = device.run(PairBatch<Real>{pairs, contacts});
  EXPECT_TRUE(outcome) << outcome.error().message;
  std::uint64_t hash = 0xCBF29CE484222325u;
  for (const auto& contact : contacts) test::add_to_hash(hash, contact);
  return hash;
}

TEST(Golden, OneHashOverInstructionSetsAndThreads) {
  for (const std::string& name : cpu_instruction_sets()) {
    for (const unsigned threads : {1u, 2u, 3u, 8u}) {
      CpuOptions options;
      options.threads = threads;
      options.instruction_set = name;
      const auto device = make_cpu_device(options);
      ASSERT_TRUE(device);
      EXPECT_EQ(hash_of<float>(**device), kHashF32) << name << " threads " << threads;
      EXPECT_EQ(hash_of<double>(**device), kHashF64) << name << " threads " << threads;
    }
  }
}

}  // namespace
}  // namespace harpoon
