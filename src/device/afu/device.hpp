#pragma once

/// The AFU as a harpoon::Device ("afu"): batches in, the same bits out, through the paper's
/// transactions. f32 pairs and indexed pairs; other batches are Errc::unsupported. Errors of the
/// device (timeouts, faults, wrong results) reset it and are returned; `FallbackDevice` redoes the
/// batch elsewhere. Works over any AfuLink; knows nothing of simulators or boards.

#include <cstdint>
#include <memory>
#include <string>

#include "device/afu/runtime.hpp"
#include "device/afu/transaction.hpp"
#include "harpoon/device.hpp"

namespace harpoon::afu {

struct AfuOptions {
  Timeouts timeouts = {};
  PucSettings puc = {};
  /// Bytes of each of the two workspaces, at most 2 GB; batches that need more are cut.
  std::uint64_t workspace_bytes = std::uint64_t{64} << 20;
  /// Most pairs in one transaction; 0: as many as the workspace holds.
  std::uint64_t transaction_pairs = 0;
  /// PairBatch travels in the hits-only format: fewer bytes when many pairs are apart.
  bool hits_only = false;
  /// Receives the seven steps of every transaction and every error. May be empty.
  Log log = {};
};

/// The last run, for reports.
struct AfuReport {
  LinkInfo link;
  AfuIdentity identity;
  contract::Format format = contract::Format::direct;
  std::uint64_t pairs = 0, hits = 0, transactions = 0;
  std::uint64_t total_cycles = 0;  ///< first step 1 to last step 7, all transactions
  Counters counters;               ///< summed over the transactions
  StepTrace last_steps{};
  /// Payload that the link moved, as a share of what it could have moved while the AFU ran.
  double link_occupancy = 0;
  /// Pairs that went through SCPUs, as a share of N a cycle.
  double scpu_occupancy = 0;
};

/// Thread-safe like every Device: batches take turns. `submit` returns when the batch is done.
class AfuDevice : public Device {
 public:
  /// The last batch that succeeded. Not thread-safe against `submit`.
  [[nodiscard]] virtual const AfuReport& last_run() const noexcept = 0;
};

/// Opens the AFU behind a link. Errors: invalid_argument (null link, workspace size),
/// device_timeout and device_fault (it does not answer, or not as Harpoon's AFU), out_of_memory.
HARPOON_API Result<std::unique_ptr<AfuDevice>> make_afu_device(std::unique_ptr<AfuLink> link,
                                                               const AfuOptions& options = {});

/// Why this machine has no AFU without a simulator, and how to get one: for the list of devices.
HARPOON_API std::string_view afu_absent_reason() noexcept;

}  // namespace harpoon::afu
