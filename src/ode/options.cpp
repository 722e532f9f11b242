#include "ode/options.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <string_view>

namespace harpoon::ode {
namespace {

Error bad_value(std::string_view name, std::string_view value, std::string_view legal) {
  return {Errc::invalid_argument, fmt::format("{}={} is not known; use {}", name, value, legal)};
}

/// 1, 0 or unset.
Result<bool> read_switch(const char* name, const char* value) {
  const std::string_view text = value == nullptr ? "" : value;
  if (text.empty() || text == "0") return false;
  if (text == "1") return true;
  return bad_value(name, text, "1 or 0");
}

}  // namespace

Result<Options> read_options(const char* (*variable)(const char* name)) {
  Options options;
  const auto text_of = [&](const char* name) {
    const char* value = variable(name);
    return std::string_view(value == nullptr ? "" : value);
  };

  const std::string_view policy = text_of("HARPOON_ODE");
  if (policy == "fixed") {
    options.policy = Policy::fixed;
  } else if (policy == "strict") {
    options.policy = Policy::strict;
  } else if (!policy.empty() && policy != "compat") {
    return bad_value("HARPOON_ODE", policy, "compat, fixed or strict");
  }

  const Result<bool> verify = read_switch("HARPOON_VERIFY", variable("HARPOON_VERIFY"));
  if (!verify) return verify.error();
  options.verify = *verify;
  const Result<bool> statistics = read_switch("HARPOON_STATS", variable("HARPOON_STATS"));
  if (!statistics) return statistics.error();
  options.statistics = *statistics;

  if (const std::string_view device = text_of("HARPOON_DEVICE"); !device.empty()) {
    options.device = device;
  }
  const std::string_view precision = text_of("HARPOON_PRECISION");
  if (precision == "f32") {
    options.single_precision_contacts = true;
  } else if (!precision.empty() && precision != "exact") {
    return bad_value("HARPOON_PRECISION", precision, "exact or f32");
  }

  if (const std::string_view text = text_of("HARPOON_MIN_GEOMS"); !text.empty()) {
    int least = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), least);
    if (error != std::errc() || end != text.data() + text.size() || least < 0) {
      return bad_value("HARPOON_MIN_GEOMS", text, "a number of geoms, 0 or more");
    }
    options.min_geoms_simple = options.min_geoms_hash = options.min_geoms_sap =
        options.min_geoms_quadtree = options.min_geoms_scan = least;
  }
  return options;
}

}  // namespace harpoon::ode
