// Every instruction set against Algorithm 1 written out plainly, for every form of batch.

#include "device/cpu/kernels.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "base/float_environment.hpp"
#include "support/pairs.hpp"

namespace harpoon {
namespace {

constexpr std::uint64_t kSeed = 20261122;
constexpr std::size_t kPairs = 200000;

template <class Real>
class Kernels : public testing::Test {};
using Precisions = testing::Types<float, double>;
TYPED_TEST_SUITE(Kernels, Precisions);

template <class Real>
void expect_equal(const std::vector<SpherePairOf<Real>>& pairs,
                  const std::vector<ContactOf<Real>>& contacts, const std::string& what) {
  std::array<std::size_t, 4> seen{};
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const ContactOf<Real> expected = test::algorithm_1(pairs[i]);
    ASSERT_TRUE(test::same_contact(contacts[i], expected))
        << what << ", seed " << kSeed << ", pair " << i << ": " << test::text(pairs[i]);
    ++seen[static_cast<std::size_t>(expected.flow())];
  }
  for (const Flow flow : {Flow::fake, Flow::grazing, Flow::real}) {
    EXPECT_GT(seen[static_cast<std::size_t>(flow)], pairs.size() / 100) << what;
  }
}

template <class Real>
std::size_t count_hits(const std::vector<ContactOf<Real>>& contacts) {
  return static_cast<std::size_t>(
      std::count_if(contacts.begin(), contacts.end(), [](const auto& c) { return c.hit(); }));
}

TEST(InstructionSets, AreNamedAndTheWidestIsTheLast) {
  const auto names = cpu::instruction_set_names();
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(names.back(), cpu::widest_instruction_set());
  EXPECT_EQ(cpu::find_kernels(""), cpu::find_kernels(names.back()));
  EXPECT_EQ(cpu::find_kernels("no such set"), nullptr);
  for (const std::string& name : names) EXPECT_NE(cpu::find_kernels(name), nullptr) << name;
}

TYPED_TEST(Kernels, PairsEqualAlgorithm1OnEveryInstructionSet) {
  const auto pairs = test::random_pairs<TypeParam>(kSeed, kPairs);
  for (const std::string& name : cpu::instruction_set_names()) {
    for (const bool stream : {false, true}) {
      std::vector<ContactOf<TypeParam>> contacts(kPairs);
      const FloatEnvironment environment;
      const std::size_t hits = cpu::find_kernels(name)->of<TypeParam>().pairs(
          pairs.data(), kPairs, contacts.data(), stream);
      expect_equal(pairs, contacts, name);
      EXPECT_EQ(hits, count_hits(contacts)) << name;
    }
  }
}

// Batches shorter than a vector, ending inside one, and starting at any record.
TYPED_TEST(Kernels, EveryLengthAndOffsetGivesTheSame) {
  const auto pairs = test::random_pairs<TypeParam>(kSeed + 1, 300);
  for (const std::string& name : cpu::instruction_set_names()) {
    const auto& kernels = cpu::find_kernels(name)->of<TypeParam>();
    for (std::size_t first = 0; first < 3; ++first) {
      for (std::size_t count = 0; count < 140; ++count) {
        const bool stream = count % 2 == 1;
        std::vector<ContactOf<TypeParam>> contacts(count + 1);
        const std::size_t hits =
            kernels.pairs(pairs.data() + first, count, contacts.data(), stream);
        EXPECT_EQ(contacts[count].flow_word, 0u) << "wrote past the end";
        contacts.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
          ASSERT_TRUE(test::same_contact(contacts[i], test::algorithm_1(pairs[first + i])))
              << name << " first " << first << " count " << count << " pair " << i;
        }
        EXPECT_EQ(hits, count_hits(contacts)) << name << " count " << count;
      }
    }
  }
}

// Contacts that bypass the caches, to any address that holds numbers of this size.
TYPED_TEST(Kernels, StreamsToEveryAlignment) {
  constexpr std::size_t kCount = 700;
  const auto pairs = test::random_pairs<TypeParam>(kSeed + 3, kCount);
  for (const std::string& name : cpu::instruction_set_names()) {
    for (std::size_t offset = 0; offset < 64; offset += sizeof(TypeParam)) {
      std::vector<unsigned char> memory((kCount + 4) * sizeof(ContactOf<TypeParam>), 0xAA);
      const std::size_t first = 64 + offset - reinterpret_cast<std::uintptr_t>(memory.data()) % 64;
      auto* contacts = reinterpret_cast<ContactOf<TypeParam>*>(memory.data() + first);
      cpu::find_kernels(name)->of<TypeParam>().pairs(pairs.data(), kCount, contacts, true);
      for (std::size_t i = 0; i < kCount; ++i) {
        ASSERT_TRUE(test::same_contact(contacts[i], test::algorithm_1(pairs[i])))
            << name << " offset " << offset << " pair " << i;
      }
      const std::size_t end = first + kCount * sizeof(ContactOf<TypeParam>);
      for (std::size_t i = 0; i < first; ++i) ASSERT_EQ(memory[i], 0xAA) << i;
      for (std::size_t i = end; i < memory.size(); ++i) ASSERT_EQ(memory[i], 0xAA) << i;
    }
  }
}

TYPED_TEST(Kernels, ArraysEqualRecords) {
  constexpr std::size_t kCount = 1003;  // not a multiple of any vector
  const auto pairs = test::random_pairs<TypeParam>(kSeed + 2, kCount);
  std::vector<std::vector<TypeParam>> in(8, std::vector<TypeParam>(kCount));
  for (std::size_t i = 0; i < kCount; ++i) {
    TypeParam numbers[8];
    std::memcpy(numbers, &pairs[i], sizeof numbers);
    for (std::size_t k = 0; k < 8; ++k) in[k][i] = numbers[k];
  }
  const SpherePairArraysOf<TypeParam> arrays{in[0].data(), in[1].data(), in[2].data(),
                                             in[3].data(), in[4].data(), in[5].data(),
                                             in[6].data(), in[7].data(), kCount};
  for (const std::string& name : cpu::instruction_set_names()) {
    std::vector<std::vector<TypeParam>> out(7, std::vector<TypeParam>(kCount));
    std::vector<typename ContactOf<TypeParam>::FlowWord> flow(kCount);
    const ContactArraysOf<TypeParam> result{out[0].data(), out[1].data(), out[2].data(),
                                            out[3].data(), out[4].data(), out[5].data(),
                                            out[6].data(), flow.data(),   kCount};
    const auto& kernels = cpu::find_kernels(name)->of<TypeParam>();
    const std::size_t hits =
        kernels.arrays(arrays, 0, 500, result) + kernels.arrays(arrays, 500, kCount, result);
    std::vector<ContactOf<TypeParam>> contacts(kCount);
    for (std::size_t i = 0; i < kCount; ++i) {
      contacts[i] = {
          {out[0][i], out[1][i], out[2][i]}, {out[3][i], out[4][i], out[5][i]}, out[6][i], flow[i]};
    }
    expect_equal(pairs, contacts, name);
    EXPECT_EQ(hits, count_hits(contacts)) << name;
  }
}

// All combinations of the special values over the eight operands: 8^8 pairs.
TEST(SpecialValues, EqualAlgorithm1OnEveryInstructionSet) {
  constexpr std::size_t kBlock = std::size_t{1} << 12;
  constexpr std::size_t kCombinations = std::size_t{1} << 24;
  // Every 61st block on each set; the blocks of all sets together cover different combinations.
  const auto names = cpu::instruction_set_names();
  std::vector<SpherePair> pairs(kBlock);
  std::vector<Contact> contacts(kBlock);
  std::size_t start = 0;
  for (const std::string& name : names) {
    for (std::size_t base = start++ * kBlock; base < kCombinations; base += 61 * kBlock) {
      for (std::size_t i = 0; i < kBlock; ++i) {
        float numbers[8];
        for (std::size_t k = 0; k < 8; ++k) {
          numbers[k] = test::kSpecialValues<float>[((base + i) >> (3 * k)) % 8];
        }
        std::memcpy(static_cast<void*>(&pairs[i]), numbers, sizeof numbers);
      }
      cpu::find_kernels(name)->f32.pairs(pairs.data(), kBlock, contacts.data(), false);
      for (std::size_t i = 0; i < kBlock; ++i) {
        ASSERT_TRUE(test::same_contact(contacts[i], test::algorithm_1(pairs[i])))
            << name << ": " << test::text(pairs[i]);
      }
    }
  }
}

}  // namespace
}  // namespace harpoon
