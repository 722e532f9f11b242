#pragma once

// The libodes of this process, under whatever names and however they were loaded, and which of them
// a call is for. A geom tells: its table of virtual functions lies in the libode that made it.
// Where there is no geom, the caller tells: it means the libode that it would reach without
// Harpoon.
//
// One that was found once stays loaded until the process ends.

#include <atomic>
#include <cstdint>

#include "ode/interposed.hpp"
#include "ode/service.hpp"

namespace harpoon::ode {

struct Libode {
  Interposed stock{};
  const char* path = "";
  void* handle = nullptr;  ///< for dlsym
  /// Other libraries may stand before it, as before any that the dynamic linker searches for all.
  bool is_global = false;
  std::uintptr_t begin = 0, size = 0;  ///< where it is mapped

  enum class State { untried, being_tried, tried };
  std::atomic<State> state{State::untried};
  std::atomic<Service*> service{nullptr};
  std::atomic<int> initialised{0};  ///< calls of dInitODE without one of dCloseODE
  /// What dCollide and dGeomMoved are for its geoms. Never null.
  std::atomic<Collide*> collide{nullptr};
  std::atomic<GeomMoved*> geom_moved{nullptr};

  Libode* next = nullptr;  ///< the one that was found before it

  [[nodiscard]] bool contains(std::uintptr_t address) const { return address - begin < size; }
};

/// The last that was found, and by `next` all others. Null: none.
inline constinit std::atomic<Libode*> libodes{nullptr};

/// Slow: looks at all that the process has loaded. Null when the object is no libode's.
Libode* find_libode_of(const void* object);

/// The libode that made a geom or space. Null when that is no libode's.
inline Libode* libode_of(const void* object) {
  const std::uintptr_t virtuals = *static_cast<const std::uintptr_t*>(object);
  for (Libode* libode = libodes.load(std::memory_order_acquire); libode != nullptr;
       libode = libode->next) {
    if (libode->contains(virtuals)) return libode;
  }
  return find_libode_of(object);
}

/// The libode that the function at the return address means, or null.
Libode* libode_of_caller(const void* return_address);

/// Its function of that name as a program would reach it, or null.
void* find_in_libode(const Libode& libode, const char* name);

/// Whether an address is in this library.
bool is_own(std::uintptr_t address);

/// Called when a libode was found and when one's `collide` or `geom_moved` was set.
void routes_changed();

}  // namespace harpoon::ode
