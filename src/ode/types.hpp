#pragma once

// What the drop-in knows of libode's binary interface besides the public header: class numbers and
// flags. Written out here so that one binary serves libode in both precisions without its headers.

#include <cstddef>
#include <cstdint>

#include "harpoon/ode.hpp"

namespace harpoon::ode {

/// Numbers that dGeomGetClass returns.
namespace geom_class {
inline constexpr int kSphere = 0;
inline constexpr int kBox = 1;
inline constexpr int kCapsule = 2;
inline constexpr int kCylinder = 3;
inline constexpr int kPlane = 4;
inline constexpr int kSimpleSpace = 10;
inline constexpr int kHashSpace = 11;
inline constexpr int kSapSpace = 12;
inline constexpr int kQuadtreeSpace = 13;
inline constexpr int kFirstUser = 14;
inline constexpr int kUserClasses = 4;
}  // namespace geom_class

[[nodiscard]] constexpr bool is_space_class(int number) {
  return number >= geom_class::kSimpleSpace && number <= geom_class::kQuadtreeSpace;
}

/// The bits of dCollide's flags that hold the largest number of contacts.
inline constexpr int kContactCountMask = 0xffff;

/// dAABBTestFn: 0 when the geom can prove that it does not touch the box.
using AabbTest = int(dxGeom* geom, dxGeom* other, void* bounds_of_other);

/// o1 and o2 of a callback.
struct GeomPair {
  dxGeom *o1, *o2;
  bool operator==(const GeomPair&) const = default;
};

/// What is about to change.
enum class Change : std::uint8_t {
  filter,  ///< a geom's body, category or collide bits
  enabled,
  disabled,
  moved,    ///< a geom's pose or bounds
  members,  ///< the geoms of a space
};

/// A space is a geom: libode's own callers cast in this way.
[[nodiscard]] inline dxGeom* as_geom(dxSpace* space) {
  return reinterpret_cast<dxGeom*>(space);
}
[[nodiscard]] inline dxSpace* as_space(dxGeom* geom) {
  return reinterpret_cast<dxSpace*>(geom);
}

}  // namespace harpoon::ode
