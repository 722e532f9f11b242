#include "profile.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <string>

namespace harpoon::sim {
namespace {

constexpr auto kProfiles = std::to_array<LinkProfile>({
    {"harp", "HARP v1: QPI, 8 GB/s in all; latencies assumed", 200, 8, true, 355, 355, 20, 400, 64},
    {"pcie3x16", "PCIe 3 x16: 12.8 GB/s each way; latencies assumed", 250, 12.8, false, 900, 900,
     20, 1000, 64},
    {"f2", "AWS F2 PCIM: 512 bits at 250 MHz each way, 32 reads; latencies assumed", 250, 16, false,
     800, 800, 20, 1000, 32},
});

Error bad(std::string message) {
  return Error{Errc::invalid_argument, std::move(message), 0};
}

bool set(LinkProfile& profile, std::string_view key, double value) {
  if (value < 0) return false;
  if (key == "clock_mhz" && value > 0) {
    profile.clock_mhz = value;
  } else if (key == "gbps" && value > 0) {
    profile.gigabytes_per_s = value;
  } else if (key == "shared") {
    profile.shared_bandwidth = value != 0;
  } else if (key == "latency_ns") {
    profile.read_latency_ns = value;
  } else if (key == "write_latency_ns") {
    profile.write_latency_ns = value;
  } else if (key == "in_flight" && value >= 1 && value <= 64) {
    profile.lines_in_flight = static_cast<std::uint32_t>(value);
  } else {
    return false;
  }
  return true;
}

}  // namespace

std::span<const LinkProfile> link_profiles() noexcept {
  return kProfiles;
}

Result<LinkProfile> find_profile(std::string_view name) {
  std::string known;
  for (const LinkProfile& profile : kProfiles) {
    if (profile.name == name) return profile;
    known += (known.empty() ? "" : ", ") + std::string(profile.name);
  }
  return bad(fmt::format("unknown link profile \"{}\"; known: {}", name, known));
}

Result<LinkProfile> parse_profile(std::string_view text) {
  const auto next = [&text] {
    const std::size_t comma = text.find(',');
    const std::string_view item = text.substr(0, comma);
    text = comma == std::string_view::npos ? std::string_view{} : text.substr(comma + 1);
    return item;
  };
  Result<LinkProfile> profile = find_profile(next());
  if (!profile) return profile;
  while (!text.empty()) {
    const std::string_view item = next();
    const std::size_t equals = item.find('=');
    double value = 0;
    if (equals == std::string_view::npos) return bad(fmt::format("expected key=value: {}", item));
    const std::string_view number = item.substr(equals + 1);
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
    const bool whole = error == std::errc{} && end == number.data() + number.size();
    if (!whole || !set(*profile, item.substr(0, equals), value))
      return bad(fmt::format("bad link setting \"{}\"", item));
  }
  return profile;
}

}  // namespace harpoon::sim
