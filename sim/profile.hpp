#pragma once

// Link profiles: what a simulated link is, in a few numbers. A new link is a new row in
// profile.cpp, or numbers given by the caller; nothing else knows a profile by name.

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "harpoon/error.hpp"

namespace harpoon::sim {

/// A link and the clock of the AFU behind it. Figures marked [A] in the table are assumptions.
struct LinkProfile {
  std::string_view name;
  std::string_view description;
  double clock_mhz;
  double gigabytes_per_s;         ///< payload, in all or each way
  bool shared_bandwidth;          ///< true: in all
  double read_latency_ns;         ///< request accepted to data
  double write_latency_ns;        ///< data accepted to acknowledgement; visible at half of it
  double register_write_ns;       ///< between two posted register writes
  double register_read_ns;        ///< round trip
  std::uint32_t lines_in_flight;  ///< most reads and most writes outstanding
};

/// The built-in profiles: harp, pcie3x16, f2.
std::span<const LinkProfile> link_profiles() noexcept;

/// A profile by name. Errors: invalid_argument (lists the known names).
Result<LinkProfile> find_profile(std::string_view name);

/// A profile with some numbers replaced: "harp,latency_ns=500,gbps=12.8". Keys: clock_mhz, gbps,
/// shared (0 or 1), latency_ns, write_latency_ns, in_flight. Errors: invalid_argument (names the
/// range, or the known keys).
Result<LinkProfile> parse_profile(std::string_view text);

/// An error (invalid_argument) for numbers that no parsed profile has.
std::optional<Error> check_profile(const LinkProfile& profile);

}  // namespace harpoon::sim
