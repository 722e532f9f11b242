#pragma once

// Fills the table of functions that the drop-in calls by name: tests from the linked library, the
// preload from whatever libode the process has loaded.

#include <string_view>
#include <type_traits>

#include "ode/types.hpp"

namespace harpoon::ode {

/// Fills the table by `find(name)`, which returns the address of a symbol or null. False when one
/// is missing; then `missing` names it.
template <class Real, class Find>
[[nodiscard]] bool resolve(LibodeOf<Real>& ode, const Find& find, std::string_view& missing) {
  bool complete = true;
  const auto take = [&](const char* name, auto& function) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(find(name));
    if (function == nullptr && complete) {
      complete = false;
      missing = name;
    }
  };
  take("dSpaceCollide", ode.space_collide);
  take("dSpaceCollide2", ode.space_collide2);
  take("dSpaceClean", ode.space_clean);
  take("dSpaceGetNumGeoms", ode.space_get_num_geoms);
  take("dSpaceGetGeom", ode.space_get_geom);
  take("dSpaceGetSublevel", ode.space_get_sublevel);
  take("dHashSpaceGetLevels", ode.hash_space_get_levels);
  take("dCollide", ode.collide);
  take("dGeomGetClass", ode.geom_get_class);
  take("dGeomIsEnabled", ode.geom_is_enabled);
  take("dGeomEnable", ode.geom_enable);
  take("dGeomDisable", ode.geom_disable);
  take("dGeomGetSpace", ode.geom_get_space);
  take("dGeomGetBody", ode.geom_get_body);
  take("dGeomGetCategoryBits", ode.geom_get_category_bits);
  take("dGeomGetCollideBits", ode.geom_get_collide_bits);
  take("dGeomGetAABB", ode.geom_get_aabb);
  take("dGeomGetPosition", ode.geom_get_position);
  take("dGeomSphereGetRadius", ode.sphere_get_radius);
  take("dGeomBoxGetLengths", ode.box_get_lengths);
  take("dGeomCapsuleGetParams", ode.capsule_get_params);
  take("dGeomCylinderGetParams", ode.cylinder_get_params);
  take("dSimpleSpaceCreate", ode.simple_space_create);
  take("dCreateSphere", ode.create_sphere);
  take("dGeomSetPosition", ode.geom_set_position);
  take("dGeomSetOffsetPosition", ode.geom_set_offset_position);
  take("dGeomSetBody", ode.geom_set_body);
  take("dGeomSetCategoryBits", ode.geom_set_category_bits);
  take("dGeomSetCollideBits", ode.geom_set_collide_bits);
  take("dGeomDestroy", ode.geom_destroy);
  take("dWorldCreate", ode.world_create);
  take("dWorldDestroy", ode.world_destroy);
  take("dBodyCreate", ode.body_create);
  take("dGetDebugHandler", ode.get_debug_handler);
  take("dSetDebugHandler", ode.set_debug_handler);
  return complete;
}

}  // namespace harpoon::ode
