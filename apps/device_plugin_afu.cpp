// libharpoon_device_afu.so: the catalogue's AFU for programs under the drop-in.

#include "apps/afu_entry.hpp"
#include "harpoon/export.hpp"
#include "ode/device_plugin.hpp"

extern "C" HARPOON_API void harpoon_open_device(
    harpoon::Result<std::unique_ptr<harpoon::Device>>& device);

void harpoon_open_device(harpoon::Result<std::unique_ptr<harpoon::Device>>& device) {
  static_assert(std::is_same_v<decltype(harpoon_open_device), harpoon::ode::OpenDevicePlugin>);
  device = harpoon::app::afu_entry(harpoon::app::kDefaultAfuProfile).open(1);
}
