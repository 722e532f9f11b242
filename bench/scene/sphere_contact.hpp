#pragma once

// The contact of two spheres for peers that find pairs only: the same numbers as a Harpoon contact.

#include <cmath>

#include "harpoon/records.hpp"

namespace harpoon::bench {

/// True and `out` written when they touch.
inline bool sphere_contact(const Sphere& a, const Sphere& b, BodyContact& out) {
  const float x = a.x - b.x;
  const float y = a.y - b.y;
  const float z = a.z - b.z;
  const float d = std::sqrt(x * x + y * y + z * z);
  if (d > a.r + b.r) return false;
  const float inverse = d > 0 ? 1 / d : 0;
  const float k = 0.5F * ((b.r - a.r) - d);
  out.normal[0] = d > 0 ? x * inverse : 1;
  out.normal[1] = y * inverse;
  out.normal[2] = z * inverse;
  out.pos[0] = a.x + out.normal[0] * k;
  out.pos[1] = a.y + out.normal[1] * k;
  out.pos[2] = a.z + out.normal[2] * k;
  out.depth = a.r + b.r - d;
  return true;
}

}  // namespace harpoon::bench
