#include "ode/twin_world.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace harpoon::test {
namespace {

constexpr std::uintptr_t kNumberOfWithin = 0xFFFF;
constexpr std::uint64_t kCallbackMark = 0xCA11, kContactMark = 0xC0DE, kNestedMark = 0xE57;

template <class Function>
Function* find(void* library, const char* name) {
  void* const address = dlsym(library, name);
  if (address == nullptr) std::abort();
  return reinterpret_cast<Function*>(address);
}

// The tetrahedron of all mesh geoms.
const double kVertices[] = {0, 0, 0, 0, 0.8, 0, 0, 0, 0, 0.8, 0, 0, 0, 0, 0.8, 0};
const dTriIndex kTriangles[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

// A user class: a ball of radius 0.5 that asks about pairs and lets every third one go.
int ask(dGeomID geom, dGeomID other, dReal*) {
  const auto sum = reinterpret_cast<std::uintptr_t>(dGeomGetData(geom)) +
                   2 * reinterpret_cast<std::uintptr_t>(dGeomGetData(other));
  return sum % 3 == 0 ? 0 : 1;
}
void ball_bounds(dGeomID geom, dReal bounds[6]) {
  const dReal* p = dGeomGetPosition(geom);
  for (int axis = 0; axis < 3; ++axis) {
    bounds[2 * axis] = p[axis] - 0.5;
    bounds[2 * axis + 1] = p[axis] + 0.5;
  }
}
dColliderFn* no_collider(int) {
  return nullptr;
}

/// One class for all worlds: libode has room for four.
int ball_class() {
  static const int number = [] {
    const dGeomClass description{0, &no_collider, &ball_bounds, &ask, nullptr};
    return dCreateGeomClass(&description);
  }();
  return number;
}

}  // namespace

const StockOde& stock_ode() {
  static const StockOde ode = [] {
    void* const library = dlopen("libode.so.8", RTLD_LAZY | RTLD_NOLOAD);
    if (library == nullptr) std::abort();
    return StockOde{find<void(dSpaceID, void*, dNearCallback*)>(library, "dSpaceCollide"),
                    find<void(dGeomID, dGeomID, void*, dNearCallback*)>(library, "dSpaceCollide2"),
                    find<int(dGeomID, dGeomID, int, dContactGeom*, int)>(library, "dCollide"),
                    find<void(dGeomID)>(library, "dGeomEnable"),
                    find<void(dGeomID)>(library, "dGeomDisable")};
  }();
  return ode;
}

const StockOde& linked_ode() {
  static const StockOde ode{&dSpaceCollide, &dSpaceCollide2, &dCollide, &dGeomEnable,
                            &dGeomDisable};
  return ode;
}

World::World(const StockOde& ode, const WorldPlan& plan, std::uint64_t seed)
    : ode_(ode), plan_(plan), random_(seed), world_(dWorldCreate()), others_(nullptr) {
  const dVector3 center = {0, 0, 0, 0}, extents = {plan.extent, plan.extent, plan.extent, 0};
  switch (plan.kind) {
    case SpaceKind::simple:
      space_ = dSimpleSpaceCreate(nullptr);
      break;
    case SpaceKind::hash:
      space_ = dHashSpaceCreate(nullptr);
      break;
    case SpaceKind::sap: {
      constexpr int kAxes[] = {dSAP_AXES_XYZ, dSAP_AXES_XZY, dSAP_AXES_YXZ,
                               dSAP_AXES_YZX, dSAP_AXES_ZXY, dSAP_AXES_ZYX};
      space_ = dSweepAndPruneSpaceCreate(nullptr, kAxes[random_.below(6)]);
      break;
    }
    case SpaceKind::quadtree:
      space_ = dQuadTreeSpaceCreate(nullptr, center, extents, 3);
      break;
  }
  if (plan.user_class) user_class_ = ball_class();
  mesh_ = dGeomTriMeshDataCreate();
  dGeomTriMeshDataBuildDouble(mesh_, kVertices, 4 * sizeof(double), 4, kTriangles, 12,
                              3 * sizeof(dTriIndex));
  if (plan.space_within) {
    within_ = dSimpleSpaceCreate(space_);
    dGeomSetData(reinterpret_cast<dGeomID>(within_), reinterpret_cast<void*>(kNumberOfWithin));
  }
  slots_.resize(plan.geoms);
  for (std::uint32_t number = 0; number < plan.geoms; ++number) {
    fill(number);
    dSpaceAdd(within_ != nullptr && number % 8 == 0 ? within_ : space_, slots_[number].geom);
  }
  if (plan.others != 0) {
    others_ = plan.hash_others ? dHashSpaceCreate(nullptr) : dSimpleSpaceCreate(nullptr);
    for (std::uint32_t k = 0; k < plan.others; ++k) {
      slots_.emplace_back();
      const auto number = static_cast<std::uint32_t>(slots_.size() - 1);
      fill(number);
      dSpaceAdd(others_, slots_[number].geom);
    }
  }
}

World::~World() {
  if (others_ != nullptr) dSpaceDestroy(others_);
  dSpaceDestroy(space_);
  dGeomTriMeshDataDestroy(mesh_);
  dWorldDestroy(world_);
}

double World::coordinate() {
  const double value = random_.between(-plan_.extent, plan_.extent);
  if (!plan_.lattice) return value;
  // Some gaps are too small for the binary32 numbers that SAP spaces sort by, and for some of
  // libode's colliders.
  const double gap = plan_.spheres_only && random_.below(4) == 0 ? 1e-9 : 0;
  return static_cast<double>(static_cast<std::int64_t>(value * 4)) / 4 + gap;
}

double World::size() {
  return size_of(random_);
}

double World::size_of(Random& random) const {
  return plan_.lattice ? 0.25 * static_cast<double>(1 + random.below(3)) : random.between(0.1, 0.7);
}

dGeomID World::make_shape() {
  const std::uint64_t shape = plan_.spheres_only ? 0 : random_.below(plan_.user_class ? 14 : 12);
  const double a = size(), b = size(), c = size();
  switch (shape) {
    default:
      return dCreateSphere(nullptr, !plan_.all_enabled && random_.below(40) == 0 ? 0 : a);
    case 4:
    case 5:
      return dCreateBox(nullptr, 2 * a, 2 * b,
                        !plan_.all_enabled && random_.below(20) == 0 ? 0 : 2 * c);
    case 6:
      return dCreateCapsule(nullptr, a, b);
    case 7:
      return dCreateCylinder(nullptr, a, b);
    case 8:
      return random_.below(4) == 0
                 ? dCreatePlane(nullptr, random_.below(2) == 0 ? 0.3 : 0, 0, 1, -plan_.extent)
                 : dCreateBox(nullptr, 3 * a, b, c);
    case 9:
      return dCreateRay(nullptr, 2 * plan_.extent);
    case 10:
      return dCreateTriMesh(nullptr, mesh_, nullptr, nullptr, nullptr);
    case 11: {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
      const dGeomID transform = dCreateGeomTransform(nullptr);
      const dGeomID inner = dCreateSphere(nullptr, a);
      dGeomSetPosition(inner, b, 0, 0);
      dGeomTransformSetCleanup(transform, 1);
      dGeomTransformSetGeom(transform, inner);
      return transform;
#pragma GCC diagnostic pop
    }
    case 12:
    case 13:
      return dCreateGeom(user_class_);
  }
}

/// A new geom for a place: with or without a body, or on that of its predecessor.
void World::fill(std::uint32_t number) {
  Slot& slot = slots_[number];
  slot.geom = make_shape();
  slot.body = nullptr;
  dGeomSetData(slot.geom, reinterpret_cast<void*>(static_cast<std::uintptr_t>(number)));
  const bool placeable = dGeomGetClass(slot.geom) != dPlaneClass;
  if (placeable && random_.below(3) != 0) {
    slot.body = dBodyCreate(world_);
    dGeomSetBody(slot.geom, slot.body);
  } else if (placeable && number > 0 && random_.below(3) == 0 && slots_[number - 1].body) {
    dGeomSetBody(slot.geom, slots_[number - 1].body);
    dGeomSetOffsetPosition(slot.geom, size(), 0, 0);
  }
  if (random_.below(5) == 0) dGeomSetCategoryBits(slot.geom, 1UL << (random_.below(5) * 15));
  if (random_.below(5) == 0) dGeomSetCollideBits(slot.geom, 1UL << (random_.below(5) * 15));
  place(number);
}

void World::place(std::uint32_t number) {
  const dGeomID geom = slots_[number].geom;
  const double x = coordinate(), y = coordinate(), z = coordinate();
  dQuaternion turn = {random_.between(0.5, 1), random_.unit(), random_.unit(), random_.unit()};
  dSafeNormalize4(turn);
  if (!plan_.lattice && dGeomGetClass(geom) != dPlaneClass) dGeomSetQuaternion(geom, turn);
  if (dGeomGetClass(geom) == dPlaneClass) {
    dGeomPlaneSetParams(geom, x > 0 ? 0.3 : 0, 0, 1, -plan_.extent);
  } else if (dGeomGetBody(geom) != nullptr) {
    dBodySetPosition(dGeomGetBody(geom), x, y, z);
  } else {
    dGeomSetPosition(geom, x, y, z);
  }
}

void World::change_one() {
  const auto number = static_cast<std::uint32_t>(random_.below(slots_.size()));
  Slot& slot = slots_[number];
  const dGeomID geom = slot.geom;
  const bool placeable = dGeomGetClass(geom) != dPlaneClass;
  switch (random_.below(plan_.keeps_geoms ? 8 : 12)) {
    default:
      place(number);
      return;
    case 5:
      if (dGeomGetClass(geom) == dSphereClass) dGeomSphereSetRadius(geom, size());
      if (dGeomGetClass(geom) == dBoxClass) dGeomBoxSetLengths(geom, size(), size(), size());
      return;
    case 6:
      if (plan_.all_enabled) return;
      ++toggled;
      (random_.below(3) == 0 ? ode_.geom_disable : ode_.geom_enable)(geom);
      return;
    case 7:
      dGeomSetCategoryBits(geom, random_.below(3) == 0 ? 1UL << (random_.below(5) * 15) : ~0UL);
      dGeomSetCollideBits(geom, random_.below(3) == 0 ? 1UL << (random_.below(5) * 15) : ~0UL);
      return;
    case 8:
      if (placeable) dGeomSetBody(geom, random_.below(2) == 0 ? nullptr : slot.body);
      return;
    case 9: {
      const dSpaceID home = dGeomGetSpace(geom);
      dSpaceRemove(home, geom);
      ++removed;
      // Behind a clean geom libode's lists are not looked at any more: bounds there stay old, and a
      // build with assertions ends the process.
      if (!plan_.changes_in_callbacks || random_.below(2) == 0) place(number);
      dSpaceAdd(home, geom);
      if (placeable && !plan_.changes_in_callbacks) place(number);
      return;
    }
    case 10: {
      const dSpaceID home = dGeomGetSpace(geom);
      dGeomDestroy(geom);
      ++removed;
      fill(number);
      dSpaceAdd(home, slots_[number].geom);
      ++added;
      return;
    }
    case 11:
      if (random_.below(4) == 0) dSpaceClean(space_);
      if (plan_.kind == SpaceKind::hash && random_.below(8) == 0) {
        const int low = static_cast<int>(random_.below(6)) - 4;
        dHashSpaceSetLevels(space_, low, low + static_cast<int>(random_.below(5)));
      }
      return;
  }
}

/// Places or sizes of a few geoms, now and then of others than before.
void World::move_few() {
  if (movers_.empty() || random_.below(6) == 0) {
    movers_.resize(1 + random_.below(random_.below(2) == 0 ? 2 : slots_.size() / 12 + 1));
    for (std::uint32_t& number : movers_) {
      number = static_cast<std::uint32_t>(random_.below(slots_.size()));
    }
  }
  for (const std::uint32_t number : movers_) {
    place(number);
    if (random_.below(8) == 0) dSpaceClean(space_);
    const dGeomID geom = slots_[number].geom;
    if (random_.below(8) == 0 && dGeomGetClass(geom) == dSphereClass) {
      dGeomSphereSetRadius(geom, !plan_.all_enabled && random_.below(4) == 0 ? 0 : size());
    }
  }
}

void World::change() {
  if (plan_.few_movers && random_.below(12) != 0) {
    if (random_.below(6) != 0) move_few();
    return;
  }
  const std::uint64_t mood = random_.below(6);
  if (mood == 0) return;  // nothing moves
  const std::uint64_t changes = mood == 1 ? slots_.size() : 1 + random_.below(6);
  if (mood == 1) {
    for (std::uint32_t number = 0; number < slots_.size(); ++number) place(number);
  }
  for (std::uint64_t k = 0; k < (mood == 1 ? 2 : changes); ++k) change_one();
}

std::uint64_t World::number_of(dGeomID geom) const {
  return reinterpret_cast<std::uintptr_t>(dGeomGetData(geom));
}

void World::near(void* world, dGeomID o1, dGeomID o2) {
  static_cast<World*>(world)->on_near(o1, o2);
}

void World::near_nested(void* data, dGeomID o1, dGeomID o2) {
  auto& world = *static_cast<World*>(data);
  world.note(kNestedMark);
  world.note(world.number_of(o1) << 32 | world.number_of(o2));
  world.note_contacts(o1, o2, 3);
}

void World::note_contacts(dGeomID o1, dGeomID o2, int flags) {
  if (dGeomIsSpace(o1) != 0 || dGeomIsSpace(o2) != 0) return;
  // libode's colliders for a box and a box, capsule or cylinder abort where axes are aligned or
  // many corners fall together.
  const int class1 = dGeomGetClass(o1), class2 = dGeomGetClass(o2);
  if (std::min(class1, class2) == dBoxClass && std::max(class1, class2) <= dCylinderClass) return;
  // And those for a ray and a sphere without extent, where the ray ends in it.
  const bool has_ray = class1 == dRayClass || class2 == dRayClass;
  for (const dGeomID geom : {o1, o2}) {
    if (has_ray && dGeomGetClass(geom) == dSphereClass && dGeomSphereGetRadius(geom) == 0) return;
  }
  dContactGeom found[8];
  std::memset(found, 0x5A, sizeof found);
  const int count = ode_.collide(o1, o2, flags, found, sizeof(dContactGeom));
  note(kContactMark + static_cast<std::uint64_t>(count));
  contacts += static_cast<std::uint64_t>(count);
  for (int k = 0; k < count; ++k) {
    const dContactGeom& c = found[k];
    for (const dReal value :
         {c.pos[0], c.pos[1], c.pos[2], c.normal[0], c.normal[1], c.normal[2], c.depth}) {
      note(std::bit_cast<std::uint64_t>(value));
    }
    note(static_cast<std::uint64_t>(c.side1) << 32 ^ static_cast<std::uint64_t>(c.side2));
  }
}

void World::on_near(dGeomID o1, dGeomID o2) {
  ++callbacks;
  ++in_call_;
  note(kCallbackMark);
  note(number_of(o1) << 32 | number_of(o2));
  if (dGeomIsSpace(o1) != 0 || dGeomIsSpace(o2) != 0) {
    ode_.space_collide2(o1, o2, this, &near_nested);
  }
  // Choices of callbacks depend on what they see and when, not on the script's random numbers.
  Random choice(number_of(o1) << 40 ^ number_of(o2) << 16 ^ in_call_ << 56 ^ calls_);
  if (choice.below(4) != 0) note_contacts(o1, o2, 1 + static_cast<int>(choice.below(8)));
  if (choice.below(8) == 0) note_contacts(o2, o1, 2);
  if (choice.below(16) == 0) note_contacts(o1, slots_[choice.below(slots_.size())].geom, 1);
  if (plan_.toggles_in_callbacks && choice.below(12) == 0) {
    ++toggled;
    const dGeomID geom = choice.below(2) == 0 ? (choice.below(2) == 0 ? o1 : o2)
                                              : slots_[choice.below(slots_.size())].geom;
    (choice.below(2) == 0 ? ode_.geom_disable : ode_.geom_enable)(geom);
  }
  if (moves_others_ && choice.below(24) == 0) move_other(o1, o2, choice.bits());
  // Each move takes libode's walk over a list back to its front: at some time it has to end.
  if (plan_.changes_in_callbacks && in_call_ < 200 && choice.below(16) == 0) {
    change_within(o1, o2, choice);
  }
  if (plan_.nested_calls && others_ != nullptr && choice.below(64) == 0) {
    ++nested;
    // A stock SAP space that is collided within its own callbacks after geoms were toggled goes on
    // with the wrong geoms.
    const bool may_be_same = plan_.kind != SpaceKind::sap || !plan_.toggles_in_callbacks;
    ode_.space_collide(may_be_same && choice.below(2) == 0 ? space_ : others_, this, &near_nested);
    note_contacts(o1, o2, 4);
  }
}

/// Whatever a callback may do to a geom, be it of the pair, of the space, within a space of it, or
/// of another space.
void World::change_within(dGeomID o1, dGeomID o2, Random& choice) {
  Slot& slot = slots_[choice.below(slots_.size())];
  const dGeomID geom = choice.below(2) == 0 ? slot.geom : choice.below(2) == 0 ? o1 : o2;
  if (dGeomIsSpace(geom) != 0 || dGeomGetClass(geom) == dPlaneClass) return;
  ++changed_in_callbacks;
  const auto at = [&] { return choice.between(-plan_.extent, plan_.extent); };
  dReal bounds[6];
  switch (choice.below(8)) {
    case 0:
      dGeomSetCategoryBits(geom, choice.below(2) == 0 ? 0 : ~0UL);
      dGeomSetCollideBits(geom, choice.below(2) == 0 ? 0 : ~0UL);
      return;
    case 1:
      // libode does not survive this with an offset that it has yet to look at.
      if (dGeomIsOffset(geom) == 0) dGeomSetBody(geom, slot.body);
      return;
    case 2:
      dGeomSetPosition(geom, at(), at(), at());
      return;
    case 3:
      dGeomSetPosition(geom, at(), at(), at());
      dGeomGetAABB(geom, bounds);
      return;
    case 4:
      if (dGeomGetClass(geom) == dSphereClass) dGeomSphereSetRadius(geom, size_of(choice));
      return;
    case 5:
      if (slot.body != nullptr) dBodySetPosition(slot.body, at(), at(), at());
      return;
    case 6:
      dSpaceClean(space_);
      return;
    default: {
      // A stock quadtree goes on with geoms that have left it.
      if (plan_.kind == SpaceKind::quadtree) return;
      const dSpaceID home = dGeomGetSpace(geom);
      const dSpaceID next = within_ != nullptr && choice.below(2) == 0 ? within_ : home;
      dSpaceRemove(home, geom);
      dGeomSetPosition(geom, at(), at(), at());
      dSpaceAdd(next, geom);
      return;
    }
  }
}

void World::collide() {
  ++calls_;
  in_call_ = 0;
  ode_.space_collide(space_, this, &near);
}

/// Moves a geom of the second space while that is walked over: a clean one comes to the front of
/// the list, and libode does not come to it any more. The geom at hand, which libode would abort
/// on, and those on bodies stay where they are.
void World::move_other(dGeomID o1, dGeomID o2, std::uint64_t choice) {
  const std::size_t number = first_other() + choice % plan_.others;
  const dGeomID geom = slots_[number].geom;
  if (geom == o1 || geom == o2 || dGeomGetBody(geom) != nullptr) return;
  ++moved_between;
  place(static_cast<std::uint32_t>(number));
}

void World::collide_with_others() {
  if (others_ == nullptr) return;
  ++calls_;
  in_call_ = 0;
  const bool spaces_first = random_.below(2) == 0;
  if (spaces_first) collide_spaces();
  const auto space = reinterpret_cast<dGeomID>(space_);
  const std::size_t end = std::min(slots_.size(), first_other() + 4);
  for (std::size_t k = first_other(); k < end; ++k) {
    const bool space_first = random_.below(2) == 0;
    ode_.space_collide2(space_first ? space : slots_[k].geom, space_first ? slots_[k].geom : space,
                        this, &near);
  }
  if (!spaces_first) collide_spaces();
}

void World::collide_spaces() {
  if (random_.below(3) != 0) return;
  const auto space = reinterpret_cast<dGeomID>(space_), others = reinterpret_cast<dGeomID>(others_);
  if (random_.below(2) == 0) dSpaceClean(others_);
  const bool space_first = random_.below(2) == 0;
  const int left = dSpaceGetNumGeoms(others_) - dSpaceGetNumGeoms(space_);
  // In the other order of sizes libode walks over the first space and locks the second; where they
  // are the same it walks over the second argument.
  moves_others_ = left < 0 || (left == 0 && space_first);
  ++between_spaces;
  ode_.space_collide2(space_first ? space : others, space_first ? others : space, this, &near);
  moves_others_ = false;
}

std::vector<std::uint64_t> World::take_trace() {
  return std::exchange(trace_, {});
}

}  // namespace harpoon::test
