#include "sim/physical_memory.hpp"

#include <gtest/gtest.h>

namespace harpoon::sim {
namespace {

constexpr std::uint64_t kPage = std::uint64_t{2} << 20;

TEST(PhysicalMemory, MapsEveryPageOfABuffer) {
  PhysicalMemory memory(1);
  const auto buffer = memory.allocate(3 * kPage - 5);
  ASSERT_TRUE(buffer.ok());
  ASSERT_EQ(buffer->bytes, 3 * kPage);
  ASSERT_EQ(buffer->page_addresses.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(memory.line(buffer->page_addresses[i] + 64), buffer->data + i * kPage + 64);
    EXPECT_EQ(buffer->page_addresses[i] % kPage, 0u);
  }
  EXPECT_EQ(memory.line(0), nullptr);
}

TEST(PhysicalMemory, ForgetsWhatWasReleased) {
  PhysicalMemory memory(2);
  const auto buffer = memory.allocate(kPage);
  const std::uint64_t address = buffer->page_addresses.front();
  ASSERT_NE(memory.line(address), nullptr);
  memory.release(*buffer);
  EXPECT_EQ(memory.line(address), nullptr);
}

}  // namespace
}  // namespace harpoon::sim
