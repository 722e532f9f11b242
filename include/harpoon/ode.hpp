#pragma once

/// ODE by hand: for programs that link ODE statically, and for contacts without callbacks. A
/// program that is linked to libode.so needs nothing of it: LD_PRELOAD=libharpoon_ode.so
/// (docs/ode.md).
///
/// Not part of harpoon.hpp; link to libharpoon_ode. It works beside the preload. `Real` is dReal.

#include <cstdarg>
#include <memory>
#include <span>
#include <utility>

#include "harpoon/device.hpp"
#include "harpoon/error.hpp"
#include "harpoon/export.hpp"

// ODE's handles: dGeomID, dSpaceID, dBodyID and dWorldID are pointers to these.
struct dxGeom;
struct dxSpace;
struct dxBody;
struct dxWorld;

namespace harpoon::ode {

/// dNearCallback.
using NearCallback = void(void* data, dxGeom* o1, dxGeom* o2);
/// dMessageFunction.
using MessageFunction = void(int number, const char* message, std::va_list arguments);

/// dContactGeom, member by member.
template <class Real>
struct ContactGeomOf {
  Real pos[4];
  Real normal[4];
  Real depth;
  dxGeom *g1, *g2;
  int side1, side2;
};
static_assert(sizeof(ContactGeomOf<double>) == 96 && sizeof(ContactGeomOf<float>) == 64);

/// The functions of ODE that Harpoon calls, each under its name in ODE without the d: any build of
/// ODE can be served. All must be set.
template <class Real>
struct LibodeOf {
  void (*space_collide)(dxSpace*, void*, NearCallback*) = nullptr;
  void (*space_collide2)(dxGeom*, dxGeom*, void*, NearCallback*) = nullptr;
  void (*space_clean)(dxSpace*) = nullptr;
  int (*space_get_num_geoms)(dxSpace*) = nullptr;
  dxGeom* (*space_get_geom)(dxSpace*, int) = nullptr;
  int (*space_get_sublevel)(dxSpace*) = nullptr;
  void (*hash_space_get_levels)(dxSpace*, int*, int*) = nullptr;

  int (*collide)(dxGeom*, dxGeom*, int, ContactGeomOf<Real>*, int) = nullptr;

  int (*geom_get_class)(dxGeom*) = nullptr;
  int (*geom_is_enabled)(dxGeom*) = nullptr;
  void (*geom_enable)(dxGeom*) = nullptr;
  void (*geom_disable)(dxGeom*) = nullptr;
  dxSpace* (*geom_get_space)(dxGeom*) = nullptr;
  dxBody* (*geom_get_body)(dxGeom*) = nullptr;
  unsigned long (*geom_get_category_bits)(dxGeom*) = nullptr;
  unsigned long (*geom_get_collide_bits)(dxGeom*) = nullptr;
  void (*geom_get_aabb)(dxGeom*, Real*) = nullptr;
  const Real* (*geom_get_position)(dxGeom*) = nullptr;
  Real (*sphere_get_radius)(dxGeom*) = nullptr;
  void (*box_get_lengths)(dxGeom*, Real*) = nullptr;
  void (*capsule_get_params)(dxGeom*, Real*, Real*) = nullptr;
  void (*cylinder_get_params)(dxGeom*, Real*, Real*) = nullptr;

  // Used once, to see what this build of ODE does with geoms of Harpoon's own: the bits of its
  // contacts of spheres, whether it ends the process when a callback changes a geom, and where it
  // keeps what is read of every geom.
  dxSpace* (*simple_space_create)(dxSpace*) = nullptr;
  dxGeom* (*create_sphere)(dxSpace*, Real) = nullptr;
  void (*geom_set_position)(dxGeom*, Real, Real, Real) = nullptr;
  void (*geom_set_offset_position)(dxGeom*, Real, Real, Real) = nullptr;
  void (*geom_set_body)(dxGeom*, dxBody*) = nullptr;
  void (*geom_set_category_bits)(dxGeom*, unsigned long) = nullptr;
  void (*geom_set_collide_bits)(dxGeom*, unsigned long) = nullptr;
  void (*geom_destroy)(dxGeom*) = nullptr;
  dxWorld* (*world_create)() = nullptr;
  void (*world_destroy)(dxWorld*) = nullptr;
  dxBody* (*body_create)(dxWorld*) = nullptr;
  MessageFunction* (*get_debug_handler)() = nullptr;
  void (*set_debug_handler)(MessageFunction*) = nullptr;
};

#if defined(_ODE_COLLISION_H_)
/// The functions that this program is linked to. There when <ode/ode.h> is included before this
/// header.
inline LibodeOf<dReal> linked_libode() {
  LibodeOf<dReal> ode;
  ode.space_collide = &dSpaceCollide;
  ode.space_collide2 = &dSpaceCollide2;
  ode.space_clean = &dSpaceClean;
  ode.space_get_num_geoms = &dSpaceGetNumGeoms;
  ode.space_get_geom = &dSpaceGetGeom;
  ode.space_get_sublevel = &dSpaceGetSublevel;
  ode.hash_space_get_levels = &dHashSpaceGetLevels;
  ode.collide = reinterpret_cast<decltype(ode.collide)>(&dCollide);
  ode.geom_get_class = &dGeomGetClass;
  ode.geom_is_enabled = &dGeomIsEnabled;
  ode.geom_enable = &dGeomEnable;
  ode.geom_disable = &dGeomDisable;
  ode.geom_get_space = &dGeomGetSpace;
  ode.geom_get_body = &dGeomGetBody;
  ode.geom_get_category_bits = &dGeomGetCategoryBits;
  ode.geom_get_collide_bits = &dGeomGetCollideBits;
  ode.geom_get_aabb = &dGeomGetAABB;
  ode.geom_get_position = &dGeomGetPosition;
  ode.sphere_get_radius = &dGeomSphereGetRadius;
  ode.box_get_lengths = &dGeomBoxGetLengths;
  ode.capsule_get_params = &dGeomCapsuleGetParams;
  ode.cylinder_get_params = &dGeomCylinderGetParams;
  ode.simple_space_create = &dSimpleSpaceCreate;
  ode.create_sphere = &dCreateSphere;
  ode.geom_set_position = &dGeomSetPosition;
  ode.geom_set_offset_position = &dGeomSetOffsetPosition;
  ode.geom_set_body = &dGeomSetBody;
  ode.geom_set_category_bits = &dGeomSetCategoryBits;
  ode.geom_set_collide_bits = &dGeomSetCollideBits;
  ode.geom_destroy = &dGeomDestroy;
  ode.world_create = &dWorldCreate;
  ode.world_destroy = &dWorldDestroy;
  ode.body_create = &dBodyCreate;
  ode.get_debug_handler = &dGetDebugHandler;
  ode.set_debug_handler = &dSetDebugHandler;
  return ode;
}
#endif

struct ColliderOptions {
  /// Pairs that a stock hash space misses are reported as well.
  bool with_missed_pairs = false;
  /// Receives what would otherwise have ended the program. May be empty.
  LogCallback log = {};
};

namespace detail {

/// What a collider is made of, in libharpoon_ode_engine. That library is loaded when the first is
/// made, for most programs that load libharpoon_ode never make one.
template <class Real>
class ColliderWork {
 public:
  virtual ~ColliderWork() = default;
  virtual void space_collide(dxSpace* space, void* data, NearCallback* callback) = 0;
  virtual void space_collide2(dxGeom* o1, dxGeom* o2, void* data, NearCallback* callback) = 0;
  virtual int collide(dxGeom* o1, dxGeom* o2, int flags, ContactGeomOf<Real>* contacts,
                      int skip) = 0;
  virtual Result<std::span<const ContactGeomOf<Real>>> contacts(dxSpace* space,
                                                                int max_contacts) noexcept = 0;
  virtual void sap_created(dxSpace* space, int axis_order) = 0;
  virtual void destroying(dxSpace* space) = 0;
};

}  // namespace detail
}  // namespace harpoon::ode

/// Behind `ColliderOf::make`: puts the ColliderWork or an error into `*collider`, a Result of a
/// unique_ptr of it. False when the library that makes it cannot be loaded.
extern "C" HARPOON_API bool harpoon_ode_make_collider(int real_bytes, const void* ode,
                                                      const harpoon::ode::ColliderOptions* options,
                                                      void* collider);

namespace harpoon::ode {

/// Collides spaces as ODE does: the same pairs in the same order, the same contacts.
///
/// Nothing tells it of changes, so every call reads all geoms of the space, and callbacks must not
/// change, enable or disable geoms that are being collided; ODE's own calls may be mixed with it at
/// will. Sweep-and-prune spaces are Harpoon's only when `sap_created` was called;
/// they and quadtrees are otherwise collided by ODE. Threads: as ODE, spaces of different threads
/// at the same time.
template <class Real>
class ColliderOf {
 public:
  /// Errors: invalid_argument (a function is missing), out_of_memory, device_unavailable
  /// (libharpoon_ode_engine.so is not beside libharpoon_ode.so).
  static Result<ColliderOf> make(const LibodeOf<Real>& ode,
                                 const ColliderOptions& options = {}) noexcept {
    Result<std::unique_ptr<Work>> made = Error{};
    if (!harpoon_ode_make_collider(sizeof(Real), &ode, &options, &made)) {
      return Error{Errc::device_unavailable,
                   "libharpoon_ode_engine.so is not beside libharpoon_ode.so. Install the whole of "
                   "Harpoon."};
    }
    if (!made) return made.error();
    return ColliderOf(std::move(*made));
  }

  /// dSpaceCollide. Call `collide` in the callback, or dCollide.
  void space_collide(dxSpace* space, void* data, NearCallback* callback) {
    work_->space_collide(space, data, callback);
  }
  /// dSpaceCollide2.
  void space_collide2(dxGeom* o1, dxGeom* o2, void* data, NearCallback* callback) {
    work_->space_collide2(o1, o2, data, callback);
  }
  /// dCollide: faster than ODE's for the spheres of the pair at hand.
  int collide(dxGeom* o1, dxGeom* o2, int flags, ContactGeomOf<Real>* contacts, int skip) {
    return work_->collide(o1, o2, flags, contacts, skip);
  }

  /// All contacts among the geoms of a space, without a callback: for each pair what dCollide gives
  /// with `max_contacts` (1 to 65535), pairs in the order of callbacks. Spaces within the space are
  /// geoms to it. Valid until the next call. Errors: invalid_argument, out_of_memory.
  Result<std::span<const ContactGeomOf<Real>>> contacts(dxSpace* space, int max_contacts) noexcept {
    return work_->contacts(space, max_contacts);
  }

  /// After dSweepAndPruneSpaceCreate, before the space is first collided.
  void sap_created(dxSpace* space, int axis_order) { work_->sap_created(space, axis_order); }
  /// Before a space is destroyed, so that another at its address is not taken for it.
  void destroying(dxSpace* space) { work_->destroying(space); }

 private:
  using Work = detail::ColliderWork<Real>;

  explicit ColliderOf(std::unique_ptr<Work> work) noexcept : work_(std::move(work)) {}
  std::unique_ptr<Work> work_;
};

}  // namespace harpoon::ode
