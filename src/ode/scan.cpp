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

template <class Real>
void append_scan(const Mirror<Real>& mirror, const Probe<Real>& probe, bool space_first,
                 std::vector<GeomPair>& out) {
  const Real* const b = probe.bounds.v;
  for (std::uint32_t i = 0; i < mirror.size(); ++i) {
    const Real* const a = mirror.bounds[i].v;
    // As libode compares: a NaN is never apart. Without branches, so that misses cost the same.
    const bool apart = (a[0] > b[1]) | (a[1] < b[0]) | (a[2] > b[3]) | (a[3] < b[2]) |
                       (a[4] > b[5]) | (a[5] < b[4]);
    if (apart) continue;
    if (mirror.bodies[i] == probe.body && probe.body != nullptr) continue;
    if (((mirror.category[i] & probe.collide) | (probe.category & mirror.collide[i])) == 0)
      continue;
    out.push_back(space_first ? GeomPair{mirror.geoms[i], probe.geom}
                              : GeomPair{probe.geom, mirror.geoms[i]});
  }
}

template struct Probe<float>;
template struct Probe<double>;
template void append_scan(const Mirror<float>&, const Probe<float>&, bool, std::vector<GeomPair>&);
template void append_scan(const Mirror<double>&, const Probe<double>&, bool,
                          std::vector<GeomPair>&);

}  // namespace harpoon::ode
