#pragma once

// Spheres of ODE, each with a body, in a hash space, as the diamond world has them; without any
// simulation. What ODE is asked about when it answers as a contestant.

#include <cstddef>
#include <span>
#include <vector>

#include "bench/lattice.hpp"
#include "bench/ode/runtime.hpp"
#include "harpoon/records.hpp"

namespace harpoon::bench {

class GeomSet {
 public:
  explicit GeomSet(std::span<const SphereF64> spheres);
  ~GeomSet();
  GeomSet(const GeomSet&) = delete;
  GeomSet& operator=(const GeomSet&) = delete;

  [[nodiscard]] dxGeom* geom(std::size_t sphere) const { return geoms_[sphere]; }
  /// `positions` holds one point per sphere.
  void move(std::span<const Point> positions);

 private:
  OdeRuntime runtime_;
  dxWorld* world_;
  dxSpace* space_;
  std::vector<dxGeom*> geoms_;
};

/// Stock `dCollide` for one contact of each pair; returns the number of hits.
std::size_t collide_all(const GeomSet& geoms, std::span<const IndexPair> pairs);

}  // namespace harpoon::bench
