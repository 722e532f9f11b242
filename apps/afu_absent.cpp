#include "apps/afu_entry.hpp"

namespace harpoon::app {

Result<std::unique_ptr<afu::AfuDevice>> open_afu(const AfuSettings&) {
  return Error{Errc::device_unavailable, std::string(afu::afu_absent_reason())};
}

CatalogEntry afu_entry(const std::string&) {
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
