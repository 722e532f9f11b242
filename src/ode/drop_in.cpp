#include "ode/drop_in.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "ode/change_test.hpp"
#include "ode/device_plugin.hpp"
#include "ode/guarded_service.hpp"
#include "ode/log.hpp"
#include "ode/watch.hpp"

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
  return std::make_unique<FallbackDevice>(
      std::move(*wanted), std::move(*cpu),
      [](LogLevel level, std::string_view line) { write_log_line(level, line); });
}

/// Writes a new file in the current folder; what has that name already is left alone. Its path, or
/// nothing.
std::string write_difference(const std::string& text) {
  std::error_code error;
  const std::filesystem::path path =
      std::filesystem::current_path(error) / fmt::format("harpoon-difference-{}.txt", ::getpid());
  if (error) return {};
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (file < 0) return {};
  std::string_view rest = text;
  while (!rest.empty()) {
    const ssize_t written = ::write(file, rest.data(), rest.size());
    if (written <= 0) break;
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  return ::close(file) == 0 && rest.empty() ? path.string() : std::string();
}

/// Ends the process; the frame goes to a file.
[[noreturn]] void stop(const std::string& difference, const CollisionFrame* frame) {
  write_log_line(LogLevel::error, {"HARPOON_VERIFY: ", difference});
  if (frame != nullptr) {
    const std::string path = write_difference(to_text(*frame));
    write_log_line(LogLevel::info, path.empty()
                                       ? std::string("the difference could not be written to a new "
                                                     "file in the current folder")
                                       : fmt::format("`harpoon replay {}` repeats it", path));
  }
  std::abort();
}

/// What the user asks for; null when that is wrong, which is said once.
const Options* options_of_process() {
  static const std::optional<Options> kOptions = []() -> std::optional<Options> {
    Result<Options> options = read_options(&environment_variable);
    if (options) return std::move(*options);
    write_log_line(LogLevel::error, {options.error().message, "; harpoon does nothing"});
    return std::nullopt;
  }();
  return kOptions ? &*kOptions : nullptr;
}

bool is_single_precision(const ServiceRequest& request) {
  const auto configuration =
      reinterpret_cast<const char* (*)()>(request.find(request.libode, "dGetConfiguration"));
  // Older than that function: those had no single precision in any package.
  return configuration != nullptr &&
         std::string_view(configuration()).find("ODE_single_precision") != std::string_view::npos;
}

/// The process whose calls are counted: not one that has only borrowed its memory (vfork).
std::atomic<pid_t> counted_process{0};

void report_services() {
  if (::getpid() != counted_process.load()) return;
  for_each_service([](ReportingService& service) { service.report(); });
}

void begin_anew_in_copy() {
  counted_process.store(::getpid());
  for_each_service([](ReportingService& service) { service.forked(); });
}

/// Once: the lines of statistics are written however the process ends by itself.
void report_at_end() {
  if (counted_process.exchange(::getpid()) != 0) return;
  std::atexit(&report_services);
  std::at_quick_exit(&report_services);
  ::pthread_atfork(nullptr, nullptr, &begin_anew_in_copy);
}

template <class Real>
Service* make(const ServiceRequest& request, Options options) {
  LibodeOf<Real> ode;
  std::string_view missing;
  const auto find = [&](const char* name) { return request.find(request.libode, name); };
  if (!resolve(ode, find, missing)) {
    write_log_line(LogLevel::error, {request.path, " has no ", missing, "; it is left to itself"});
    return nullptr;
  }
  Watch& watch = watch_of(request);
  auto* const service = new GuardedService<Real>(
      ode, request.number == 0 ? std::string() : fmt::format("{}: ", request.path));
  watch.service.store(service);
  const std::string deaf = unheard_change<Real>(request, *service);
  options.changes_are_reported = deaf.empty();
  if (!deaf.empty()) {
    write_log_line(LogLevel::warning,
                   {request.path, " does not tell of every change (not of ", deaf,
                    "): all geoms are read in every call, which is slower"});
  }
  std::unique_ptr<Device> device = open_contact_device(options);
  if (!device) return nullptr;
  Result<std::unique_ptr<Engine>> engine = make_engine<Real>(
      ode, {.options = options,
            .device = std::move(device),
            .log = [](LogLevel level, std::string_view line) { write_log_line(level, line); },
            .differs = &stop,
            .before_first_space = [&watch] { watch.watch_moves(); },
            .without_spaces = [&watch] { watch.ignore_moves(); },
            .before_first_frame = [&watch] { watch.watch_contacts(); }});
  if (!engine) return nullptr;
  watch.engine.store(engine->get(), std::memory_order_release);
  service->engine_is(std::move(*engine), options.statistics);
  if (options.statistics) report_at_end();
  return service;
}

}  // namespace
}  // namespace harpoon::ode

extern "C" harpoon::ode::Service* harpoon_ode_serve(const harpoon::ode::ServiceRequest& request) {
  using namespace harpoon::ode;
  Service* service = nullptr;
  try {
    const Options* const options = options_of_process();
    if (options == nullptr) return nullptr;
    if (request.number >= kMostServices) {
      write_log_line(harpoon::LogLevel::warning,
                     {request.path, " is one libode too many; it is left to itself"});
      return nullptr;
    }
    service = is_single_precision(request) ? make<float>(request, *options)
                                           : make<double>(request, *options);
  } catch (const std::bad_alloc&) {
    write_log_line(harpoon::LogLevel::error,
                   {"out of memory; ", request.path, " is left to itself"});
  } catch (const std::exception& error) {
    write_log_line(harpoon::LogLevel::error,
                   {error.what(), "; ", request.path, " is left to itself"});
  }
  if (service == nullptr) forget(request);
  return service;
}
