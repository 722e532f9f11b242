#pragma once

// A planner as OMPL's users have it, with ODE as the judge of configurations: an arm of seven
// joints and 42 geoms, and obstacles that do not move, in one hash space. It grows a rapidly
// exploring random tree (LaValle 1998) one edge a step. Nothing is simulated.

#include <array>

#include "bench/ode/numbers.hpp"
#include "bench/ode/program.hpp"

namespace harpoon::bench {

enum class Obstacles : std::uint8_t {
  plates,   ///< thin square boxes
  scanned,  ///< the same plates as kBoxesOfPlate small boxes each
};
inline constexpr std::size_t kBoxesOfPlate = 25;

class PlannerProgram final : public Program {
 public:
  PlannerProgram(std::size_t obstacles, Obstacles kind, std::uint64_t seed);
  ~PlannerProgram() override;

  /// From the tree's node nearest to a random configuration some way toward it, until something
  /// collides.
  Work step() override;
  [[nodiscard]] std::size_t geoms() const override;
  /// The tree's size and last node, and what each check of the last step found.
  void append_state(std::vector<dReal>& state) const override;

 private:
  static constexpr std::size_t kJoints = 7;
  using Configuration = std::array<double, kJoints>;  // radians

  void add_arm();
  void add_plates(std::size_t obstacles, Obstacles kind);
  void add_obstacle(double side, double thickness, double x, double y, double z);
  [[nodiscard]] const Configuration& nearest(const Configuration& target) const;
  void place_arm(const Configuration& configuration);
  [[nodiscard]] bool collides(const Configuration& configuration);
  static void near(void* self, dGeomID o1, dGeomID o2);
  void meet(dGeomID o1, dGeomID o2);

  dSpaceID space_;
  Numbers numbers_;
  std::vector<dGeomID> arm_;  // those of the first link first
  std::vector<Configuration> tree_;
  Work work_;
  bool has_contact_ = false;
  std::vector<dReal> answers_;
};

}  // namespace harpoon::bench
