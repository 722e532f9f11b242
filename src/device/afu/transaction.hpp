#pragma once

// The paper's transaction: seven steps that carry one batch through the AFU and back.
//
//   1  get pointers to Src, Dst and the AFU context           constructor
//   2  send the data to Src and start the SPL                 start()  (data written by the caller)
//   3  start signal and n_col through the control memory      start()
//   4  the AFU ID in the DSM says that it runs                finish()
//   5  the AFU says that it is done                           finish()
//   6  retrieve the results from Dst                          results()
//   7  end the transaction, free the workspace                release()
//
// Every wait has a deadline. The counters' digests are compared with what was sent and received, so
// that a line lost, doubled or corrupted on the way is an error and never a wrong contact.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

#include "device/afu/runtime.hpp"

namespace harpoon::afu {

using Log = std::function<void(LogLevel, std::string_view)>;

/// The cycle at which each step was taken; steps 1 to 7 are at 0 to 6.
using StepTrace = std::array<std::uint64_t, 7>;

/// What the AFU counted in one transaction.
struct Counters {
  std::uint64_t cycles = 0;  ///< start signal to last acknowledged result
  std::uint64_t lines_read = 0, lines_written = 0, hits = 0, scpu_pairs = 0;
  std::uint64_t first_line = 0, first_write = 0, read_stalls = 0, write_stalls = 0;
  std::uint64_t spl2_cycles = 0;  ///< enable to start signal
};

/// How a transaction wants its workspace cut.
struct Layout {
  contract::Format format = contract::Format::direct;
  std::uint64_t pairs = 0;    ///< n_col
  std::uint64_t spheres = 0;  ///< to load; indexed format only
  bool load_table = false;
  std::uint64_t dest_records = 0;  ///< room for results
};

/// Bytes of workspace that a layout needs.
std::uint64_t workspace_bytes(const Layout& layout) noexcept;

class Transaction {
 public:
  /// Step 1. `slot` is one of the service's, `workspace` large enough for `layout`.
  Transaction(Service& service, std::size_t slot, Workspace& workspace, const Layout& layout,
              const Log& log);

  /// Where the caller writes spheres and pairs (step 2): whole lines, padded with zeros.
  [[nodiscard]] std::byte* spheres() const noexcept;
  [[nodiscard]] std::byte* source() const noexcept;

  /// Steps 2 and 3.
  void start(std::uint32_t sequence);
  /// Steps 4 and 5. Errors: device_timeout, device_fault.
  Result<Counters> finish();
  /// Step 6: the records in Dst. Errors: device_fault (they are not what the AFU wrote).
  Result<std::span<const std::byte>> results();
  /// Step 7.
  void release();

  [[nodiscard]] const StepTrace& steps() const noexcept { return steps_; }

 private:
  void step(int number, std::string_view what);
  std::optional<Error> wait_for_id();
  std::optional<Error> wait_for_done();
  Result<Counters> read_counters();
  template <class Ready>
  std::optional<Error> wait(const Ready& ready, std::string_view silence);

  Service& service_;
  std::size_t slot_;
  Workspace& workspace_;
  Layout layout_;
  const Log& log_;
  std::uint64_t source_at_ = 0, spheres_at_ = 0, dest_at_ = 0;
  std::uint64_t source_bytes_ = 0, sphere_bytes_ = 0, dest_bytes_ = 0;
  std::uint64_t source_digest_ = 0, dest_digest_ = 0, lines_written_ = 0, deadline_ = 0;
  std::uint32_t sequence_ = 0;
  StepTrace steps_{};
};

}  // namespace harpoon::afu
