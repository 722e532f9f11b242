#include "bench/ode/planner_program.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

/// Metres from a joint to the next.
constexpr double kLink = 0.4;
constexpr std::size_t kGeomsOfLink = 6;
constexpr double kJointLimit = 2.6;
/// Radians between the checks on an edge, over all joints, and checks on an edge at most.
constexpr double kResolution = 0.05;
constexpr int kMostChecks = 12;
/// Plates float in a shell around the arm's foot. Its first link is out of their reach.
constexpr double kPlateSide = 0.5, kPlateThickness = 0.1;
constexpr double kNearPlates = 1.2, kFarPlates = 3.0;
constexpr unsigned long kArmBit = 1, kObstacleBit = 2;

/// A geom of a link, its place along and beside the link's axis.
struct Part {
  double beside, along;
};
constexpr std::array<Part, kGeomsOfLink> kParts = {
    {{0, 0.2}, {0, 0.02}, {0, 0.08}, {0.09, 0.2}, {0, 0.3}, {0, 0.37}}};

dGeomID make_part(dSpaceID space, std::size_t number) {
  switch (number) {
    case 0:
      return dCreateCapsule(space, 0.06, 0.26);
    case 1:
      return dCreateSphere(space, 0.09);
    case 2:
      return dCreateBox(space, 0.15, 0.15, 0.1);
    case 3:
      return dCreateCapsule(space, 0.02, 0.2);
    case 4:
      return dCreateBox(space, 0.13, 0.13, 0.06);
    default:
      return dCreateSphere(space, 0.08);
  }
}

/// The number of the link of a geom, from 1; 0 for an obstacle.
std::size_t link_of(dGeomID geom) {
  return reinterpret_cast<std::uintptr_t>(dGeomGetData(geom));
}

}  // namespace

PlannerProgram::PlannerProgram(std::size_t obstacles, Obstacles kind, std::uint64_t seed)
    : space_(dHashSpaceCreate(nullptr)), numbers_(seed) {
  add_arm();
  add_plates(obstacles, kind);
  tree_.push_back({});
}

PlannerProgram::~PlannerProgram() {
  dSpaceDestroy(space_);
}

void PlannerProgram::add_arm() {
  for (std::size_t link = 1; link <= kJoints; ++link) {
    for (std::size_t part = 0; part < kGeomsOfLink; ++part) {
      const dGeomID geom = make_part(space_, part);
      dGeomSetData(geom, reinterpret_cast<void*>(link));
      dGeomSetCategoryBits(geom, kArmBit);
      dGeomSetCollideBits(geom, kArmBit | kObstacleBit);
      arm_.push_back(geom);
    }
  }
}

void PlannerProgram::add_plates(std::size_t obstacles, Obstacles kind) {
  const std::size_t boxes = kind == Obstacles::plates ? 1 : kBoxesOfPlate;
  const auto across = static_cast<std::size_t>(std::sqrt(static_cast<double>(boxes)));
  const double side = kPlateSide / static_cast<double>(across);
  for (std::size_t number = 0; number < obstacles; number += boxes) {
    const double height = numbers_.next(), turn = std::numbers::pi * numbers_.next();
    const double distance = numbers_.between(kNearPlates, kFarPlates);
    const double flat = distance * std::sqrt(1 - height * height);
    const double x = flat * std::cos(turn), y = flat * std::sin(turn), z = distance * height;
    // The arm at rest stands upright: nothing floats above its foot.
    const double away = flat < kPlateSide ? kPlateSide : 0;
    for (std::size_t box = 0; box < std::min(boxes, obstacles - number); ++box) {
      const auto offset = [&](std::size_t cell) {
        return side * (static_cast<double>(cell) + 0.5) - kPlateSide / 2;
      };
      add_obstacle(side, kPlateThickness, x + std::copysign(away, x) + offset(box % across),
                   y + std::copysign(away, y) + offset(box / across), z);
    }
  }
}

void PlannerProgram::add_obstacle(double side, double thickness, double x, double y, double z) {
  const dGeomID geom = dCreateBox(space_, side, side, thickness);
  dGeomSetPosition(geom, x, y, z);
  dGeomSetCategoryBits(geom, kObstacleBit);
  dGeomSetCollideBits(geom, kArmBit);
}

Program::Work PlannerProgram::step() {
  work_ = {};
  answers_.clear();
  Configuration target;
  for (double& angle : target) angle = kJointLimit * numbers_.next();
  const Configuration from = nearest(target);
  double distance = 0;
  for (std::size_t joint = 0; joint < kJoints; ++joint) {
    distance = std::hypot(distance, target[joint] - from[joint]);
  }
  Configuration reached = from;
  for (int check = 1; check <= kMostChecks; ++check) {
    const double share = std::min(1.0, kResolution * check / distance);
    Configuration next;
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      next[joint] = from[joint] + share * (target[joint] - from[joint]);
    }
    if (collides(next)) break;
    reached = next;
  }
  if (reached != from) tree_.push_back(reached);
  return work_;
}

const PlannerProgram::Configuration& PlannerProgram::nearest(const Configuration& target) const {
  const auto squared_distance = [&](const Configuration& node) {
    double sum = 0;
    for (std::size_t joint = 0; joint < kJoints; ++joint) {
      sum += (node[joint] - target[joint]) * (node[joint] - target[joint]);
    }
    return sum;
  };
  const Configuration* best = &tree_.front();
  double least = squared_distance(*best);
  for (const Configuration& node : tree_) {
    const double distance = squared_distance(node);
    if (distance < least) {
      least = distance;
      best = &node;
    }
  }
  return *best;
}

/// Forward kinematics: joints turn about z and y by turns, links point along z.
void PlannerProgram::place_arm(const Configuration& configuration) {
  dQuaternion orientation = {1, 0, 0, 0};
  dVector3 foot = {0, 0, 0, 0};
  for (std::size_t link = 0; link < kJoints; ++link) {
    dQuaternion turn, turned;
    dQFromAxisAndAngle(turn, 0, link % 2 == 0 ? 0 : 1, link % 2 == 0 ? 1 : 0, configuration[link]);
    dQMultiply0(turned, orientation, turn);
    std::copy_n(turned, 4, orientation);
    dMatrix3 axes;
    dQtoR(orientation, axes);
    for (std::size_t part = 0; part < kGeomsOfLink; ++part) {
      const dGeomID geom = arm_[link * kGeomsOfLink + part];
      const auto [beside, along] = kParts[part];
      dGeomSetPosition(geom, foot[0] + axes[0] * beside + axes[2] * along,
                       foot[1] + axes[4] * beside + axes[6] * along,
                       foot[2] + axes[8] * beside + axes[10] * along);
      dGeomSetQuaternion(geom, orientation);
    }
    for (int axis = 0; axis < 3; ++axis) foot[axis] += axes[4 * axis + 2] * kLink;
  }
}

bool PlannerProgram::collides(const Configuration& configuration) {
  place_arm(configuration);
  has_contact_ = false;
  const double begin_ns = now_ns();
  dSpaceCollide(space_, this, &PlannerProgram::near);
  work_.collision_ms += (now_ns() - begin_ns) * 1e-6;
  answers_.push_back(has_contact_ ? 1 : 0);
  return has_contact_;
}

void PlannerProgram::near(void* self, dGeomID o1, dGeomID o2) {
  static_cast<PlannerProgram*>(self)->meet(o1, o2);
}

/// Links that share a joint always touch. One contact is enough.
void PlannerProgram::meet(dGeomID o1, dGeomID o2) {
  ++work_.pairs;
  if (has_contact_) return;
  const std::size_t link1 = link_of(o1), link2 = link_of(o2);
  const bool both_of_arm = link1 != 0 && link2 != 0;
  if (both_of_arm && std::max(link1, link2) - std::min(link1, link2) <= 1) return;
  dContactGeom contact;
  if (dCollide(o1, o2, 1, &contact, sizeof contact) == 0) return;
  has_contact_ = true;
  ++work_.contacts;
  answers_.insert(answers_.end(), contact.pos, contact.pos + 3);
  answers_.insert(answers_.end(), contact.normal, contact.normal + 3);
  answers_.insert(answers_.end(),
                  {contact.depth, static_cast<dReal>(link1), static_cast<dReal>(link2)});
}

std::size_t PlannerProgram::geoms() const {
  return static_cast<std::size_t>(dSpaceGetNumGeoms(space_));
}

void PlannerProgram::append_state(std::vector<dReal>& state) const {
  state.push_back(static_cast<dReal>(tree_.size()));
  state.insert(state.end(), tree_.back().begin(), tree_.back().end());
  state.insert(state.end(), answers_.begin(), answers_.end());
}

}  // namespace harpoon::bench
