#pragma once

// Devices that the library itself cannot open, such as a simulated AFU: for a device NAME the file
// libharpoon_device_NAME.so beside libharpoon_ode.so makes it.

#include <memory>
#include <string_view>

#include "harpoon/device.hpp"

namespace harpoon::ode {

/// What such a file exports under this name with C linkage: the device or an error.
inline constexpr const char* kDevicePluginSymbol = "harpoon_open_device";
using OpenDevicePlugin = void(Result<std::unique_ptr<Device>>& device);

/// Errors: device_unavailable (no such file, or not of this build), or the plug-in's own.
Result<std::unique_ptr<Device>> open_device_plugin(std::string_view name);

}  // namespace harpoon::ode
