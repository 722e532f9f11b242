#include "apps/afu_entry.hpp"
#include "device/afu/device.hpp"
#include "sim/simulated_link.hpp"

namespace harpoon::app {
namespace {

constexpr std::string_view kProfile = "harp";

Result<std::unique_ptr<Device>> open_simulated(unsigned) {
  const Result<sim::LinkProfile> profile = sim::find_profile(kProfile);
  if (!profile) {
    return profile.error();
  }
  Result<std::unique_ptr<sim::SimulatedLink>> link =
      sim::SimulatedLink::create({.profile = *profile});
  if (!link) {
    return link.error();
  }
  Result<std::unique_ptr<afu::AfuDevice>> device = afu::make_afu_device(std::move(*link));
  if (!device) {
    return device.error();
  }
  return std::unique_ptr<Device>(std::move(*device));
}

}  // namespace

CatalogEntry afu_entry() {
  DeviceInfo info;
  info.name = "afu";
  info.modelled = true;
  const Result<std::unique_ptr<Device>> device = open_simulated(1);
  info.available = device.ok();
  info.description = device ? (*device)->capabilities().description : device.error().message;
  return {std::move(info), open_simulated, false};
}

}  // namespace harpoon::app
