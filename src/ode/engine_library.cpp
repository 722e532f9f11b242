#include "ode/engine_library.hpp"

#include <dlfcn.h>
#include <link.h>

#include <atomic>
#include <climits>
#include <cstring>

#include "harpoon/ode.hpp"
#include "ode/arrival.hpp"
#include "ode/log.hpp"

namespace harpoon::ode {
namespace {

constexpr const char* kFile = "/libharpoon_ode_engine.so";

/// The folder of this library when it was loaded: the name that it was loaded by may be relative,
/// and the program's folder another one now. False when nobody knows.
bool own_folder(char (&folder)[PATH_MAX]) {
  Dl_info info{};
  void* map = nullptr;
  return dladdr1(reinterpret_cast<void*>(&own_folder), &info, &map, RTLD_DL_LINKMAP) != 0 &&
         dlinfo(map, RTLD_DI_ORIGIN, folder) == 0 && folder[0] == '/' &&
         std::strlen(folder) + std::strlen(kFile) < sizeof folder;
}

void* open_engine_library() {
  char path[PATH_MAX];
  if (!own_folder(path)) {
    write_log_line(LogLevel::error,
                   "the folder of libharpoon_ode.so is not known; harpoon does nothing");
    return nullptr;
  }
  std::strcat(path, kFile);
  // Never closed. Its symbols are its own.
  void* const library = dlopen(path, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
  if (library == nullptr) {
    const char* const reason = dlerror();
    write_log_line(LogLevel::error, {reason == nullptr ? path : reason, "; harpoon does nothing"});
  }
  return library;
}

void* find(void* libode, const char* name) {
  return find_in_libode(*static_cast<Libode*>(libode), name);
}

void* find_in_front(const char* name) {
  void* const found = dlsym(RTLD_DEFAULT, name);
  const auto address = reinterpret_cast<std::uintptr_t>(found);
  if (found == nullptr || is_own(address)) return found;
  for (const Libode* libode = libodes.load(std::memory_order_acquire); libode != nullptr;
       libode = libode->next) {
    if (libode->contains(address)) return nullptr;
  }
  return found;
}

void listen(void* libode, Service* service) {
  static_cast<Libode*>(libode)->service.store(service, std::memory_order_release);
}

void set_collide(void* libode, Collide* function) {
  static_cast<Libode*>(libode)->collide.store(function, std::memory_order_release);
  routes_changed();
}

void set_geom_moved(void* libode, GeomMoved* function) {
  static_cast<Libode*>(libode)->geom_moved.store(function, std::memory_order_release);
  routes_changed();
}

}  // namespace

void* find_in_engine_library(const char* name) {
  static constinit std::atomic<void*> opened{nullptr};
  static constinit std::atomic<bool> tried{false};
  void* library = opened.load(std::memory_order_acquire);
  if (library == nullptr) {
    // The linker lets threads in one by one and opens a file once. Said once what went wrong.
    if (tried.load(std::memory_order_acquire)) return nullptr;
    library = open_engine_library();
    opened.store(library, std::memory_order_release);
    tried.store(true, std::memory_order_release);
    if (library == nullptr) return nullptr;
  }
  return dlsym(library, name);
}

Service* serve(Libode& libode) {
  Libode::State untried = Libode::State::untried;
  // Nobody waits here for another thread, which may have to wait for the linker.
  if (!libode.state.compare_exchange_strong(untried, Libode::State::being_tried)) {
    return libode.service.load(std::memory_order_acquire);
  }
  static constinit std::atomic<int> served{0};
  Service* service = nullptr;
  if (void* const make = find_in_engine_library(kServeSymbol)) {
    service = reinterpret_cast<Serve*>(make)({.libode = &libode,
                                              .path = libode.path,
                                              .number = served.fetch_add(1),
                                              .is_initialised = libode.initialised.load() > 0,
                                              .find = &find,
                                              .find_in_front = &find_in_front,
                                              .listen = &listen,
                                              .set_collide = &set_collide,
                                              .set_geom_moved = &set_geom_moved});
  }
  if (service != nullptr) note_service();
  libode.service.store(service, std::memory_order_release);
  libode.state.store(Libode::State::tried, std::memory_order_release);
  return service;
}

void report_all() {
  for (Libode* libode = libodes.load(std::memory_order_acquire); libode != nullptr;
       libode = libode->next) {
    if (Service* const service = libode->service.load(std::memory_order_acquire)) service->report();
  }
}

}  // namespace harpoon::ode

extern "C" {

HARPOON_API bool harpoon_ode_make_collider(int real_bytes, const void* ode,
                                           const harpoon::ode::ColliderOptions* options,
                                           void* collider) {
  void* const make = harpoon::ode::find_in_engine_library("harpoon_ode_make_collider");
  return make != nullptr && reinterpret_cast<decltype(&harpoon_ode_make_collider)>(make)(
                                real_bytes, ode, options, collider);
}

}  // extern "C"
