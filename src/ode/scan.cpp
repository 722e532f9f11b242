#include "ode/scan.hpp"

namespace harpoon::ode {

template <class Real>
Probe<Real>::Probe(const LibodeOf<Real>& ode, dxGeom* the_geom)
    : geom(the_geom),
      body(ode.geom_get_body(the_geom)),
      category(ode.geom_get_category_bits(the_geom)),
      collide(ode.geom_get_collide_bits(the_geom)),
      bounds() {
  ode.geom_get_aabb(the_geom, bounds.v);
}

namespace {

/// Without branches, so that misses cost the same. As libode compares: a NaN is never apart.
template <class Real>
bool are_apart(const Real* a, const Real* b) {
  return (a[0] > b[1]) | (a[1] < b[0]) | (a[2] > b[3]) | (a[3] < b[2]) | (a[4] > b[5]) |
         (a[5] < b[4]);
}

}  // namespace

template <class Real>
void append_scan(Mirror<Real>& mirror, const Probe<Real>& probe, bool space_first,
                 std::vector<GeomPair>& out) {
  const auto test = [&](std::uint32_t i) {
    if (are_apart(mirror.bounds[i].v, probe.bounds.v)) return;
    if (mirror.bodies[i] == probe.body && probe.body != nullptr) return;
    if (((mirror.category[i] & probe.collide) | (probe.category & mirror.collide[i])) == 0) return;
    out.push_back(space_first ? GeomPair{mirror.geoms[i], probe.geom}
                              : GeomPair{probe.geom, mirror.geoms[i]});
  };
  // To pack is worth it from the second probe on.
  if (const PackedBounds<Real>* const packed = mirror.packed_if_asked_again()) {
    std::vector<std::uint32_t>& near = mirror.near;
    near.clear();
    packed->append_near(probe.bounds, near);
    for (const std::uint32_t i : near) test(i);
  } else {
    for (std::uint32_t i = 0; i < mirror.size(); ++i) test(i);
  }
}

template struct Probe<float>;
template struct Probe<double>;
template void append_scan(Mirror<float>&, const Probe<float>&, bool, std::vector<GeomPair>&);
template void append_scan(Mirror<double>&, const Probe<double>&, bool, std::vector<GeomPair>&);

}  // namespace harpoon::ode
