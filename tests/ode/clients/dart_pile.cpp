// Balls and boxes dropped on a ground in DART, whose collision detector is ODE's; Harpoon is
// unknown to it. Prints the state of every body at the end, exactly.
//
//   dart_pile BODIES STEPS

#include <fmt/format.h>

#include <cstdlib>
#include <dart/collision/ode/OdeCollisionDetector.hpp>
#include <dart/constraint/ConstraintSolver.hpp>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/BoxShape.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/SphereShape.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <dart/simulation/World.hpp>
#include <random>
#include <string>

namespace {

using dart::dynamics::BoxShape;
using dart::dynamics::FreeJoint;
using dart::dynamics::Skeleton;
using dart::dynamics::SkeletonPtr;
using dart::dynamics::SphereShape;
using dart::dynamics::WeldJoint;

template <class Joint>
SkeletonPtr make_body(const std::string& name, const dart::dynamics::ShapePtr& shape,
                      const Eigen::Vector3d& at) {
  SkeletonPtr skeleton = Skeleton::create(name);
  const auto [joint, body] = skeleton->createJointAndBodyNodePair<Joint>();
  body->template createShapeNodeWith<dart::dynamics::CollisionAspect,
                                     dart::dynamics::DynamicsAspect>(shape);
  dart::dynamics::Inertia inertia;
  inertia.setMass(1);
  inertia.setMoment(shape->computeInertia(1));
  body->setInertia(inertia);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = at;
  joint->setTransformFromParentBodyNode(pose);
  return skeleton;
}

/// A number in [-1, 1): std::mt19937 is the same everywhere, the distributions are not.
double next(std::mt19937& numbers) {
  return static_cast<double>(numbers()) * 0x1p-31 - 1;
}

dart::simulation::WorldPtr make_world(int bodies) {
  auto world = dart::simulation::World::create();
  world->getConstraintSolver()->setCollisionDetector(
      dart::collision::OdeCollisionDetector::create());
  world->addSkeleton(make_body<WeldJoint>(
      "ground", std::make_shared<BoxShape>(Eigen::Vector3d(20, 20, 0.2)), {0, 0, -0.1}));
  std::mt19937 numbers(7);
  for (int number = 0; number < bodies; ++number) {
    const double x = next(numbers), y = next(numbers);
    const Eigen::Vector3d at(x, y, 0.4 + 0.25 * number);
    dart::dynamics::ShapePtr shape = std::make_shared<SphereShape>(0.2);
    if (number % 3 == 0) shape = std::make_shared<BoxShape>(Eigen::Vector3d(0.4, 0.3, 0.35));
    world->addSkeleton(make_body<FreeJoint>(fmt::format("body {}", number), shape, at));
  }
  world->setTimeStep(0.005);
  return world;
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) return 2;
  const auto world = make_world(std::atoi(words[1]));
  for (int step = std::atoi(words[2]); step > 0; --step) world->step();
  fmt::print("{} contacts\n", world->getLastCollisionResult().getNumContacts());
  for (std::size_t k = 1; k < world->getNumSkeletons(); ++k) {
    const SkeletonPtr skeleton = world->getSkeleton(k);
    for (const double value : skeleton->getPositions()) fmt::print("{:a} ", value);
    for (const double value : skeleton->getVelocities()) fmt::print("{:a} ", value);
    fmt::print("\n");
  }
  return 0;
}
