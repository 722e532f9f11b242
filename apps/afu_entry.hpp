#pragma once

// The AFU as the command composes it: a device behind a link. Which of afu_simulated.cpp and
// afu_absent.cpp defines it is decided at configure time: the simulation needs Verilator.

#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "apps/device_catalog.hpp"
#include "device/afu/device.hpp"

namespace harpoon::app {

struct AfuSettings {
  /// "harp", or a profile with numbers replaced: "harp,latency_ns=500".
  std::string profile = kDefaultAfuProfile;
  afu::AfuOptions options = {};
  /// Takes a VCD piece by piece; must not throw. Empty: none.
  std::function<void(std::string_view)> waveform = {};
};

/// Errors: device_unavailable (with how to get one), invalid_argument (profile).
Result<std::unique_ptr<afu::AfuDevice>> open_afu(const AfuSettings& settings);

/// The AFU behind that profile, or why there is none. Throws CommandError for a profile that does
/// not parse.
CatalogEntry afu_entry(const std::string& profile);

}  // namespace harpoon::app
