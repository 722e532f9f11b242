#include "apps/afu_entry.hpp"
#include "apps/exit_code.hpp"
#include "sim/simulated_link.hpp"

namespace harpoon::app {

Result<std::unique_ptr<afu::AfuDevice>> open_afu(const AfuSettings& settings) {
  const Result<sim::LinkProfile> profile = sim::parse_profile(settings.profile);
  if (!profile) {
    return profile.error();
  }
  Result<std::unique_ptr<sim::SimulatedLink>> link =
      sim::SimulatedLink::create({.profile = *profile, .waveform = settings.waveform});
  if (!link) {
    return link.error();
  }
  return afu::make_afu_device(std::move(*link), settings.options);
}

CatalogEntry afu_entry(const std::string& profile) {
  value_or_throw(sim::parse_profile(profile));
  const auto open = [profile](unsigned) -> Result<std::unique_ptr<Device>> {
    Result<std::unique_ptr<afu::AfuDevice>> device = open_afu({.profile = profile});
    if (!device) {
      return device.error();
    }
    return std::unique_ptr<Device>(std::move(*device));
  };
  const auto look = [open] {
    const Result<std::unique_ptr<Device>> device = open(1);
    return DeviceInfo{"afu", device.ok(),
                      device ? (*device)->capabilities().description : device.error().message,
                      true};
  };
  return {"afu", look, open, false};
}

}  // namespace harpoon::app
