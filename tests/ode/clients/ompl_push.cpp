// OMPL plans how to push a ball past pillars to a place among other balls, with its own extension
// for ODE: it simulates every motion that it tries and asks ODE what collides. Harpoon is unknown
// to it. Prints every state of the planner's tree, exactly.
//
//   ompl_push ITERATIONS

#include <fmt/format.h>
#include <ompl/base/PlannerData.h>
#include <ompl/base/goals/GoalRegion.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/extensions/ode/OpenDESimpleSetup.h>
#include <ompl/extensions/ode/OpenDEStateSpace.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <cmath>
#include <cstdlib>
#include <memory>

namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

constexpr double kRadius = 0.3;
constexpr double kForce = 6;
constexpr int kPillars = 30;
constexpr int kMovable = 5;

/// A ball that is pushed, balls in its way that it may push, pillars that it must not touch.
class PushWorld : public oc::OpenDEEnvironment {
 public:
  PushWorld() : space_(dHashSpaceCreate(nullptr)) {
    world_ = dWorldCreate();
    dWorldSetGravity(world_, 0, 0, -9.81);
    collisionSpaces_.push_back(space_);
    const dGeomID ground = dCreateBox(space_, 20, 20, 0.2);
    dGeomSetPosition(ground, 0, 0, -0.1);
    dGeomSetCategoryBits(ground, kFree);
    for (int number = 0; number < kPillars; ++number) {
      const double turn = 2.4 * number, distance = 2 + 0.15 * number;
      const dGeomID pillar = dCreateCylinder(space_, 0.2, 2);
      dGeomSetPosition(pillar, distance * std::cos(turn), distance * std::sin(turn), 1);
      dGeomSetCategoryBits(pillar, kFixed);
    }
    for (int number = 0; number <= kMovable; ++number) {
      add_ball(number == 0 ? 0 : 0.9 * std::cos(number), number == 0 ? 0 : 0.9 * std::sin(number));
    }
  }
  ~PushWorld() override {
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }
  PushWorld(const PushWorld&) = delete;
  PushWorld& operator=(const PushWorld&) = delete;

  unsigned int getControlDimension() const override { return 2; }
  void getControlBounds(std::vector<double>& lower, std::vector<double>& upper) const override {
    lower.assign(2, -kForce);
    upper.assign(2, kForce);
  }
  void applyControl(const double* control) const override {
    dBodyAddForce(stateBodies_[0], control[0], control[1], 0);
  }
  bool isValidCollision(dGeomID geom1, dGeomID geom2, const dContact&) const override {
    return ((dGeomGetCategoryBits(geom1) | dGeomGetCategoryBits(geom2)) & kFixed) == 0;
  }
  void setupContact(dGeomID, dGeomID, dContact& contact) const override {
    contact.surface.mode = dContactSoftCFM | dContactApprox1;
    contact.surface.mu = 0.4;
    contact.surface.soft_cfm = 1e-4;
  }

 private:
  static constexpr unsigned long kFree = 1, kFixed = 2;

  void add_ball(double x, double y) {
    dMass mass;
    dMassSetSphereTotal(&mass, 1, kRadius);
    const dBodyID body = dBodyCreate(world_);
    dBodySetMass(body, &mass);
    dBodySetPosition(body, x, y, kRadius);
    const dGeomID ball = dCreateSphere(space_, kRadius);
    dGeomSetCategoryBits(ball, kFree);
    dGeomSetBody(ball, body);
    stateBodies_.push_back(body);
  }

  dSpaceID space_;
};

/// The pushed ball within half a metre of a place.
class Place : public ob::GoalRegion {
 public:
  explicit Place(const ob::SpaceInformationPtr& information) : GoalRegion(information) {
    threshold_ = 0.5;
  }
  double distanceGoal(const ob::State* state) const override {
    const double* const at = state->as<oc::OpenDEStateSpace::StateType>()->getBodyPosition(0);
    return std::hypot(at[0] - 6, at[1] - 6);
  }
};

void set_bounds(oc::OpenDESimpleSetup& setup) {
  ob::RealVectorBounds volume(3), speed(3), turn(3);
  volume.setLow(-8);
  volume.setHigh(8);
  speed.setLow(-6);
  speed.setHigh(6);
  turn.setLow(-40);
  turn.setHigh(40);
  setup.setVolumeBounds(volume);
  setup.setLinearVelocityBounds(speed);
  setup.setAngularVelocityBounds(turn);
}

void print_state(const oc::OpenDEStateSpace::StateType& state) {
  for (unsigned ball = 0; ball <= kMovable; ++ball) {
    for (int axis = 0; axis < 3; ++axis) {
      fmt::print("{:a} {:a} ", state.getBodyPosition(ball)[axis],
                 state.getBodyLinearVelocity(ball)[axis]);
    }
  }
  fmt::print("\n");
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return 2;
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  ompl::RNG::setSeed(7);
  dInitODE2(0);
  {
    oc::OpenDESimpleSetup setup(std::make_shared<PushWorld>());
    set_bounds(setup);
    setup.setGoal(std::make_shared<Place>(setup.getSpaceInformation()));
    setup.setPlanner(std::make_shared<oc::RRT>(setup.getSpaceInformation()));
    setup.setup();
    ob::IterationTerminationCondition end(static_cast<unsigned>(std::atoi(words[1])));
    setup.solve(end);
    ob::PlannerData tree(setup.getSpaceInformation());
    setup.getPlannerData(tree);
    for (unsigned k = 0; k < tree.numVertices(); ++k) {
      print_state(*tree.getVertex(k).getState()->as<oc::OpenDEStateSpace::StateType>());
    }
  }
  dCloseODE();
  return 0;
}
