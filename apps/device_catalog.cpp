#include "apps/device_catalog.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "apps/afu_entry.hpp"
#include "apps/exit_code.hpp"

namespace harpoon::app {
namespace {

constexpr const char* kCpu = "cpu";

Result<std::unique_ptr<Device>> open_cpu(unsigned threads) {
  CpuOptions options;
  options.threads = threads;
  return make_cpu_device(options);
}

void open_entry(const CatalogEntry& entry, const std::vector<unsigned>& threads,
                std::vector<bench::NamedDevice>& opened) {
  const std::vector<unsigned> wanted =
      entry.has_threads ? thread_counts(threads) : std::vector<unsigned>{1};
  for (const unsigned t : wanted) {
    opened.push_back({entry.info.name, t, value_or_throw(entry.open(t))});
  }
}

}  // namespace

std::vector<CatalogEntry> device_catalog(const std::string& afu_profile) {
  std::vector<CatalogEntry> entries;
  for (DeviceInfo& info : list_devices()) {
    const std::string name = info.name;
    if (name == kCpu) {
      entries.push_back({std::move(info), open_cpu, true});
    } else {
      entries.push_back({std::move(info), [name](unsigned) { return open_device(name); }, false});
    }
  }
  entries.push_back(afu_entry(afu_profile));
  return entries;
}

std::vector<bench::NamedDevice> open_devices(const std::string& selection,
                                             const std::vector<unsigned>& threads,
                                             const std::string& afu_profile) {
  std::vector<bench::NamedDevice> opened;
  bool is_known = selection == "all";
  for (const CatalogEntry& entry : device_catalog(afu_profile)) {
    if (selection == "all" && entry.info.available) {
      open_entry(entry, threads, opened);
    } else if (selection == entry.info.name) {
      is_known = true;
      if (!entry.info.available) {
        throw CommandError(ExitCode::environment, fmt::format("Device {} is not available: {}",
                                                              selection, entry.info.description));
      }
      open_entry(entry, threads, opened);
    }
  }
  if (!is_known) {
    throw CommandError(ExitCode::usage,
                       fmt::format("--device: there is no device {}. Use one of {}.", selection,
                                   device_choices()));
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
    choices += "|" + entry.info.name;
  }
  return choices;
}

}  // namespace harpoon::app
