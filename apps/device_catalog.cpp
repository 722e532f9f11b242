#include "apps/device_catalog.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "apps/afu_entry.hpp"
#include "apps/exit_code.hpp"
#include "apps/printable.hpp"

namespace harpoon::app {
namespace {

constexpr const char* kCpu = "cpu";

Result<std::unique_ptr<Device>> open_cpu(unsigned threads) {
  CpuOptions options;
  options.threads = threads;
  return make_cpu_device(options);
}

/// The library lists cpu where it can be made.
DeviceInfo look_at_cpu() {
  for (DeviceInfo& info : list_devices()) {
    if (info.name == kCpu) return std::move(info);
  }
  return {.name = kCpu, .description = "it cannot be made: too little memory"};
}

void open_entry(const CatalogEntry& entry, const std::vector<unsigned>& threads,
                std::vector<bench::NamedDevice>& opened) {
  const std::vector<unsigned> wanted =
      entry.has_threads ? thread_counts(threads) : std::vector<unsigned>{1};
  for (const unsigned t : wanted) {
    opened.push_back({entry.name, t, value_or_throw(entry.open(t))});
  }
}

}  // namespace

std::vector<CatalogEntry> device_catalog(const std::string& afu_profile) {
  return {{kCpu, look_at_cpu, open_cpu, true}, afu_entry(afu_profile)};
}

std::vector<bench::NamedDevice> open_devices(const std::string& selection,
                                             const std::vector<unsigned>& threads,
                                             const std::string& afu_profile) {
  std::vector<bench::NamedDevice> opened;
  bool is_known = selection == "all";
  for (const CatalogEntry& entry : device_catalog(afu_profile)) {
    if (selection != "all" && selection != entry.name) continue;
    is_known = true;
    const DeviceInfo info = entry.look();
    if (info.available) {
      open_entry(entry, threads, opened);
    } else if (selection != "all") {
      throw CommandError(ExitCode::environment, fmt::format("Device {} is not available: {}",
                                                            selection, info.description));
    }
  }
  if (!is_known) {
    throw CommandError(ExitCode::usage,
                       fmt::format("--device: there is no device {}. Use one of {}.",
                                   in_quotes(selection), device_choices()));
  }
  return opened;
}

std::vector<unsigned> thread_counts(std::vector<unsigned> threads) {
  std::replace(threads.begin(), threads.end(), 0U,
               std::max(1U, std::thread::hardware_concurrency()));
  std::sort(threads.begin(), threads.end());
  threads.erase(std::unique(threads.begin(), threads.end()), threads.end());
  return threads;
}

std::string device_choices() {
  std::string choices = "all";
  for (const CatalogEntry& entry : device_catalog()) {
    choices += "|" + entry.name;
  }
  return choices;
}

}  // namespace harpoon::app
