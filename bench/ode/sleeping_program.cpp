#include "bench/ode/sleeping_program.hpp"

#include <cmath>
#include <numbers>

#include "bench/ode/numbers.hpp"

namespace harpoon::bench {
namespace {

constexpr double kDensity = 1000;
constexpr double kBox = 0.5;
constexpr std::size_t kBoxesOfStack = 4;
/// Metres between the centres of neighbouring stacks.
constexpr double kSpacing = 1.5;
constexpr std::size_t kBalls = 8;
constexpr double kBallRadius = 0.3;
constexpr double kBallSpeed = 3;
/// Metres and radians a second below which a body is let fall asleep.
constexpr double kSlow = 0.1;

}  // namespace

SleepingProgram::SleepingProgram(std::size_t bodies, std::uint64_t seed) {
  dWorldSetAutoDisableFlag(world(), 1);
  dWorldSetAutoDisableLinearThreshold(world(), kSlow);
  dWorldSetAutoDisableAngularThreshold(world(), kSlow);
  add_plane(0, 0, 1, 0);
  add_stacks(bodies);
  add_balls(seed);
}

void SleepingProgram::add_stacks(std::size_t bodies) {
  const std::size_t stacks = (bodies + kBoxesOfStack - 1) / kBoxesOfStack;
  const auto across = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(stacks))));
  half_width_ = kSpacing * static_cast<double>(across) / 2;
  dMass mass;
  dMassSetBox(&mass, kDensity, kBox, kBox, kBox);
  for (std::size_t number = 0; number < bodies; ++number) {
    const std::size_t stack = number / kBoxesOfStack;
    const auto place = [&](std::size_t cell) {
      return kSpacing * (static_cast<double>(cell) + 0.5) - half_width_;
    };
    const double z = kBox * (static_cast<double>(number % kBoxesOfStack) + 0.5);
    const dBodyID body = add_body(dCreateBox(nullptr, kBox, kBox, kBox), mass,
                                  place(stack % across), place(stack / across), z);
    dBodyDisable(body);
  }
}

// They start on the lanes between the stacks, in any direction.
void SleepingProgram::add_balls(std::uint64_t seed) {
  Numbers numbers(seed);
  dMass mass;
  dMassSetSphere(&mass, kDensity, kBallRadius);
  const auto lane = [&] { return kSpacing * std::round(numbers.next() * half_width_ / kSpacing); };
  for (std::size_t number = 0; number < kBalls; ++number) {
    const double x = lane(), y = lane();
    const dBodyID body = add_body(dCreateSphere(nullptr, kBallRadius), mass, x, y, kBallRadius);
    dBodySetAutoDisableFlag(body, 0);
    const double heading = std::numbers::pi * numbers.next();
    balls_.push_back({body, kBallSpeed * std::cos(heading), kBallSpeed * std::sin(heading)});
  }
}

/// Drives the balls on; beyond the stacks they turn back.
void SleepingProgram::act() {
  for (Ball& ball : balls_) {
    const dReal* const at = dBodyGetPosition(ball.body);
    if (std::abs(at[0]) > half_width_) ball.speed_x = -std::copysign(ball.speed_x, at[0]);
    if (std::abs(at[1]) > half_width_) ball.speed_y = -std::copysign(ball.speed_y, at[1]);
    dBodySetLinearVel(ball.body, ball.speed_x, ball.speed_y, dBodyGetLinearVel(ball.body)[2]);
  }
}

}  // namespace harpoon::bench
