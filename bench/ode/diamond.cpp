#include "bench/ode/diamond.hpp"

#include <fmt/format.h>
#include <ode/ode.h>

#include <cmath>
#include <numeric>

#include "bench/algorithm1.hpp"

namespace harpoon::bench {
namespace {

constexpr double kConstraintForceMixing = 1e-5;
constexpr double kBounce = 1.0;
constexpr double kBounceVelocity = 0.1;
constexpr double kSoftConstraintForceMixing = 0.001;

// A geom's data pointer points to its sphere's index.
std::uint32_t index_of(dGeomID geom) {
  return *static_cast<const std::uint32_t*>(dGeomGetData(geom));
}

SphereF64 sphere_of(dGeomID geom) {
  const dReal* p = dGeomGetPosition(geom);
  return {p[0], p[1], p[2], dGeomSphereGetRadius(geom)};
}

ContactF64 to_record(const dContactGeom& geom, Flow flow) {
  return {{geom.pos[0], geom.pos[1], geom.pos[2]},
          {geom.normal[0], geom.normal[1], geom.normal[2]},
          geom.depth,
          static_cast<std::uint64_t>(flow)};
}

Result<bool> check(const DiamondParameters& p) {
  const auto bad = [](std::string message) {
    return Error{Errc::invalid_argument, std::move(message)};
  };
  if (p.h_max > kMaxDiamondHMax) {
    return bad(
        fmt::format("hmax is {}, but ODE's hash space aborts beyond 131071 geoms. Use a "
                    "value from 0 to {}.",
                    p.h_max, kMaxDiamondHMax));
  }
  const auto finite_from = [](double value, double least) {
    return std::isfinite(value) && value >= least;
  };
  if (!finite_from(p.d_sph, 0)) {
    return bad(fmt::format("dsph is {}. Use a finite distance of 0 or more.", p.d_sph));
  }
  if (!finite_from(p.force, 0)) {
    return bad(fmt::format("force is {}. Use a finite force of 0 or more.", p.force));
  }
  const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
  if (!positive(p.radius) || !positive(p.mass) || !positive(p.time_step)) {
    return bad(
        fmt::format("radius, mass and time step are {}, {} and {}. Use finite values above "
                    "0.",
                    p.radius, p.mass, p.time_step));
  }
  return true;
}

}  // namespace

Result<std::unique_ptr<DiamondWorld>> DiamondWorld::create(const DiamondParameters& parameters) {
  if (const Result<bool> checked = check(parameters); !checked) {
    return checked.error();
  }
  return std::unique_ptr<DiamondWorld>(new DiamondWorld(parameters));
}

DiamondWorld::DiamondWorld(const DiamondParameters& parameters)
    : parameters_(parameters),
      world_(dWorldCreate()),
      space_(dHashSpaceCreate(nullptr)),
      joints_(dJointGroupCreate(0)) {
  dWorldSetCFM(world_, kConstraintForceMixing);
  dMass mass;
  dMassSetSphereTotal(&mass, parameters.mass, parameters.radius);
  const double spacing = 2 * parameters.radius + parameters.d_sph;
  indices_.resize(diamond_sphere_count(parameters.h_max));
  std::iota(indices_.begin(), indices_.end(), 0U);
  for (const Point& p : diamond_points(parameters.h_max, spacing)) {
    dBodyID body = dBodyCreate(world_);
    dBodySetPosition(body, p[0], p[1], p[2]);
    dBodySetMass(body, &mass);
    dGeomID geom = dCreateSphere(space_, parameters.radius);
    dGeomSetBody(geom, body);
    dGeomSetData(geom, &indices_[bodies_.size()]);
    bodies_.push_back(body);
  }
}

DiamondWorld::~DiamondWorld() {
  dJointGroupDestroy(joints_);
  dSpaceDestroy(space_);
  dWorldDestroy(world_);
}

void DiamondWorld::step(const Observer& observe) {
  observer_ = &observe;
  collide();
  observer_ = nullptr;
  advance();
}

std::uint64_t DiamondWorld::collide() {
  candidates_ = 0;
  found_.clear();
  dSpaceCollide(space_, this, &DiamondWorld::near);
  return candidates_;
}

std::size_t DiamondWorld::contact_count() const {
  return found_.size();
}

void DiamondWorld::advance() {
  join();
  pull_to_centre();
  dWorldQuickStep(world_, parameters_.time_step);
  dJointGroupEmpty(joints_);
}

void DiamondWorld::near(void* self, dxGeom* geom1, dxGeom* geom2) {
  static_cast<DiamondWorld*>(self)->meet(geom1, geom2);
}

void DiamondWorld::meet(dxGeom* geom1, dxGeom* geom2) {
  dContactGeom contact;
  const bool hit = dCollide(geom1, geom2, 1, &contact, sizeof contact) != 0;
  ++candidates_;
  if (hit) found_.push_back(contact);
  if (observer_ == nullptr) return;
  const Flow flow =
      hit ? algorithm1(SpherePairF64{sphere_of(geom1), sphere_of(geom2)}).flow() : Flow::fake;
  const ContactF64 record = hit ? to_record(contact, flow) : ContactF64{};
  (*observer_)({{index_of(geom1), index_of(geom2)}, geom1, geom2, flow, hit ? &record : nullptr});
}

void DiamondWorld::join() {
  dContact contact{};
  contact.surface.mode = dContactBounce | dContactSoftCFM;
  contact.surface.mu = dInfinity;
  contact.surface.bounce = kBounce;
  contact.surface.bounce_vel = kBounceVelocity;
  contact.surface.soft_cfm = kSoftConstraintForceMixing;
  for (const dContactGeom& found : found_) {
    contact.geom = found;
    dJointID joint = dJointCreateContact(world_, joints_, &contact);
    dJointAttach(joint, dGeomGetBody(found.g1), dGeomGetBody(found.g2));
  }
}

void DiamondWorld::pull_to_centre() {
  for (dBodyID body : bodies_) {
    const dReal* p = dBodyGetPosition(body);
    const double distance = std::sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    if (distance > 0) {
      const double scale = -parameters_.force / distance;
      dBodyAddForce(body, scale * p[0], scale * p[1], scale * p[2]);
    }
  }
}

Point DiamondWorld::position(std::size_t sphere) const {
  const dReal* p = dBodyGetPosition(bodies_[sphere]);
  return {p[0], p[1], p[2]};
}

std::vector<Point> DiamondWorld::positions() const {
  std::vector<Point> all;
  all.reserve(bodies_.size());
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    all.push_back(position(i));
  }
  return all;
}

}  // namespace harpoon::bench
