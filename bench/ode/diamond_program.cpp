#include "bench/ode/diamond_program.hpp"

#include "bench/ode/body_world.hpp"
#include "bench/timer.hpp"

namespace harpoon::bench {

// The parameters are within their ranges, so there is a world.
DiamondProgram::DiamondProgram(unsigned h_max)
    : world_(std::move(DiamondWorld::create({.h_max = h_max}).value())) {}

Program::Work DiamondProgram::step() {
  const double begin_ns = now_ns();
  const std::uint64_t pairs = world_->collide();
  const double collision_ms = (now_ns() - begin_ns) * 1e-6;
  const std::uint64_t contacts = world_->contact_count();
  world_->advance();
  return {collision_ms, pairs, contacts};
}

void DiamondProgram::append_state(std::vector<dReal>& state) const {
  for (const dBodyID body : world_->bodies()) append_body_state(body, state);
}

}  // namespace harpoon::bench
