#pragma once

// A large world at rest: stacks of boxes that ODE has put to sleep, and a few balls that roll
// through it, wake what they hit and leave it to fall asleep again.

#include "bench/ode/body_world.hpp"

namespace harpoon::bench {

class SleepingProgram final : public BodyWorld {
 public:
  /// `bodies` counts the boxes; the balls come on top.
  SleepingProgram(std::size_t bodies, std::uint64_t seed);

  /// From then on about as many boxes fall asleep as are hit.
  [[nodiscard]] unsigned settling_steps() const override { return 200; }

 private:
  void act() override;
  void add_stacks(std::size_t bodies);
  void add_balls(std::uint64_t seed);

  double half_width_ = 0;
  struct Ball {
    dBodyID body;
    double speed_x, speed_y;
  };
  std::vector<Ball> balls_;
};

}  // namespace harpoon::bench
