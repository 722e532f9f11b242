#include "ode/watch.hpp"

#include <utility>

#include "ode/frame.hpp"

namespace harpoon::ode {

Watch watches[kMostServices];

namespace {

template <int kNumber>
int collide_watched(dxGeom* o1, dxGeom* o2, int flags, void* contact, int skip) {
  const Watch& watch = watches[kNumber];
  if (open_frames == 0) [[likely]]
    return watch.stock_collide(o1, o2, flags, contact, skip);
  return watch.engine.load(std::memory_order_relaxed)->collide(o1, o2, flags, contact, skip);
}

template <int kNumber>
void move_watched(dxGeom* geom) {
  const Watch& watch = watches[kNumber];
  if (open_frames != 0) [[unlikely]] {
    watch.engine.load(std::memory_order_relaxed)->changing(geom, Change::moved);
  }
  watch.stock_geom_moved(geom);
  if (geom != nullptr) watch.engine.load(std::memory_order_relaxed)->moved(geom);
}

template <int... kNumbers>
void fill(Watch& watch, int number, std::integer_sequence<int, kNumbers...>) {
  static constexpr Collide* kCollide[] = {&collide_watched<kNumbers>...};
  static constexpr GeomMoved* kGeomMoved[] = {&move_watched<kNumbers>...};
  watch.collide = kCollide[number];
  watch.geom_moved = kGeomMoved[number];
}

}  // namespace

Watch& watch_of(const ServiceRequest& request) {
  Watch& watch = watches[request.number];
  if (watch.libode == request.libode) return watch;
  watch.libode = request.libode;
  watch.set_collide = request.set_collide;
  watch.set_geom_moved = request.set_geom_moved;
  watch.stock_collide = reinterpret_cast<Collide*>(request.find(request.libode, "dCollide"));
  watch.stock_geom_moved = reinterpret_cast<GeomMoved*>(request.find(request.libode, "dGeomMoved"));
  fill(watch, request.number, std::make_integer_sequence<int, kMostServices>());
  return watch;
}

void forget(const ServiceRequest& request) {
  request.listen(request.libode, nullptr);
  if (request.number >= kMostServices) return;
  Watch& watch = watch_of(request);
  if (watch.stock_collide != nullptr) request.set_collide(request.libode, watch.stock_collide);
  if (watch.stock_geom_moved != nullptr) {
    request.set_geom_moved(request.libode, watch.stock_geom_moved);
  }
}

}  // namespace harpoon::ode
