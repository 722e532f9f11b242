#include "bench/machine.hpp"

#include <sched.h>
#include <sys/sysinfo.h>
#include <sys/utsname.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>

#include "generated/commit.hpp"
#include "harpoon/harpoon.hpp"

#if HARPOON_WITH_ODE
#include "bench/ode/runtime.hpp"
#endif

namespace harpoon::bench {
namespace {

// The value after `separator` on the first line of `path` that starts with `key`.
std::string field_of(const char* path, const std::string& key, char separator) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with(key)) {
      std::string value = line.substr(line.find(separator) + 1);
      const auto first = value.find_first_not_of(" \t\"");
      const auto last = value.find_last_not_of(" \t\"");
      return first == std::string::npos ? "unknown" : value.substr(first, last - first + 1);
    }
  }
  return "unknown";
}

unsigned usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return sched_getaffinity(0, sizeof set, &set) == 0 ? static_cast<unsigned>(CPU_COUNT(&set)) : 1;
}

double memory_gb() {
  struct sysinfo info {};
  if (sysinfo(&info) != 0) {
    return 0;
  }
  return static_cast<double>(info.totalram) * static_cast<double>(info.mem_unit) / 1e9;
}

// The kernel tells a size as "32768K".
double cache_mb() {
  constexpr double kMbPerKib = 1024e-6;
  double largest = 0;
  for (int index = 0; index < 8; ++index) {
    std::ifstream file("/sys/devices/system/cpu/cpu0/cache/index" + std::to_string(index) +
                       "/size");
    double kib = 0;
    if (file >> kib) {
      largest = std::max(largest, kib * kMbPerKib);
    }
  }
  return largest;
}

std::string kernel() {
  utsname name{};
  if (uname(&name) != 0) {
    return "unknown";
  }
  return std::string(name.sysname) + " " + name.release + " " + name.machine;
}

std::string compiler() {
#if defined(__clang__)
  return "clang++ " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

std::string ode() {
#if HARPOON_WITH_ODE
  return ode_version();
#else
  return "absent";
#endif
}

}  // namespace

Machine describe_machine() {
  const std::vector<std::string> sets = cpu_instruction_sets();
  return {field_of("/proc/cpuinfo", "model name", ':'),
          usable_cores(),
          memory_gb(),
          field_of("/etc/os-release", "PRETTY_NAME", '='),
          kernel(),
          compiler(),
          sets.empty() ? "scalar" : sets.back(),
          ode(),
          std::string(version()),
          cache_mb()};
}

std::string build_commit() {
  return std::string(kCommit);
}

std::string timestamp() {
  const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[sizeof "2026-01-01T00:00:00Z"];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace harpoon::bench
