#pragma once

// Physical memory as the device sees it: 2 MB pages, scattered at random over a large address
// space, so that an untranslated or wrongly translated address never works by luck.

#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <unordered_map>
#include <vector>

#include "device/afu/link.hpp"

namespace harpoon::sim {

class PhysicalMemory {
 public:
  explicit PhysicalMemory(std::uint64_t seed) : random_(seed) {}
  ~PhysicalMemory();
  PhysicalMemory(const PhysicalMemory&) = delete;
  PhysicalMemory& operator=(const PhysicalMemory&) = delete;

  /// Zeroed memory, populated on first touch. Errors: out_of_memory.
  Result<afu::SharedMemory> allocate(std::uint64_t bytes);
  void release(const afu::SharedMemory& memory) noexcept;

  /// The line at a physical address, or null where nothing is mapped.
  [[nodiscard]] std::byte* line(std::uint64_t address) noexcept;

 private:
  std::unordered_map<std::uint64_t, std::byte*> pages_;  // physical page -> host address
  std::vector<afu::SharedMemory> owned_;
  std::mt19937_64 random_;
  /// Pages looked up last, each in the place that its number's low bits name.
  struct Recent {
    std::uint64_t page = ~std::uint64_t{0};
    std::byte* data = nullptr;
  };
  std::array<Recent, 64> recent_;
};

}  // namespace harpoon::sim
