#pragma once

// The colliders as plain scalar code, for float and double. The including file must be compiled
// without floating-point contraction; all of Harpoon is.

#include <cmath>

namespace harpoon::colliders {

using std::sqrt;

inline float select(bool mask, float if_set, float if_clear) {
  return mask ? if_set : if_clear;
}
inline double select(bool mask, double if_set, double if_clear) {
  return mask ? if_set : if_clear;
}

#include "collide/vec3.inl"

#include "collide/aabb_overlap.inl"
#include "collide/sphere_plane.inl"
#include "collide/sphere_sphere.inl"

}  // namespace harpoon::colliders
