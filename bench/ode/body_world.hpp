#pragma once

// What the simulations among the programs share: a world with a hash space, contacts collected
// during collision and made joints of afterwards, bodies whose state can be read.

#include <cstdint>
#include <span>
#include <vector>

#include "bench/ode/program.hpp"

namespace harpoon::bench {

/// Position, orientation, velocities and whether it is awake.
void append_body_state(dBodyID body, std::vector<dReal>& state);

/// Gravity is 9.81 m/s^2 down z. The derived program fills the world and may act before a step.
class BodyWorld : public Program {
 public:
  BodyWorld();
  ~BodyWorld() override;

  Work step() final;
  [[nodiscard]] std::size_t geoms() const final;
  void append_state(std::vector<dReal>& state) const final;

 protected:
  [[nodiscard]] dWorldID world() const { return world_; }
  /// Half-space of the points p with normal * p <= offset is solid.
  void add_plane(double x, double y, double z, double offset);
  /// Puts the geom on a body of its own with the given mass distribution.
  dBodyID add_body(dGeomID geom, const dMass& mass, double x, double y, double z);
  [[nodiscard]] std::span<const dBodyID> bodies() const { return bodies_; }

 private:
  /// What the program does itself before the solver runs.
  virtual void act() {}
  static void near(void* self, dGeomID o1, dGeomID o2);
  void meet(dGeomID o1, dGeomID o2);
  void join();

  dWorldID world_;
  dSpaceID space_;
  dJointGroupID joints_;
  std::vector<dBodyID> bodies_;
  std::vector<dContactGeom> found_;  // of this step, in the order of the callbacks
  std::uint64_t pairs_ = 0;
};

}  // namespace harpoon::bench
