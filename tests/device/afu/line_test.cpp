// Check words and digests: up to three wrong bits of a line always show.

#include "device/afu/line.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <set>
#include <string_view>

namespace harpoon::afu {
namespace {

Line flip(Line line, unsigned bit) {
  line.words[bit / 64] ^= std::uint64_t{1} << (bit % 64);
  return line;
}

// The fold is linear, so it is enough to look at what single bits do: with weight three each and
// all different, one or two flips never cancel, and neither do three (their parity is odd).
TEST(LineFold, EveryBitFlipsThreeOthers) {
  std::set<std::uint64_t> effects;
  for (unsigned bit = 0; bit < 512; ++bit) {
    const std::uint64_t effect = flip(Line{}, bit).fold();
    EXPECT_EQ(std::popcount(effect), 3) << bit;
    effects.insert(effect);
  }
  EXPECT_EQ(effects.size(), 512u);
}

TEST(LineCheck, NoticesUpToThreeWrongBits) {
  const std::uint64_t seed = std::random_device{}();
  std::mt19937_64 random(seed);
  Line line;
  for (std::uint64_t& word : line.words) word = random();
  line.seal();
  ASSERT_TRUE(line.check_matches());
  for (int i = 0; i < 20000; ++i) {
    std::set<unsigned> bits;
    while (bits.size() < 1 + static_cast<unsigned>(i) % 3)
      bits.insert(static_cast<unsigned>(random() % 512));
    Line wrong = line;
    for (const unsigned bit : bits) wrong = flip(wrong, bit);
    ASSERT_FALSE(wrong.check_matches()) << "seed " << seed;
  }
  EXPECT_FALSE(Line{}.check_matches()) << "a line that was never written must not pass";
}

TEST(LineFields, AreReadAsTheyWereWritten) {
  Line line;
  line.put(contract::spl2_cntxt::kPageCount, 0xffff'ffff);
  line.put(contract::spl2_cntxt::kPageTable, 0x0123'4567'89ab'cdef);
  EXPECT_EQ(line.get(contract::spl2_cntxt::kPageTable), 0x0123'4567'89ab'cdefu);
  EXPECT_EQ(line.get32(contract::spl2_cntxt::kPageCount), 0xffff'ffffu);
  EXPECT_EQ(line.get(contract::spl2_cntxt::kPageSize), 0u) << "a neighbour was touched";
  EXPECT_EQ(line.get(contract::spl2_cntxt::kControl), 0u);
}

TEST(Digest, DependsOnTheOrderOfLines) {
  Line a, b;
  a.words[0] = 1;
  b.words[3] = 2;
  Digest ab, ba;
  ab.add(a);
  ab.add(b);
  ba.add(b);
  ba.add(a);
  EXPECT_NE(ab.value(), ba.value());
}

TEST(Contract, FieldsFitTheirRecordAndDoNotOverlap) {
  for (const contract::Record& record : contract::kRecords) {
    std::uint64_t used = 0;
    for (const contract::Field& field : record.fields) {
      ASSERT_LE(field.offset + field.bytes, record.bytes) << record.name << field.name;
      const std::uint64_t bytes = ((std::uint64_t{1} << field.bytes) - 1) << field.offset;
      EXPECT_EQ(used & bytes, 0u) << record.name << " " << field.name;
      used |= bytes;
    }
  }
}

TEST(Contract, BitsFitTheirWordAndDoNotOverlap) {
  for (const contract::Word& word : contract::kWords) {
    std::uint64_t used = 0;
    std::uint32_t top = 0;
    for (const contract::Bits& bits : word.bits) {
      ASSERT_LE(bits.low + bits.count, word.bytes * 8) << word.name << " " << bits.name;
      EXPECT_GE(bits.low, top) << word.name << " " << bits.name << " is out of order";
      top = bits.low + bits.count;
      const std::uint64_t mask = ((std::uint64_t{1} << bits.count) - 1) << bits.low;
      EXPECT_EQ(used & mask, 0u) << word.name << " " << bits.name;
      used |= mask;
    }
  }
}

/// Bytes of a type that the contract names, 0 for what it does not name.
std::uint32_t bytes_of(std::string_view type) {
  for (const contract::Word& word : contract::kWords)
    if (word.name == type) return word.bytes;
  for (const contract::Codes& codes : contract::kCodes)
    if (codes.name == type) return codes.bits / 8;
  for (const contract::Record& record : contract::kRecords)
    if (record.name == type) return record.bytes;
  return 0;
}

TEST(Contract, TypesAreThereAndAsWideAsWhatHoldsThem) {
  for (const contract::Record& record : contract::kRecords) {
    for (const contract::Field& field : record.fields) {
      if (field.type.empty()) continue;
      EXPECT_EQ(bytes_of(field.type), field.bytes) << record.name << " " << field.name;
    }
  }
  for (const contract::Register& r : contract::kRegisters) {
    if (r.type.empty()) continue;
    EXPECT_EQ(bytes_of(r.type), r.bytes) << r.name;
  }
}

}  // namespace
}  // namespace harpoon::afu
