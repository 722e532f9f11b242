#pragma once

// Faults that the simulated link can inject: what goes wrong, and at which event. Data only.

#include <cstdint>
#include <string_view>

namespace harpoon::sim {

enum class FaultKind : std::uint8_t {
  none,
  drop_read,       ///< a read is never answered
  duplicate_read,  ///< a read is answered twice
  late_read,       ///< an answer comes `amount` cycles late
  corrupt_read,    ///< up to three bits of an answer are wrong
  error_read,      ///< a read is answered with SLVERR
  drop_write,      ///< a write is acknowledged but not performed
  drop_ack,        ///< a write is performed but never acknowledged
  duplicate_ack,   ///< a write is acknowledged twice
  late_ack,        ///< an acknowledgement comes `amount` cycles late
  corrupt_write,   ///< up to three bits of a written line are wrong
  error_write,     ///< a write is answered with SLVERR
  hang,            ///< from here on the link accepts nothing and answers nothing
  reset,           ///< the device is reset behind the host's back
  wrong_afu_id,    ///< another AFU answers: its ID lines (with good check words) name it
  torn_write,      ///< a written line becomes visible half by half, `amount` cycles apart
  page_fault,      ///< page-table entries are read as valid = 0 (with good check words)
};
inline constexpr int kFaultKinds = 17;

std::string_view to_string(FaultKind kind) noexcept;

struct Fault {
  FaultKind kind = FaultKind::none;
  /// The fault strikes at the nth event of its sort (read, write or cycle) since it was armed,
  /// counted from 0.
  std::uint64_t nth = 0;
  std::uint64_t amount = 0;  ///< cycles, see above
};

}  // namespace harpoon::sim
