// The symbols of libode that the drop-in stands in front of. Each does what libode does and tells
// the service of that libode; nothing is decided here. None takes or returns a floating-point
// number, so they serve libode in both precisions. This file needs no C++ run time.

#include <atomic>

#include "harpoon/export.hpp"
#include "ode/arrival.hpp"
#include "ode/engine_library.hpp"
#include "ode/libodes.hpp"
#include "ode/log.hpp"

extern "C" {
HARPOON_API int dCollide(dxGeom* o1, dxGeom* o2, int flags, void* contact, int skip);
HARPOON_API void dGeomMoved(dxGeom* geom);
}

namespace {

using harpoon::LogLevel;
using harpoon::ode::AabbTest;
using harpoon::ode::Change;
using harpoon::ode::Collide;
using harpoon::ode::GeomMoved;
using harpoon::ode::Interposed;
using harpoon::ode::Libode;
using harpoon::ode::libode_of;
using harpoon::ode::libode_of_caller;
using harpoon::ode::libodes;
using harpoon::ode::NearCallback;
using harpoon::ode::Service;
using harpoon::ode::write_log_line;

/// dGeomClass.
struct GeomClass {
  int bytes;
  void* collider;
  void* aabb;
  AabbTest* aabb_test;
  void* destructor;
};

Collide collide_by_geom;
GeomMoved move_by_geom;

// The two functions that programs call most often are one jump each. Where the process has one
// libode it leads there until its service has pairs of its own or knows a space, which in programs
// with small spaces only it never does.
constinit std::atomic<Collide*> next_collide{&collide_by_geom};
constinit std::atomic<GeomMoved*> next_geom_moved{&move_by_geom};

/// The libode of a call, by its geom if there is one.
Libode* libode_for(const void* object, const void* return_address) {
  Libode* const libode = object == nullptr ? nullptr : libode_of(object);
  return libode != nullptr ? libode : libode_of_caller(return_address);
}

/// Once: a program that goes on without a function may call it often.
void say_missing(const Libode* libode, const char* name) {
  static constinit std::atomic_flag said;
  if (said.test_and_set()) return;
  write_log_line(LogLevel::error, {libode == nullptr ? "no libode of this process" : libode->path,
                                   " has no ", name, "; its calls do nothing"});
}

/// What libode does, or nothing where it has no such function.
template <class Value, class... Arguments>
Value call_stock(const Libode* libode, Value (*Interposed::*function)(Arguments...),
                 const char* name, Arguments... arguments) {
  if (libode != nullptr && libode->stock.*function != nullptr) {
    return (libode->stock.*function)(arguments...);
  }
  say_missing(libode, name);
  return Value();
}

int collide_by_geom(dxGeom* o1, dxGeom* o2, int flags, void* contact, int skip) {
  const Libode* const libode = libode_for(o1 != nullptr ? o1 : o2, __builtin_return_address(0));
  if (libode == nullptr) return say_missing(libode, "dCollide"), 0;
  return libode->collide.load(std::memory_order_acquire)(o1, o2, flags, contact, skip);
}

void move_by_geom(dxGeom* geom) {
  const Libode* const libode = libode_for(geom, __builtin_return_address(0));
  if (libode == nullptr) return say_missing(libode, "dGeomMoved");
  libode->geom_moved.load(std::memory_order_acquire)(geom);
}

/// Who is to be told of an event, or null.
Service* listener_of(const Libode* libode) {
  return libode == nullptr ? nullptr : libode->service.load(std::memory_order_acquire);
}

/// The same for what a service must know from the beginning.
Service* service_of(Libode* libode) {
  if (libode == nullptr) return nullptr;
  Service* const service = libode->service.load(std::memory_order_acquire);
  return service != nullptr ? service : harpoon::ode::serve(*libode);
}

/// Before libode makes a change.
void tell_changing(const Libode* libode, dxGeom* geom, Change change) {
  if (Service* const service = listener_of(libode)) service->changing(geom, change);
}

void set_enabled(dxGeom* geom, bool enabled, void (*Interposed::*set)(dxGeom*), const char* name,
                 const void* return_address) {
  Libode* const libode = libode_for(geom, return_address);
  Service* const service = listener_of(libode);
  const bool changes = service != nullptr && geom != nullptr &&
                       (libode->stock.geom_is_enabled == nullptr ||
                        (libode->stock.geom_is_enabled(geom) != 0) != enabled);
  if (changes) service->changing(geom, enabled ? Change::enabled : Change::disabled);
  call_stock(libode, set, name, geom);
  if (changes) service->toggled(geom);
}

}  // namespace

namespace harpoon::ode {

void routes_changed() {
  // One thread at a time: the last to come must be the last to write.
  static constinit std::atomic_flag busy;
  while (busy.test_and_set(std::memory_order_acquire)) {
  }
  const Libode* const first = libodes.load(std::memory_order_acquire);
  const bool is_only = first->next == nullptr;
  next_collide.store(is_only ? first->collide.load() : &collide_by_geom, std::memory_order_release);
  next_geom_moved.store(is_only ? first->geom_moved.load() : &move_by_geom,
                        std::memory_order_release);
  busy.clear(std::memory_order_release);
}

}  // namespace harpoon::ode

extern "C" {

HARPOON_API void dSpaceCollide(dxSpace* space, void* data, NearCallback* callback) {
  Libode* const libode = libode_for(space, __builtin_return_address(0));
  harpoon::ode::note_arrival();
  if (Service* const service = service_of(libode)) {
    return service->space_collide(space, data, callback);
  }
  call_stock(libode, &Interposed::space_collide, "dSpaceCollide", space, data, callback);
}

HARPOON_API void dSpaceCollide2(dxGeom* o1, dxGeom* o2, void* data, NearCallback* callback) {
  Libode* const libode = libode_for(o1 != nullptr ? o1 : o2, __builtin_return_address(0));
  harpoon::ode::note_arrival();
  if (Service* const service = service_of(libode)) {
    return service->space_collide2(o1, o2, data, callback);
  }
  call_stock(libode, &Interposed::space_collide2, "dSpaceCollide2", o1, o2, data, callback);
}

HARPOON_API int dCollide(dxGeom* o1, dxGeom* o2, int flags, void* contact, int skip) {
  return next_collide.load(std::memory_order_acquire)(o1, o2, flags, contact, skip);
}

HARPOON_API void dGeomMoved(dxGeom* geom) {
  next_geom_moved.load(std::memory_order_acquire)(geom);
}

HARPOON_API void dGeomDestroy(dxGeom* geom) {
  const Libode* const libode = libode_for(geom, __builtin_return_address(0));
  if (Service* const service = listener_of(libode)) service->destroying(geom);
  call_stock(libode, &Interposed::geom_destroy, "dGeomDestroy", geom);
}

HARPOON_API void dGeomSetBody(dxGeom* geom, dxBody* body) {
  const Libode* const libode = libode_for(geom, __builtin_return_address(0));
  tell_changing(libode, geom, Change::filter);
  call_stock(libode, &Interposed::geom_set_body, "dGeomSetBody", geom, body);
  if (Service* const service = listener_of(libode)) service->filters_changed(geom);
}

HARPOON_API void dGeomSetCategoryBits(dxGeom* geom, unsigned long bits) {
  const Libode* const libode = libode_for(geom, __builtin_return_address(0));
  tell_changing(libode, geom, Change::filter);
  call_stock(libode, &Interposed::geom_set_category_bits, "dGeomSetCategoryBits", geom, bits);
  if (Service* const service = listener_of(libode)) service->filters_changed(geom);
}

HARPOON_API void dGeomSetCollideBits(dxGeom* geom, unsigned long bits) {
  const Libode* const libode = libode_for(geom, __builtin_return_address(0));
  tell_changing(libode, geom, Change::filter);
  call_stock(libode, &Interposed::geom_set_collide_bits, "dGeomSetCollideBits", geom, bits);
  if (Service* const service = listener_of(libode)) service->filters_changed(geom);
}

HARPOON_API void dGeomEnable(dxGeom* geom) {
  set_enabled(geom, true, &Interposed::geom_enable, "dGeomEnable", __builtin_return_address(0));
}

HARPOON_API void dGeomDisable(dxGeom* geom) {
  set_enabled(geom, false, &Interposed::geom_disable, "dGeomDisable", __builtin_return_address(0));
}

HARPOON_API void dSpaceAdd(dxSpace* space, dxGeom* geom) {
  const Libode* const libode = libode_for(space, __builtin_return_address(0));
  tell_changing(libode, harpoon::ode::as_geom(space), Change::members);
  call_stock(libode, &Interposed::space_add, "dSpaceAdd", space, geom);
  if (Service* const service = listener_of(libode)) service->added(space);
}

HARPOON_API void dSpaceRemove(dxSpace* space, dxGeom* geom) {
  const Libode* const libode = libode_for(space, __builtin_return_address(0));
  tell_changing(libode, harpoon::ode::as_geom(space), Change::members);
  call_stock(libode, &Interposed::space_remove, "dSpaceRemove", space, geom);
  if (Service* const service = listener_of(libode)) service->removed(space, geom);
}

HARPOON_API void dHashSpaceSetLevels(dxSpace* space, int min_level, int max_level) {
  const Libode* const libode = libode_for(space, __builtin_return_address(0));
  call_stock(libode, &Interposed::hash_space_set_levels, "dHashSpaceSetLevels", space, min_level,
             max_level);
  if (Service* const service = listener_of(libode)) service->levels_changed(space);
}

// Whoever uses a libode starts with one of these: where another was loaded meanwhile, it is found.

HARPOON_API void dInitODE() {
  Libode* const libode = libode_of_caller(__builtin_return_address(0));
  call_stock(libode, &Interposed::init_ode, "dInitODE");
  if (libode != nullptr) libode->initialised.fetch_add(1);
}

HARPOON_API int dInitODE2(unsigned flags) {
  Libode* const libode = libode_of_caller(__builtin_return_address(0));
  const int done = call_stock(libode, &Interposed::init_ode2, "dInitODE2", flags);
  if (libode != nullptr && done != 0) libode->initialised.fetch_add(1);
  return done;
}

HARPOON_API dxSpace* dSimpleSpaceCreate(dxSpace* parent) {
  return call_stock(libode_for(parent, __builtin_return_address(0)),
                    &Interposed::simple_space_create, "dSimpleSpaceCreate", parent);
}

HARPOON_API dxSpace* dHashSpaceCreate(dxSpace* parent) {
  return call_stock(libode_for(parent, __builtin_return_address(0)), &Interposed::hash_space_create,
                    "dHashSpaceCreate", parent);
}

HARPOON_API dxSpace* dQuadTreeSpaceCreate(dxSpace* parent, const void* centre, const void* extents,
                                          int depth) {
  return call_stock(libode_for(parent, __builtin_return_address(0)),
                    &Interposed::quadtree_space_create, "dQuadTreeSpaceCreate", parent, centre,
                    extents, depth);
}

HARPOON_API dxSpace* dSweepAndPruneSpaceCreate(dxSpace* parent, int axis_order) {
  Libode* const libode = libode_for(parent, __builtin_return_address(0));
  dxSpace* const space = call_stock(libode, &Interposed::sap_space_create,
                                    "dSweepAndPruneSpaceCreate", parent, axis_order);
  if (Service* const service = service_of(libode)) service->sap_created(space, axis_order);
  return space;
}

HARPOON_API int dCreateGeomClass(const GeomClass* geom_class) {
  Libode* const libode = libode_of_caller(__builtin_return_address(0));
  AabbTest* const test = geom_class == nullptr ? nullptr : geom_class->aabb_test;
  const int number = call_stock<int, const void*>(libode, &Interposed::create_geom_class,
                                                  "dCreateGeomClass", geom_class);
  if (Service* const service = service_of(libode)) service->class_created(number, test);
  return number;
}

HARPOON_API void dSetColliderOverride(int class1, int class2, void* function) {
  Libode* const libode = libode_of_caller(__builtin_return_address(0));
  call_stock(libode, &Interposed::set_collider_override, "dSetColliderOverride", class1, class2,
             function);
  if (Service* const service = service_of(libode)) service->collider_overridden(class1, class2);
}

HARPOON_API void dCloseODE() {
  Libode* const libode = libode_of_caller(__builtin_return_address(0));
  if (Service* const service = listener_of(libode)) service->closed();
  if (libode != nullptr) libode->initialised.fetch_sub(1);
  call_stock(libode, &Interposed::close_ode, "dCloseODE");
}

}  // extern "C"
