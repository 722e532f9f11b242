#include "bench/ode/oracle.hpp"

#include <ode/ode.h>

#include <memory>

#include "bench/algorithm1.hpp"
#include "bench/ode/runtime.hpp"

namespace harpoon::bench {
namespace {

class TwoGeoms {
 public:
  TwoGeoms() : geom1_(dCreateSphere(nullptr, 1)), geom2_(dCreateSphere(nullptr, 1)) {}
  ~TwoGeoms() {
    dGeomDestroy(geom1_);
    dGeomDestroy(geom2_);
  }
  TwoGeoms(const TwoGeoms&) = delete;
  TwoGeoms& operator=(const TwoGeoms&) = delete;

  ContactF64 collide(const SpherePairF64& pair) {
    place(geom1_, pair.s1);
    place(geom2_, pair.s2);
    ContactF64 contact{};
    dContactGeom geom;
    if (dCollide(geom1_, geom2_, 1, &geom, sizeof geom) == 0) {
      contact.flow_word = static_cast<std::uint64_t>(Flow::fake);
      return contact;
    }
    for (int i = 0; i < 3; ++i) {
      contact.pos[i] = geom.pos[i];
      contact.normal[i] = geom.normal[i];
    }
    contact.depth = geom.depth;
    contact.flow_word = algorithm1(pair).flow_word;
    return contact;
  }

 private:
  static void place(dGeomID geom, const SphereF64& sphere) {
    dGeomSetPosition(geom, sphere.x, sphere.y, sphere.z);
    dGeomSphereSetRadius(geom, sphere.r);
  }

  OdeRuntime runtime_;
  dGeomID geom1_;
  dGeomID geom2_;
};

}  // namespace

Oracle make_ode_oracle() {
  auto geoms = std::make_shared<TwoGeoms>();
  return {"dCollide", [geoms](const SpherePairF64& pair) { return geoms->collide(pair); }};
}

}  // namespace harpoon::bench
