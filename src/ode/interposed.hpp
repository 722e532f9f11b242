#pragma once

// The functions of libode that the preload stands in front of: their addresses in the real library,
// found at run time, whichever way the program has loaded it.

#include "ode/types.hpp"

namespace harpoon::ode {

/// The first function of that name behind the preload, or null. Looks through the libraries in the
/// order of the dynamic linker and then through a libode that was loaded privately, as Python
/// modules do.
void* find_in_libode(const char* name);

/// Those that are interposed. `dCreateGeomClass` is passed on unread but for one member.
struct Interposed {
  void (*space_collide)(dxSpace*, void*, NearCallback*);
  void (*space_collide2)(dxGeom*, dxGeom*, void*, NearCallback*);
  int (*collide)(dxGeom*, dxGeom*, int, void*, int);
  void (*geom_moved)(dxGeom*);
  void (*geom_destroy)(dxGeom*);
  void (*geom_set_body)(dxGeom*, dxBody*);
  void (*geom_set_category_bits)(dxGeom*, unsigned long);
  void (*geom_set_collide_bits)(dxGeom*, unsigned long);
  void (*geom_enable)(dxGeom*);
  void (*geom_disable)(dxGeom*);
  int (*geom_is_enabled)(dxGeom*);
  void (*space_add)(dxSpace*, dxGeom*);
  void (*space_remove)(dxSpace*, dxGeom*);
  void (*hash_space_set_levels)(dxSpace*, int, int);
  dxSpace* (*sap_space_create)(dxSpace*, int);
  int (*create_geom_class)(const void*);
  void (*set_collider_override)(int, int, void*);
  void (*close_ode)();
  const char* (*get_configuration)();
};

/// Found at the first call. Ends the process with a message when there is no libode: nobody could
/// have called then.
const Interposed& libode();

}  // namespace harpoon::ode
