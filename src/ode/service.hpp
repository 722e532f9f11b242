#pragma once

// What libharpoon_ode, which every process under the preload loads, and libharpoon_ode_engine,
// which it opens when a program first collides a space, know of each other. Nothing here needs a
// C++ run time: the first of them has none.

#include "ode/types.hpp"

namespace harpoon::ode {

using Collide = int(dxGeom*, dxGeom*, int, void*, int);
using GeomMoved = void(dxGeom*);

/// Does for one libode what its functions do, and hears of what they did. Events come from the
/// thread that makes the change, after libode has made it unless said otherwise. Never throws but
/// what a callback threw.
class Service {
 public:
  virtual void space_collide(dxSpace* space, void* data, NearCallback* callback) = 0;
  virtual void space_collide2(dxGeom* o1, dxGeom* o2, void* data, NearCallback* callback) = 0;

  /// Before a change of a geom, or of the members of a space, which is then `geom`.
  virtual void changing(dxGeom* geom, Change change) noexcept = 0;
  virtual void filters_changed(dxGeom* geom) noexcept = 0;
  virtual void toggled(dxGeom* geom) noexcept = 0;
  virtual void added(dxSpace* space) noexcept = 0;
  virtual void removed(dxSpace* space, dxGeom* geom) noexcept = 0;
  /// Before dGeomDestroy.
  virtual void destroying(dxGeom* geom) noexcept = 0;
  virtual void levels_changed(dxSpace* space) noexcept = 0;
  virtual void sap_created(dxSpace* space, int axis_order) noexcept = 0;
  virtual void class_created(int number, AabbTest* test) noexcept = 0;
  virtual void collider_overridden(int class1, int class2) noexcept = 0;
  /// Before dCloseODE.
  virtual void closed() noexcept = 0;
  /// Writes the line of statistics if it is wanted and not written yet; for a process that ends
  /// without a word.
  virtual void report() noexcept = 0;

 protected:
  ~Service() = default;
};

/// One libode, to be served.
struct ServiceRequest {
  /// Passed to the functions below.
  void* libode;
  /// Its file, for messages.
  const char* path;
  /// How many libodes were served before it.
  int number;
  /// dInitODE has been called, and not dCloseODE since then.
  bool is_initialised;
  /// Its function of that name, or null.
  void* (*find)(void* libode, const char* name);
  /// The function that the process reaches by that name; null where it is a libode's own.
  void* (*find_in_front)(const char* name);
  /// From now on events go to the service.
  void (*listen)(void* libode, Service* service);
  /// From now on calls of dCollide or dGeomMoved with its geoms lead here.
  void (*set_collide)(void* libode, Collide* function);
  void (*set_geom_moved)(void* libode, GeomMoved* function);
};

/// What libharpoon_ode_engine exports under this name with C linkage. Null when the libode is left
/// to itself: why has been said.
inline constexpr const char* kServeSymbol = "harpoon_ode_serve";
using Serve = Service*(const ServiceRequest& request);

}  // namespace harpoon::ode
