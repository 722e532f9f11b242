#include "apps/afu_entry.hpp"

namespace harpoon::app {

Result<std::unique_ptr<afu::AfuDevice>> open_afu(const AfuSettings&) {
  return Error{Errc::device_unavailable, std::string(afu::afu_absent_reason())};
}

CatalogEntry afu_entry(const std::string&) {
  const auto look = [] {
    return DeviceInfo{"afu", false, std::string(afu::afu_absent_reason()), true};
  };
  const auto open = [](unsigned) -> Result<std::unique_ptr<Device>> {
    return Error{Errc::device_unavailable, std::string(afu::afu_absent_reason())};
  };
  return {"afu", look, open, false};
}

}  // namespace harpoon::app
