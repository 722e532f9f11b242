// The symbols of libode that the drop-in stands in front of. Each does what libode does and tells
// the engine; nothing is decided here. None takes or returns a floating-point number, so they serve
// libode in both precisions.

#include <atomic>

#include "harpoon/export.hpp"
#include "ode/drop_in.hpp"
#include "ode/frame.hpp"
#include "ode/interposed.hpp"

extern "C" {
HARPOON_API int dCollide(dxGeom* o1, dxGeom* o2, int flags, void* contact, int skip);
HARPOON_API void dGeomMoved(dxGeom* geom);
}

namespace {

using harpoon::ode::AabbTest;
using harpoon::ode::Change;
using harpoon::ode::drop_in;
using harpoon::ode::drop_in_if_made;
using harpoon::ode::Engine;
using harpoon::ode::libode;
using harpoon::ode::NearCallback;

/// dGeomClass.
struct GeomClass {
  int bytes;
  void* collider;
  void* aabb;
  AabbTest* aabb_test;
  void* destructor;
};

using Collide = int(dxGeom*, dxGeom*, int, void*, int);
using GeomMoved = void(dxGeom*);

Collide find_and_collide, watch_collide;
GeomMoved find_and_move, watch_move;

// The two functions that programs call most often are one jump each. It leads to libode until the
// engine has pairs of its own or knows a space, which in programs with small spaces only it never
// does.
constinit std::atomic<Collide*> next_collide{&find_and_collide};
constinit std::atomic<GeomMoved*> next_geom_moved{&find_and_move};
// libode's, where they are asked for once there is something to watch.
constinit std::atomic<Collide*> stock_collide{nullptr};
constinit std::atomic<GeomMoved*> stock_geom_moved{nullptr};

int find_and_collide(dxGeom* o1, dxGeom* o2, int flags, void* contact, int skip) {
  Collide* expected = &find_and_collide;
  next_collide.compare_exchange_strong(expected, libode().collide);
  return dCollide(o1, o2, flags, contact, skip);
}

void find_and_move(dxGeom* geom) {
  GeomMoved* expected = &find_and_move;
  next_geom_moved.compare_exchange_strong(expected, libode().geom_moved);
  dGeomMoved(geom);
}

/// To be called before libode makes a change.
void changing(dxGeom* geom, Change change) {
  if (harpoon::ode::open_frames != 0) [[unlikely]]
    drop_in_if_made()->changing(geom, change);
}

int watch_collide(dxGeom* o1, dxGeom* o2, int flags, void* contact, int skip) {
  if (harpoon::ode::open_frames == 0) [[likely]] {
    return stock_collide.load(std::memory_order_relaxed)(o1, o2, flags, contact, skip);
  }
  return drop_in_if_made()->collide(o1, o2, flags, contact, skip);
}

void watch_move(dxGeom* geom) {
  changing(geom, Change::moved);
  stock_geom_moved.load(std::memory_order_relaxed)(geom);
  if (geom != nullptr) drop_in_if_made()->moved(geom);
}

Engine* engine_for_calls() {
  Engine* const engine = drop_in_if_made();
  return engine != nullptr ? engine : drop_in();
}

void set_enabled(dxGeom* geom, bool enabled, void (*set)(dxGeom*)) {
  Engine* const engine = drop_in_if_made();
  const bool changes =
      engine != nullptr && geom != nullptr && (libode().geom_is_enabled(geom) != 0) != enabled;
  if (changes) changing(geom, enabled ? Change::enabled : Change::disabled);
  set(geom);
  if (changes) engine->toggled(geom);
}

}  // namespace

namespace harpoon::ode {

void watch_moves() {
  stock_geom_moved.store(libode().geom_moved, std::memory_order_relaxed);
  next_geom_moved.store(&watch_move, std::memory_order_release);
}

void watch_contacts() {
  stock_collide.store(libode().collide, std::memory_order_relaxed);
  next_collide.store(&watch_collide, std::memory_order_release);
}

}  // namespace harpoon::ode

extern "C" {

HARPOON_API void dSpaceCollide(dxSpace* space, void* data, NearCallback* callback) {
  Engine* const engine = engine_for_calls();
  if (engine == nullptr) return libode().space_collide(space, data, callback);
  engine->space_collide(space, data, callback);
}

HARPOON_API void dSpaceCollide2(dxGeom* o1, dxGeom* o2, void* data, NearCallback* callback) {
  Engine* const engine = engine_for_calls();
  if (engine == nullptr) return libode().space_collide2(o1, o2, data, callback);
  engine->space_collide2(o1, o2, data, callback);
}

HARPOON_API int dCollide(dxGeom* o1, dxGeom* o2, int flags, void* contact, int skip) {
  return next_collide.load(std::memory_order_acquire)(o1, o2, flags, contact, skip);
}

HARPOON_API void dGeomMoved(dxGeom* geom) {
  next_geom_moved.load(std::memory_order_acquire)(geom);
}

HARPOON_API void dGeomDestroy(dxGeom* geom) {
  if (Engine* const engine = drop_in_if_made()) engine->destroying(geom);
  libode().geom_destroy(geom);
}

HARPOON_API void dGeomSetBody(dxGeom* geom, dxBody* body) {
  changing(geom, Change::filter);
  libode().geom_set_body(geom, body);
  if (Engine* const engine = drop_in_if_made()) engine->filters_changed(geom);
}

HARPOON_API void dGeomSetCategoryBits(dxGeom* geom, unsigned long bits) {
  changing(geom, Change::filter);
  libode().geom_set_category_bits(geom, bits);
  if (Engine* const engine = drop_in_if_made()) engine->filters_changed(geom);
}

HARPOON_API void dGeomSetCollideBits(dxGeom* geom, unsigned long bits) {
  changing(geom, Change::filter);
  libode().geom_set_collide_bits(geom, bits);
  if (Engine* const engine = drop_in_if_made()) engine->filters_changed(geom);
}

HARPOON_API void dGeomEnable(dxGeom* geom) {
  set_enabled(geom, true, libode().geom_enable);
}

HARPOON_API void dGeomDisable(dxGeom* geom) {
  set_enabled(geom, false, libode().geom_disable);
}

HARPOON_API void dSpaceAdd(dxSpace* space, dxGeom* geom) {
  changing(harpoon::ode::as_geom(space), Change::members);
  libode().space_add(space, geom);
  if (Engine* const engine = drop_in_if_made()) engine->added(space);
}

HARPOON_API void dSpaceRemove(dxSpace* space, dxGeom* geom) {
  changing(harpoon::ode::as_geom(space), Change::members);
  libode().space_remove(space, geom);
  if (Engine* const engine = drop_in_if_made()) engine->removed(space, geom);
}

HARPOON_API void dHashSpaceSetLevels(dxSpace* space, int min_level, int max_level) {
  libode().hash_space_set_levels(space, min_level, max_level);
  if (Engine* const engine = drop_in_if_made()) engine->levels_changed(space);
}

HARPOON_API dxSpace* dSweepAndPruneSpaceCreate(dxSpace* parent, int axis_order) {
  dxSpace* const space = libode().sap_space_create(parent, axis_order);
  if (Engine* const engine = drop_in()) engine->sap_created(space, axis_order);
  return space;
}

HARPOON_API int dCreateGeomClass(const GeomClass* geom_class) {
  AabbTest* const test = geom_class == nullptr ? nullptr : geom_class->aabb_test;
  const int number = libode().create_geom_class(geom_class);
  if (Engine* const engine = drop_in()) engine->class_created(number, test);
  return number;
}

HARPOON_API void dSetColliderOverride(int class1, int class2, void* function) {
  libode().set_collider_override(class1, class2, function);
  if (Engine* const engine = drop_in()) engine->collider_overridden(class1, class2);
}

HARPOON_API void dCloseODE() {
  if (Engine* const engine = drop_in_if_made()) engine->closed();
  libode().close_ode();
}

}  // extern "C"
