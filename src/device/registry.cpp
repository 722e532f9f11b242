// The list of devices that the library itself can open. A program may compose others.

#include <fmt/format.h>

#include <new>

#include "harpoon/device.hpp"

namespace harpoon {

std::vector<DeviceInfo> list_devices() {
  std::vector<DeviceInfo> devices;
  if (const auto cpu = make_cpu_device()) {
    devices.push_back({.name = "cpu",
                       .available = true,
                       .description = (*cpu)->capabilities().description,
                       .modelled = false});
  }
  return devices;
}

Result<std::unique_ptr<Device>> open_device(std::string_view name) noexcept {
  try {
    if (name == "cpu") return make_cpu_device();
    std::vector<std::string> known;
    for (const DeviceInfo& device : list_devices()) known.push_back(device.name);
    return Error{Errc::invalid_argument, fmt::format("there is no device \"{}\"; known devices: {}",
                                                     name, fmt::join(known, ", "))};
  } catch (const std::bad_alloc&) {
    return Error{Errc::out_of_memory, "out of memory"};
  }
}

}  // namespace harpoon
