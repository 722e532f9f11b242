#pragma once

// The devices that the command can open: those of the library, and those that only a program may
// put together (a device and the simulation behind it). A new one is one entry in `device_catalog`.

#include <functional>
#include <string>
#include <vector>

#include "bench/device_contestant.hpp"
#include "harpoon/device.hpp"

namespace harpoon::app {

/// A device by name. Its name is known without it.
struct CatalogEntry {
  std::string name;
  /// Looks whether it is there and what it is, which may take as long as to open it.
  std::function<DeviceInfo()> look;
  /// `threads` is for devices that have them (cpu): 0 means all.
  std::function<Result<std::unique_ptr<Device>>(unsigned threads)> open;
  bool has_threads = false;
};

/// The link of a simulated AFU, unless another is asked for.
inline constexpr const char* kDefaultAfuProfile = "harp";

/// Every device, available or not, cpu first; opens none. Throws CommandError (usage) for a link
/// profile that does not parse.
std::vector<CatalogEntry> device_catalog(const std::string& afu_profile = kDefaultAfuProfile);

/// Opens `selection`, "all" or a name, with each of `threads` where the device has threads and once
/// where it has none. "all" skips what is not available.
/// Throws CommandError: usage for an unknown name or profile, environment for a device that is not
/// available.
std::vector<bench::NamedDevice> open_devices(const std::string& selection,
                                             const std::vector<unsigned>& threads,
                                             const std::string& afu_profile = kDefaultAfuProfile);

/// `threads` with 0 replaced by the number of hardware threads, ascending, without repetitions.
std::vector<unsigned> thread_counts(std::vector<unsigned> threads);

/// "all" and the names in the catalogue, for help and completion.
std::string device_choices();

}  // namespace harpoon::app
