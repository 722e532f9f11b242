#pragma once

// Runtime, Service and Workspace: what must stand before a transaction can run. The words are those
// of the paper's stack: the runtime starts, allocates the service (the AFU behind its link), which
// hands out workspaces. Knows no formats and no batches.

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "device/afu/line.hpp"
#include "device/afu/link.hpp"
#include "harpoon/device.hpp"
#include "harpoon/error.hpp"

namespace harpoon::afu {

/// Limits on every wait, in microseconds of device time, each 0 to `kMostTimeoutUs`. What the link
/// itself takes (round trips and bytes, as its LinkInfo tells) comes on top.
struct Timeouts {
  double identify_us = 100;     ///< SPL_ID and AFU_ID after their DSM base was set
  double transaction_us = 200;  ///< start of a transaction to its end, plus `per_pair_us` a pair
  double per_pair_us = 0.2;
};
inline constexpr double kMostTimeoutUs = 1e9;

/// An error (invalid_argument) for a limit that is negative, not a number or too long.
std::optional<Error> check(const Timeouts& timeouts);

/// What the AFU says of itself in its DSM.
struct AfuIdentity {
  std::uint64_t id_low = 0, id_high = 0;
  std::uint32_t scpus = 0, lines_in_flight = 0, lanes = 0, table_spheres = 0;
};

/// The published AFU's behaviour, for comparison: few lines in flight and a barrier per N pairs.
struct PucSettings {
  std::uint32_t lines_in_flight = 0;  ///< 0: as many as AFU and link allow
  bool batch_barrier = false;
};

/// A buffer that AFU and host share, with the addresses that the AFU uses for it. Movable; gives
/// its memory back when destroyed.
class Workspace {
 public:
  /// `bytes` 1 to 2 GB. Errors: invalid_argument (too large), out_of_memory.
  static Result<Workspace> allocate(AfuLink& link, std::uint64_t bytes, std::uint64_t address);
  Workspace(Workspace&& other) noexcept;
  Workspace& operator=(Workspace&& other) noexcept;
  ~Workspace();

  [[nodiscard]] std::uint64_t bytes() const noexcept { return memory_.bytes; }
  /// Address of the first byte as the AFU sees it, 2 MB aligned.
  [[nodiscard]] std::uint64_t address() const noexcept { return address_; }
  [[nodiscard]] std::byte* at(std::uint64_t offset) const noexcept { return memory_.data + offset; }
  [[nodiscard]] const SharedMemory& memory() const noexcept { return memory_; }

 private:
  Workspace(AfuLink& link, SharedMemory memory, std::uint64_t address) noexcept;
  AfuLink* link_;
  SharedMemory memory_;
  std::uint64_t address_;
};

/// An open AFU. Owns the status memories and the page tables; the link outlives it.
class Service {
 public:
  static constexpr std::size_t kSlots = 2;  ///< workspaces that can be prepared at a time

  /// Cold reset, then SPL_ID and AFU_ID must appear in time. Errors: device_timeout,
  /// device_fault (another AFU, corrupt lines), out_of_memory, invalid_argument (a limit).
  static Result<std::unique_ptr<Service>> open(AfuLink& link, const Timeouts& timeouts,
                                               const PucSettings& settings);
  ~Service();
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  [[nodiscard]] AfuLink& link() const noexcept { return link_; }
  [[nodiscard]] const Timeouts& timeouts() const noexcept { return timeouts_; }
  [[nodiscard]] const AfuIdentity& identity() const noexcept { return identity_; }
  [[nodiscard]] std::uint64_t cycles(double microseconds) const noexcept;
  /// Cycles in which link and AFU surely get through `lines` with `batches` barriers between them,
  /// and what must be exchanged before and after.
  [[nodiscard]] std::uint64_t link_cycles(std::uint64_t lines,
                                          std::uint64_t batches) const noexcept;
  /// Barriers of a transaction of so many pairs.
  [[nodiscard]] std::uint64_t batches(std::uint64_t pairs) const noexcept;

  /// Writes SPL2_CNTXT and the page table of a slot for the first `bytes` of a workspace.
  void map(std::size_t slot, const Workspace& workspace, std::uint64_t bytes) noexcept;
  /// Points SPL2 at a slot's context and the AFU at the workspace's, and enables.
  void enable(std::size_t slot, const Workspace& workspace);

  [[nodiscard]] Line afu_dsm(std::uint32_t line) const noexcept;
  [[nodiscard]] Line spl_dsm(std::uint32_t line) const noexcept;
  /// The SPL2 fault that the device reported in its DSM, or no error.
  [[nodiscard]] std::optional<Error> reported_fault() const;
  /// An error for a wait that ran out: what the registers say, in words.
  [[nodiscard]] Error silence(std::string_view what);

 private:
  Service(AfuLink& link, const Timeouts& timeouts, const PucSettings& settings,
          SharedMemory system) noexcept;
  std::optional<Error> identify();
  [[nodiscard]] std::uint32_t lines_in_flight() const noexcept;
  void write_address(std::uint32_t offset, std::uint64_t address);
  [[nodiscard]] std::uint64_t physical(std::uint64_t offset) const noexcept;

  AfuLink& link_;
  Timeouts timeouts_;
  PucSettings settings_;
  SharedMemory system_;  // one page: DSMs, contexts, page tables
  AfuIdentity identity_;
};

/// "SPL2 fault 2 (access violation) on a read at 0x...": for messages.
std::string describe_fault(std::uint32_t fault, std::uint32_t request, std::uint64_t address);
std::string_view describe(contract::AfuError error) noexcept;

}  // namespace harpoon::afu
