// A module as world.cpp is, which needs few functions of ODE.

#include <ode/ode.h>

#include <cstdint>

namespace {

dSpaceID space;
dGeomID geoms[100];
std::uint64_t pairs = 0;

void near(void*, dGeomID, dGeomID) {
  ++pairs;
}

}  // namespace

extern "C" {

void begin() {
  dInitODE2(0);
  space = dHashSpaceCreate(nullptr);
  for (dGeomID& geom : geoms) geom = dCreateSphere(space, dReal(0.6));
}

void step(int number) {
  for (int k = 0; k < 100; ++k) {
    dGeomSetPosition(geoms[k], (k * 37 + number) % 60, k % 3, number % 5);
  }
  dSpaceCollide(space, nullptr, &near);
}

std::uint64_t end() {
  dSpaceDestroy(space);
  dCloseODE();
  return pairs;
}

}  // extern "C"
