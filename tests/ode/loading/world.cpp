// The part of a simulator that uses ODE, as a module that a host loads: worlds in which between two
// calls one thing is changed, each in another way, so that a change that goes unnoticed shows.

#include <ode/ode.h>

#include <cstdint>
#include <vector>

namespace {

/// What callbacks saw, in order.
std::uint64_t trace = 14695981039346656037U;
void note(std::uint64_t value) {
  trace = (trace ^ value) * 1099511628211U;
}

struct Random {
  std::uint64_t state = 1;
  std::uint64_t below(std::uint64_t end) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return (state >> 33) % end;
  }
  dReal place() { return static_cast<dReal>(below(1000)) / 125; }
  dReal size() { return dReal(0.3) + static_cast<dReal>(below(100)) / 150; }
};

void near(void* data, dGeomID o1, dGeomID o2) {
  if (dGeomIsSpace(o1) || dGeomIsSpace(o2)) {
    dSpaceCollide2(o1, o2, data, &near);
    return;
  }
  dContactGeom contacts[4];
  note(reinterpret_cast<std::uintptr_t>(dGeomGetData(o1)));
  note(reinterpret_cast<std::uintptr_t>(dGeomGetData(o2)));
  note(static_cast<std::uint64_t>(dCollide(o1, o2, 4, contacts, sizeof contacts[0])));
}

class World {
 public:
  World(dSpaceID space, std::uint64_t seed) : space_(space) {
    random_.state = seed;
    inner_ = dSimpleSpaceCreate(space_);
    world_ = dWorldCreate();
    for (int k = 0; k < 120; ++k) add();
  }
  ~World() {
    dSpaceDestroy(space_);
    dWorldDestroy(world_);
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  void step(int number) {
    change(number);
    dSpaceCollide(space_, nullptr, &near);
  }

 private:
  enum Shape { sphere, box, capsule, cylinder, ray, shapes };

  void place(dGeomID geom) {
    dGeomSetPosition(geom, random_.place(), random_.place(), random_.place());
  }
  dGeomID create(Shape shape, dSpaceID space) {
    switch (shape) {
      case box:
        return dCreateBox(space, random_.size(), random_.size(), random_.size());
      case capsule:
        return dCreateCapsule(space, random_.size(), random_.size());
      case cylinder:
        return dCreateCylinder(space, random_.size(), random_.size());
      case ray:
        return dCreateRay(space, random_.place());
      default:
        return dCreateSphere(space, random_.size());
    }
  }
  void add() {
    const std::uint64_t kind = random_.below(std::uint64_t{2} * shapes);
    const Shape shape = kind < shapes ? static_cast<Shape>(kind) : sphere;
    const dGeomID geom = create(shape, random_.below(10) == 0 ? inner_ : space_);
    dGeomSetData(geom, reinterpret_cast<void*>(++named_));
    place(geom);
    if (random_.below(3) == 0 && shape != ray) dGeomSetBody(geom, dBodyCreate(world_));
    geoms_.push_back(geom);
  }
  /// One of a shape, or with a body.
  dGeomID any(int geom_class) {
    for (;;) {
      const dGeomID geom = geoms_[random_.below(geoms_.size())];
      if (dGeomGetClass(geom) == geom_class) return geom;
    }
  }
  dGeomID any_with_body() {
    for (int tries = 0; tries < 1000; ++tries) {
      const dGeomID geom = geoms_[random_.below(geoms_.size())];
      if (dGeomGetBody(geom) != nullptr) return geom;
    }
    const dGeomID geom = any(dSphereClass);
    dGeomSetBody(geom, dBodyCreate(world_));
    return geom;
  }
  void change(int number) {
    dMatrix3 rotation;
    dQuaternion quaternion;
    dRFromAxisAndAngle(rotation, 1, 1, 0, random_.place());
    dQFromAxisAndAngle(quaternion, 1, 1, 0, random_.place());
    const dReal x = random_.place(), y = random_.place(), z = random_.place();
    const dReal size = random_.size();
    const dGeomID geom = geoms_[random_.below(geoms_.size())], with_body = any_with_body();
    const dBodyID body = dGeomGetBody(with_body);
    switch (number % 30) {
      case 0:
        return dGeomSetPosition(geom, x, y, z);
      case 1:
        return dGeomSetRotation(any(dBoxClass), rotation);
      case 2:
        return dGeomSetQuaternion(any(dBoxClass), quaternion);
      case 3:
        return dGeomSphereSetRadius(any(dSphereClass), size);
      case 4:
        return dGeomBoxSetLengths(any(dBoxClass), size, size, size);
      case 5:
        return dGeomCapsuleSetParams(any(dCapsuleClass), size, size);
      case 6:
        return dGeomCylinderSetParams(any(dCylinderClass), size, size);
      case 7:
        return dGeomRaySetLength(any(dRayClass), x);
      case 8:
        return dGeomRaySet(any(dRayClass), x, y, z, 0, 1, 0);
      case 9:
        return dBodySetPosition(body, x, y, z);
      case 10:
        return dBodySetRotation(body, rotation);
      case 11:
        return dBodySetQuaternion(body, quaternion);
      case 12:
        return dGeomSetOffsetPosition(with_body, size, 0, 0);
      case 13:
        return dGeomSetOffsetRotation(with_body, rotation);
      case 14:
        return dGeomSetOffsetQuaternion(with_body, quaternion);
      case 15:
        return dGeomSetOffsetWorldPosition(with_body, x, y, z);
      case 16:
        return dGeomSetOffsetWorldRotation(with_body, rotation);
      case 17:
        return dGeomSetOffsetWorldQuaternion(with_body, quaternion);
      case 18:
        return dGeomClearOffset(with_body);
      case 19:
        dBodySetLinearVel(body, x, y, z);
        dWorldStep(world_, dReal(0.05));
        return dBodySetLinearVel(body, 0, 0, 0);
      case 20:
        return dBodyDestroy(body);
      case 21:
        return dGeomSetBody(geom, body);
      case 22:
        return dGeomDisable(geom);
      case 23:
        return dGeomEnable(geom);
      case 24:
        return dGeomSetCategoryBits(geom, random_.below(4));
      case 25:
        return dGeomSetCollideBits(geom, random_.below(4));
      case 26: {
        const dSpaceID home = dGeomGetSpace(geom);
        dSpaceRemove(home, geom);
        return dSpaceAdd(home == space_ ? inner_ : space_, geom);
      }
      case 27: {
        // As many geoms as before.
        for (dGeomID& other : geoms_) {
          if (other == geom) other = geoms_.back();
        }
        geoms_.pop_back();
        dGeomDestroy(geom);
        return add();
      }
      case 28:
        return add();
      default:
        // With all that is in it.
        for (std::size_t k = geoms_.size(); k-- > 0;) {
          if (dGeomGetSpace(geoms_[k]) == inner_)
            geoms_.erase(geoms_.begin() + static_cast<long>(k));
        }
        dSpaceDestroy(inner_);
        inner_ = dSimpleSpaceCreate(space_);
        return;
    }
  }

  dSpaceID space_, inner_;
  dWorldID world_;
  Random random_;
  std::vector<dGeomID> geoms_;
  std::uintptr_t named_ = 0;
};

std::vector<World*> worlds;

}  // namespace

extern "C" {

/// A world in each kind of space.
void begin() {
  dInitODE2(0);
  const dVector3 centre = {4, 4, 4}, extents = {8, 8, 8};
  worlds = {new World(dSimpleSpaceCreate(nullptr), 1), new World(dHashSpaceCreate(nullptr), 2),
            new World(dSweepAndPruneSpaceCreate(nullptr, dSAP_AXES_XYZ), 3),
            new World(dQuadTreeSpaceCreate(nullptr, centre, extents, 3), 4)};
}

void step(int number) {
  for (World* world : worlds) world->step(number);
}

/// What all callbacks have seen, with the state that programs can see besides.
std::uint64_t end() {
  for (World* world : worlds) delete world;
  note(dRandGetSeed());
  dCloseODE();
  return trace;
}

}  // extern "C"
