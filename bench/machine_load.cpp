#include "bench/machine_load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

double load_average() {
  double one_minute = -1;
  return ::getloadavg(&one_minute, 1) == 1 ? one_minute : -1;
}

// Microseconds since boot in which some task waited for a processor.
std::optional<std::uint64_t> waited_us() {
  constexpr std::string_view kTotal = "total=";
  std::ifstream file("/proc/pressure/cpu");
  for (std::string line; std::getline(file, line);) {
    const std::size_t at = line.find(kTotal);
    if (line.starts_with("some") && at != std::string::npos) {
      return std::strtoull(line.c_str() + at + kTotal.size(), nullptr, 10);
    }
  }
  return std::nullopt;
}

}  // namespace

bool MachineLoad::busy() const {
  constexpr double kMuchWaiting = 0.2;
  // The measurement itself is one task.
  constexpr double kOthers = 1.0;
  return waiting ? *waiting > kMuchWaiting : before > kOthers;
}

LoadWatch::LoadWatch() : before_(load_average()), start_ns_(now_ns()), waited_us_(waited_us()) {}

MachineLoad LoadWatch::look() const {
  MachineLoad load;
  load.before = before_;
  load.after = load_average();
  const std::optional<std::uint64_t> now_us = waited_us();
  const double elapsed_us = (now_ns() - start_ns_) * 1e-3;
  if (waited_us_ && now_us && elapsed_us > 0) {
    load.waiting = std::clamp(static_cast<double>(*now_us - *waited_us_) / elapsed_us, 0.0, 1.0);
  }
  return load;
}

std::string describe_load(const MachineLoad& load) {
  std::string text =
      load.before < 0 || load.after < 0
          ? "The kernel tells no load average"
          : fmt::format("Load average {:.1f} before, {:.1f} after", load.before, load.after);
  text += load.waiting ? fmt::format(
                             "; some task waited for a processor during {:.0f} % of the "
                             "time.",
                             100 * *load.waiting)
                       : ".";
  if (load.busy()) {
    text += " The machine was busy with other things: run again when it is not.";
  }
  return text;
}

}  // namespace harpoon::bench
