#pragma once

// What the host half of the AFU needs from whatever carries it to the device: registers, shared
// memory, and a clock. The simulator implements it; a board driver would. Knows nothing of
// transactions.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "harpoon/error.hpp"

namespace harpoon::afu {

/// Static facts about a link.
struct LinkInfo {
  std::string profile;            ///< for example "harp"
  std::string description;        ///< one line; assumptions are marked as such
  double clock_mhz = 0;           ///< the AFU's clock; cycles are counted in it
  double bytes_per_cycle = 0;     ///< payload that the link moves in a cycle, each way or in all
  bool shared_bandwidth = false;  ///< true: bytes_per_cycle is for both directions together
  std::uint32_t lines_in_flight = 0;  ///< most lines that may be outstanding each way
  /// Of a read and an acknowledged write, one after the other; 0 where it is small beside the
  /// limits on waiting. These follow it.
  double round_trip_ns = 0;
  bool modelled = false;  ///< a simulation: its times are not measured
};

/// Memory that host and device both see. For the host it is contiguous; the device sees it as 2 MB
/// pages, each at a physical address of its own. Owned by the link that made it.
struct SharedMemory {
  std::byte* data = nullptr;
  std::uint64_t bytes = 0;                    ///< a multiple of 2 MB
  std::vector<std::uint64_t> page_addresses;  ///< physical, one per 2 MB
};

/// One device behind one link. Not thread-safe: one thread at a time.
///
/// Time is counted in cycles of the AFU. On a simulation it advances only inside `advance` and the
/// register calls, so cycle counts are a function of what the host asks for.
class AfuLink {
 public:
  virtual ~AfuLink() = default;

  [[nodiscard]] virtual const LinkInfo& info() const noexcept = 0;

  /// 32-bit registers by byte offset.
  virtual void write_register(std::uint32_t offset, std::uint32_t value) = 0;
  virtual std::uint32_t read_register(std::uint32_t offset) = 0;

  /// Pinned shared memory of at least `bytes`, zeroed. Errors: out_of_memory.
  virtual Result<SharedMemory> allocate(std::uint64_t bytes) = 0;
  virtual void release(const SharedMemory& memory) noexcept = 0;

  /// Lets at least one and at most `cycles` cycles pass.
  virtual void advance(std::uint64_t cycles) = 0;
  [[nodiscard]] virtual std::uint64_t now() const noexcept = 0;

  /// Cold reset of the device and its side of the link: outstanding requests are forgotten and
  /// every register has its reset value. Shared memory is kept.
  virtual void reset() = 0;
};

}  // namespace harpoon::afu
