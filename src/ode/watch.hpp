#pragma once

// What dCollide and dGeomMoved are for the geoms of a libode that is served, once its engine has
// something to watch: functions without an argument for the engine, so one pair for each service.

#include <atomic>

#include "ode/guarded_service.hpp"
#include "ode/service.hpp"

namespace harpoon::ode {

/// Libodes of one process that are served; others are left to themselves.
inline constexpr int kMostServices = 4;

struct Watch {
  void* libode = nullptr;
  void (*set_collide)(void* libode, Collide* function) = nullptr;
  void (*set_geom_moved)(void* libode, GeomMoved* function) = nullptr;
  // libode's.
  Collide* stock_collide = nullptr;
  GeomMoved* stock_geom_moved = nullptr;
  // These tell the engine.
  Collide* collide = nullptr;
  GeomMoved* geom_moved = nullptr;
  std::atomic<Engine*> engine{nullptr};
  /// Kept here even where nothing came of it: other threads may be in it.
  std::atomic<ReportingService*> service{nullptr};

  /// Where libode has no such function that can be called there is nothing to watch.
  void watch_moves() {
    if (stock_geom_moved != nullptr) set_geom_moved(libode, geom_moved);
  }
  void ignore_moves() {
    if (stock_geom_moved != nullptr) set_geom_moved(libode, stock_geom_moved);
  }
  void watch_contacts() {
    if (stock_collide != nullptr) set_collide(libode, collide);
  }
};

extern Watch watches[kMostServices];

/// That of the request's number, which is below kMostServices.
Watch& watch_of(const ServiceRequest& request);

/// Calls `visit` with every service of this process.
template <class Visit>
void for_each_service(const Visit& visit) {
  for (int number = 0; number < kMostServices; ++number) {
    ReportingService* const service = watches[number].service.load(std::memory_order_acquire);
    if (service != nullptr) visit(*service);
  }
}

/// dCollide and dGeomMoved lead to libode again, and events to nobody.
void forget(const ServiceRequest& request);

}  // namespace harpoon::ode
