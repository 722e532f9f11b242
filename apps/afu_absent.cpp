#include "apps/afu_entry.hpp"
#include "device/afu/device.hpp"

namespace harpoon::app {

CatalogEntry afu_entry() {
  DeviceInfo info;
  info.name = "afu";
  info.modelled = true;
  info.description = afu::afu_absent_reason();
  const auto open = [](unsigned) -> Result<std::unique_ptr<Device>> {
    return Error{Errc::device_unavailable, std::string(afu::afu_absent_reason())};
  };
  return {std::move(info), open, false};
}

}  // namespace harpoon::app
