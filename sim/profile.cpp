#include "profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
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

/// A number of a profile that a user may replace. The bounds are wide for any link of today, and
/// keep every derived count of cycles far from overflow and from 0.
struct Setting {
  std::string_view key;
  double low, high;
  bool is_whole;
  double (*get)(const LinkProfile&);
  void (*set)(LinkProfile&, double);
};

constexpr auto kSettings = std::to_array<Setting>({
    {"clock_mhz", 1, 2000, false, [](const LinkProfile& p) { return p.clock_mhz; },
     [](LinkProfile& p, double value) { p.clock_mhz = value; }},
    {"gbps", 0.1, 1000, false, [](const LinkProfile& p) { return p.gigabytes_per_s; },
     [](LinkProfile& p, double value) { p.gigabytes_per_s = value; }},
    {"shared", 0, 1, true, [](const LinkProfile& p) { return p.shared_bandwidth ? 1.0 : 0.0; },
     [](LinkProfile& p, double value) { p.shared_bandwidth = value != 0; }},
    {"latency_ns", 0, 100000, false, [](const LinkProfile& p) { return p.read_latency_ns; },
     [](LinkProfile& p, double value) { p.read_latency_ns = value; }},
    {"write_latency_ns", 0, 100000, false, [](const LinkProfile& p) { return p.write_latency_ns; },
     [](LinkProfile& p, double value) { p.write_latency_ns = value; }},
    {"in_flight", 1, 64, true,
     [](const LinkProfile& p) { return static_cast<double>(p.lines_in_flight); },
     [](LinkProfile& p, double value) { p.lines_in_flight = static_cast<std::uint32_t>(value); }},
});

std::string known_settings() {
  std::string known;
  for (const Setting& setting : kSettings) {
    known += fmt::format("{}{} {} to {}", known.empty() ? "" : ", ", setting.key, setting.low,
                         setting.high);
  }
  return known;
}

/// False for NaN too.
bool fits(const Setting& setting, double value) {
  return value >= setting.low && value <= setting.high &&
         (!setting.is_whole || value == std::floor(value));
}

Error out_of_range(const Setting& setting, std::string_view value) {
  return bad(fmt::format("the link setting {} is a {}number from {} to {}, not \"{}\"; known: {}",
                         setting.key, setting.is_whole ? "whole " : "", setting.low, setting.high,
                         value, known_settings()));
}

/// Replaces one number: "key=value".
std::optional<Error> apply(LinkProfile& profile, std::string_view item) {
  const std::size_t equals = item.find('=');
  const std::string_view key = item.substr(0, equals);
  const auto* const setting = std::find_if(kSettings.begin(), kSettings.end(),
                                           [key](const Setting& s) { return s.key == key; });
  if (setting == kSettings.end() || equals == std::string_view::npos) {
    return bad(
        fmt::format("\"{}\" is no link setting; known, as key=value: {}", item, known_settings()));
  }
  const std::string_view number = item.substr(equals + 1);
  const char* const all = number.data() + number.size();
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), all, value);
  const bool parsed = error == std::errc{} && end == all;
  if (!parsed || !fits(*setting, value)) return out_of_range(*setting, number);
  setting->set(profile, value);
  return std::nullopt;
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
    if (std::optional<Error> error = apply(*profile, next())) return std::move(*error);
  }
  return profile;
}

std::optional<Error> check_profile(const LinkProfile& profile) {
  for (const Setting& setting : kSettings) {
    const double value = setting.get(profile);
    if (!fits(setting, value)) return out_of_range(setting, fmt::format("{}", value));
  }
  return std::nullopt;
}

}  // namespace harpoon::sim
