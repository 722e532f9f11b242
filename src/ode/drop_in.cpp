#include "ode/drop_in.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <fstream>
#include <string_view>
#include <utility>

#include "ode/device_plugin.hpp"
#include "ode/interposed.hpp"
#include "ode/log.hpp"

namespace harpoon::ode {
namespace {

constexpr std::string_view kCpu = "cpu";

const char* environment_variable(const char* name) {
  return std::getenv(name);
}

/// The device for contacts: the wanted one with cpu behind it, or cpu.
std::unique_ptr<Device> open_contact_device(const Options& options) {
  // Blocks of contacts are small; threads would only get in the program's way.
  Result<std::unique_ptr<Device>> cpu = make_cpu_device({.threads = 1});
  if (!cpu) {
    write_log_line(LogLevel::error, cpu.error().message);
    return nullptr;
  }
  if (options.device == kCpu) return std::move(*cpu);
  Result<std::unique_ptr<Device>> wanted = open_device_plugin(options.device);
  if (!wanted) {
    write_log_line(LogLevel::warning,
                   fmt::format("{}; contacts come from cpu", wanted.error().message));
    return std::move(*cpu);
  }
  if (!options.single_precision_contacts && !(*wanted)->capabilities().f64) {
    write_log_line(LogLevel::warning,
                   fmt::format("{} computes in binary32 only and libode in binary64; contacts come "
                               "from cpu (HARPOON_PRECISION=f32 to use it all the same)",
                               options.device));
    return std::move(*cpu);
  }
  return std::make_unique<FallbackDevice>(std::move(*wanted), std::move(*cpu), &write_log_line);
}

/// Ends the process; the frame goes to a file in the current folder.
[[noreturn]] void stop(const std::string& difference, const CollisionFrame* frame) {
  write_log_line(LogLevel::error, fmt::format("HARPOON_VERIFY: {}", difference));
  if (frame != nullptr) {
    const std::string name = fmt::format("harpoon-difference-{}.txt", ::getpid());
    std::ofstream file(name);
    file << to_text(*frame);
    file.close();
    write_log_line(LogLevel::info, file ? fmt::format("`harpoon replay {}` repeats it", name)
                                        : fmt::format("{} could not be written", name));
  }
  std::abort();
}

template <class Real>
std::unique_ptr<Engine> make(const Options& options, std::unique_ptr<Device> device) {
  LibodeOf<Real> ode;
  std::string_view missing;
  if (!resolve(ode, &find_in_libode, missing)) {
    write_log_line(LogLevel::error,
                   fmt::format("this libode has no {}; harpoon does nothing", missing));
    return nullptr;
  }
  Result<std::unique_ptr<Engine>> engine =
      make_engine<Real>(ode, {.options = options,
                              .device = std::move(device),
                              .log = &write_log_line,
                              .differs = &stop,
                              .before_first_space = &watch_moves,
                              .before_first_frame = &watch_contacts});
  return engine ? std::move(*engine) : nullptr;
}

std::unique_ptr<Engine> make_drop_in() {
  const Result<Options> options = read_options(&environment_variable);
  if (!options) {
    write_log_line(LogLevel::error,
                   fmt::format("{}; harpoon does nothing", options.error().message));
    return nullptr;
  }
  std::unique_ptr<Device> device = open_contact_device(*options);
  if (!device) return nullptr;
  const std::string_view configuration = libode().get_configuration();
  const bool is_single = configuration.find("ODE_single_precision") != std::string_view::npos;
  return is_single ? make<float>(*options, std::move(device))
                   : make<double>(*options, std::move(device));
}

void write_statistics() {
  if (const Engine* engine = drop_in_if_made()) write_log_line(LogLevel::info, engine->report());
}

}  // namespace

Engine* drop_in() {
  static Engine* const kEngine = [] {
    Engine* const the_engine = make_drop_in().release();
    made_drop_in.store(the_engine, std::memory_order_release);
    const char* const statistics = std::getenv("HARPOON_STATS");
    if (the_engine != nullptr && statistics != nullptr && std::string_view(statistics) == "1") {
      std::atexit(&write_statistics);
    }
    return the_engine;
  }();
  return kEngine;
}

}  // namespace harpoon::ode
