#include "bench/ode/body_world.hpp"

#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

constexpr double kGravity = -9.81;
constexpr double kTimeStep = 0.01;
constexpr int kMaxContacts = 4;
constexpr double kFriction = 0.8;
constexpr double kBounce = 0.1;
constexpr double kBounceVelocity = 0.5;
constexpr double kSoftConstraintForceMixing = 1e-4;
constexpr double kConstraintForceMixing = 1e-5;

bool rests(dBodyID body) {
  return body == nullptr || dBodyIsEnabled(body) == 0;
}

}  // namespace

void append_body_state(dBodyID body, std::vector<dReal>& state) {
  const auto append = [&state](const dReal* values, int count) {
    state.insert(state.end(), values, values + count);
  };
  append(dBodyGetPosition(body), 3);
  append(dBodyGetQuaternion(body), 4);
  append(dBodyGetLinearVel(body), 3);
  append(dBodyGetAngularVel(body), 3);
  state.push_back(dBodyIsEnabled(body));
}

BodyWorld::BodyWorld()
    : world_(dWorldCreate()), space_(dHashSpaceCreate(nullptr)), joints_(dJointGroupCreate(0)) {
  dWorldSetGravity(world_, 0, 0, kGravity);
  dWorldSetCFM(world_, kConstraintForceMixing);
}

BodyWorld::~BodyWorld() {
  dJointGroupDestroy(joints_);
  dSpaceDestroy(space_);
  dWorldDestroy(world_);
}

void BodyWorld::add_plane(double x, double y, double z, double offset) {
  dCreatePlane(space_, x, y, z, offset);
}

dBodyID BodyWorld::add_body(dGeomID geom, const dMass& mass, double x, double y, double z) {
  const dBodyID body = dBodyCreate(world_);
  dBodySetMass(body, &mass);
  dBodySetPosition(body, x, y, z);
  dGeomSetBody(geom, body);
  dSpaceAdd(space_, geom);
  bodies_.push_back(body);
  return body;
}

Program::Work BodyWorld::step() {
  pairs_ = 0;
  found_.clear();
  const double begin_ns = now_ns();
  dSpaceCollide(space_, this, &BodyWorld::near);
  const double collision_ms = (now_ns() - begin_ns) * 1e-6;
  join();
  act();
  dWorldQuickStep(world_, kTimeStep);
  dJointGroupEmpty(joints_);
  return {collision_ms, pairs_, found_.size()};
}

void BodyWorld::near(void* self, dGeomID o1, dGeomID o2) {
  static_cast<BodyWorld*>(self)->meet(o1, o2);
}

void BodyWorld::meet(dGeomID o1, dGeomID o2) {
  ++pairs_;
  if (rests(dGeomGetBody(o1)) && rests(dGeomGetBody(o2))) return;
  dContactGeom contacts[kMaxContacts];
  const int count = dCollide(o1, o2, kMaxContacts, contacts, sizeof(dContactGeom));
  found_.insert(found_.end(), contacts, contacts + count);
}

void BodyWorld::join() {
  dContact contact{};
  contact.surface.mode = dContactBounce | dContactSoftCFM | dContactApprox1;
  contact.surface.mu = kFriction;
  contact.surface.bounce = kBounce;
  contact.surface.bounce_vel = kBounceVelocity;
  contact.surface.soft_cfm = kSoftConstraintForceMixing;
  for (const dContactGeom& found : found_) {
    contact.geom = found;
    const dJointID joint = dJointCreateContact(world_, joints_, &contact);
    dJointAttach(joint, dGeomGetBody(found.g1), dGeomGetBody(found.g2));
  }
}

std::size_t BodyWorld::geoms() const {
  return static_cast<std::size_t>(dSpaceGetNumGeoms(space_));
}

void BodyWorld::append_state(std::vector<dReal>& state) const {
  for (const dBodyID body : bodies_) append_body_state(body, state);
}

}  // namespace harpoon::bench
