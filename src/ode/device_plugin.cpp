#include "ode/device_plugin.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <string>

namespace harpoon::ode {
namespace {

/// The folder of the library that this code is in, with a slash, or nothing.
std::string own_folder() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&open_device_plugin), &info) == 0) return {};
  const std::string path = info.dli_fname;
  return path.substr(0, path.rfind('/') + 1);
}

/// A name becomes part of a path: letters, digits and underscores only.
bool is_plain(std::string_view name) {
  return name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string_view::npos;
}

}  // namespace

Result<std::unique_ptr<Device>> open_device_plugin(std::string_view name) {
  if (!is_plain(name)) {
    return Error{Errc::device_unavailable, fmt::format("there is no device \"{}\"", name)};
  }
  const std::string file = fmt::format("{}libharpoon_device_{}.so", own_folder(), name);
  void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    return Error{Errc::device_unavailable,
                 fmt::format("there is no device \"{}\": {}", name, dlerror())};
  }
  void* const symbol = dlsym(library, kDevicePluginSymbol);
  if (symbol == nullptr) {
    return Error{Errc::device_unavailable, fmt::format("{} makes no device", file)};
  }
  Result<std::unique_ptr<Device>> device =
      Error{Errc::device_unavailable, fmt::format("{} made no device", file)};
  reinterpret_cast<OpenDevicePlugin*>(symbol)(device);
  return device;
}

}  // namespace harpoon::ode
