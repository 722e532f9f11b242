#include "bench/ode/geom_set.hpp"

#include <ode/ode.h>

namespace harpoon::bench {

GeomSet::GeomSet(std::span<const SphereF64> spheres)
    : world_(dWorldCreate()), space_(dHashSpaceCreate(nullptr)) {
  geoms_.reserve(spheres.size());
  for (const SphereF64& sphere : spheres) {
    dBodyID body = dBodyCreate(world_);
    dBodySetPosition(body, sphere.x, sphere.y, sphere.z);
    dGeomID geom = dCreateSphere(space_, sphere.r);
    dGeomSetBody(geom, body);
    geoms_.push_back(geom);
  }
}

GeomSet::~GeomSet() {
  dSpaceDestroy(space_);
  dWorldDestroy(world_);
}

void GeomSet::move(std::span<const Point> positions) {
  for (std::size_t i = 0; i < positions.size(); ++i) {
    dGeomSetPosition(geoms_[i], positions[i][0], positions[i][1], positions[i][2]);
  }
}

std::size_t collide_all(const GeomSet& geoms, std::span<const IndexPair> pairs) {
  std::size_t hits = 0;
  dContactGeom contact;
  for (const IndexPair& pair : pairs) {
    const int n = dCollide(geoms.geom(pair.g1), geoms.geom(pair.g2), 1, &contact, sizeof contact);
    hits += static_cast<std::size_t>(n);
  }
  return hits;
}

}  // namespace harpoon::bench
