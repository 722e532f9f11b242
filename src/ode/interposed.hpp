#pragma once

// The functions of libode that libharpoon_ode stands in front of, as one libode has them.

#include "ode/types.hpp"

namespace harpoon::ode {

/// Null where a libode lacks one. `dCreateGeomClass` is passed on unread but for one member.
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
  dxSpace* (*simple_space_create)(dxSpace*);
  dxSpace* (*hash_space_create)(dxSpace*);
  dxSpace* (*quadtree_space_create)(dxSpace*, const void*, const void*, int);
  dxSpace* (*sap_space_create)(dxSpace*, int);
  int (*create_geom_class)(const void*);
  void (*set_collider_override)(int, int, void*);
  void (*init_ode)();
  int (*init_ode2)(unsigned);
  void (*close_ode)();
};

}  // namespace harpoon::ode
