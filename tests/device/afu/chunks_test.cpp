#include "device/afu/chunks.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace harpoon::afu {
namespace {

TEST(ChunkCutter, CoversTheBatchOnce) {
  ChunkCutter cutter(10, 4);
  std::vector<std::uint64_t> ends;
  std::uint64_t at = 0;
  while (cutter.more()) {
    const Chunk chunk = cutter.next();
    EXPECT_EQ(chunk.begin, at);
    at = chunk.end;
    ends.push_back(at);
  }
  EXPECT_EQ(ends, (std::vector<std::uint64_t>{4, 8, 10}));
}

TEST(ChunkCutter, GivesOneEmptyChunkForAnEmptyBatch) {
  ChunkCutter cutter(0, 4);
  ASSERT_TRUE(cutter.more());
  EXPECT_EQ(cutter.next().size(), 0u);
  EXPECT_FALSE(cutter.more());
}

TEST(LocalSpheres, KeepsEveryChunkWithinTheTable) {
  const std::uint64_t seed = std::random_device{}();
  std::mt19937_64 random(seed);
  constexpr std::uint32_t kTable = 16;
  std::vector<IndexPair> pairs(2000);
  for (IndexPair& pair : pairs) {
    pair = {static_cast<std::uint32_t>(random() % 100), static_cast<std::uint32_t>(random() % 100)};
  }
  LocalSpheres local(100, kTable);
  std::uint64_t at = 0;
  int chunks = 0, full = 0;
  while (at < pairs.size()) {
    const Chunk chunk = local.cut(pairs, at, 50);
    ASSERT_EQ(chunk.begin, at) << "seed " << seed;
    ASSERT_GT(chunk.size(), 0u) << "seed " << seed;
    ASSERT_LE(local.globals().size(), kTable);
    const std::set<std::uint32_t> distinct(local.globals().begin(), local.globals().end());
    ASSERT_EQ(distinct.size(), local.globals().size());
    for (std::uint64_t i = chunk.begin; i < chunk.end; ++i) {
      ASSERT_EQ(local.globals()[local.local(pairs[i].g1)], pairs[i].g1);
      ASSERT_EQ(local.globals()[local.local(pairs[i].g2)], pairs[i].g2);
    }
    full += chunk.size() < 50 ? 1 : 0;
    at = chunk.end;
    ++chunks;
  }
  EXPECT_GT(chunks, 10);
  EXPECT_GT(full, 10) << "the table was never the limit";
}

}  // namespace
}  // namespace harpoon::afu
