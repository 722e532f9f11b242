#pragma once

// Where a build of libode keeps what is read of every geom, found by looking at geoms of our own.
// Two things need it: libode's traversals read bounds as they are, also those of a geom that they
// have missed when they computed bounds anew, and asking for them by dGeomGetAABB would compute
// them; and a mirror asks ten questions of each geom. Where anything is not found as expected,
// nothing is taken to be known and everything is asked for.

#include <cstdint>
#include <cstring>

#include "ode/bounds_box.hpp"
#include "ode/libode.hpp"

namespace harpoon::ode {

struct GeomLayout {
  bool is_known = false;
  // Offsets in bytes.
  std::uint16_t type = 0, flags = 0, body = 0, pose = 0, bounds = 0, category = 0, collide = 0;
  std::uint16_t radius = 0;  ///< of a sphere
  // Bits of the flags.
  std::int32_t enabled = 0, zero_sized = 0;
  std::int32_t dirty = 0;     ///< the space has not computed its bounds since it moved
  std::int32_t pose_bad = 0;  ///< its pose is to be computed from its body's

  template <class Value>
  [[nodiscard]] static Value at(const dxGeom* geom, std::uint16_t offset) {
    Value value;
    std::memcpy(&value, reinterpret_cast<const char*>(geom) + offset, sizeof value);
    return value;
  }
};

/// Looks at geoms in no space or a space of our own. libode must be initialised.
template <class Real>
[[nodiscard]] GeomLayout find_geom_layout(const LibodeOf<Real>& ode);

}  // namespace harpoon::ode
