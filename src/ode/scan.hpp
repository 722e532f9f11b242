#pragma once

// dSpaceCollide2's work: one geom against all geoms of a space, in the space's order.

#include <vector>

#include "ode/mirror.hpp"
#include "ode/space_record.hpp"

namespace harpoon::ode {

/// A geom to be compared with a space, wherever it lives itself.
template <class Real>
struct Probe {
  dxGeom* geom;
  const dxBody* body;
  unsigned long category, collide;
  BoundsBox<Real> bounds;

  /// Brings the geom's bounds up to date, as dSpaceCollide2 does.
  Probe(const LibodeOf<Real>& ode, dxGeom* the_geom);
};

/// Appends the geoms of the mirror that overlap the probe and pass the filters: as o1 when
/// `space_first`, else as o2. O(geoms); less than a nanosecond a geom where the mirror is packed.
/// Throws std::bad_alloc.
template <class Real>
void append_scan(Mirror<Real>& mirror, const Probe<Real>& probe, bool space_first,
                 std::vector<GeomPair>& out);

}  // namespace harpoon::ode
