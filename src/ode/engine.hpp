#pragma once

// The drop-in as one object: what libode's collision entry points do instead of libode, and what
// has to be told about changes. Who interposes symbols or calls it by hand is no concern of it.
//
// Events are reported by the thread that makes the change, after libode has made it unless said
// otherwise. Any number of threads may be in an engine as long as each works on spaces of its own,
// which is all that libode allows.

#include <functional>
#include <memory>
#include <string>

#include "harpoon/device.hpp"
#include "ode/frame_file.hpp"
#include "ode/libode.hpp"
#include "ode/options.hpp"
#include "ode/statistics.hpp"
#include "ode/types.hpp"
#include "ode/verify.hpp"

namespace harpoon::ode {

class Engine {
 public:
  virtual ~Engine() = default;

  // dSpaceCollide, dSpaceCollide2 and dCollide. `contact` is dCollide's array.
  virtual void space_collide(dxSpace* space, void* data, NearCallback* callback) = 0;
  virtual void space_collide2(dxGeom* o1, dxGeom* o2, void* data, NearCallback* callback) = 0;
  virtual int collide(dxGeom* o1, dxGeom* o2, int flags, void* contact, int skip) = 0;

  /// Before a change of a geom, or of a space's members: libode's traversals read some of it while
  /// they walk. Needed only while callbacks are running (`open_frames`). Null is nobody.
  virtual void changing(dxGeom* geom, Change change) = 0;
  /// dGeomMoved: a geom's bounds or pose. Not null.
  virtual void moved(dxGeom* geom) = 0;
  /// Body, category or collide bits.
  virtual void filters_changed(dxGeom* geom) = 0;
  /// dGeomEnable and dGeomDisable, where the flag has changed.
  virtual void toggled(dxGeom* geom) = 0;
  virtual void added(dxSpace* space) = 0;
  virtual void removed(dxSpace* space, dxGeom* geom) = 0;
  /// Before dGeomDestroy.
  virtual void destroying(dxGeom* geom) = 0;
  /// dHashSpaceSetLevels.
  virtual void levels_changed(dxSpace* space) = 0;
  virtual void sap_created(dxSpace* space, int axis_order) = 0;
  /// dCreateGeomClass; `test` may be null.
  virtual void class_created(int number, AabbTest* test) = 0;
  /// dSetColliderOverride.
  virtual void collider_overridden(int class1, int class2) = 0;
  /// dCloseODE.
  virtual void closed() = 0;

  /// An event could not be noted: nothing that is known holds any more. Allocates nothing.
  virtual void lost_track() noexcept = 0;

  [[nodiscard]] virtual const Statistics& statistics() const = 0;
  /// `statistics` and the device that serves contacts, as one line.
  [[nodiscard]] virtual std::string report() const = 0;
};

/// What an engine is made of besides libode.
struct EngineParts {
  Options options;
  std::unique_ptr<Device> device;  ///< for contacts; not null
  LogCallback log;                 ///< may be empty
  /// Under `Options::verify`: called with the first difference; should not return. The frame is
  /// that of the callback sequence, null for a contact or a quadtree.
  Differs differs;
  /// Called before the first space is looked at: until then the engine need not hear of any
  /// `moved`. May be empty.
  std::function<void()> before_first_space = {};
  /// Called when the engine need not hear of any `moved` until it calls `before_first_space` again.
  /// May be empty.
  std::function<void()> without_spaces = {};
  /// Called before callbacks are first called for pairs of the engine's own: until then it need not
  /// hear of any `collide`. May be empty.
  std::function<void()> before_first_frame = {};
};

/// Errors: out_of_memory.
template <class Real>
Result<std::unique_ptr<Engine>> make_engine(const LibodeOf<Real>& ode, EngineParts parts);

}  // namespace harpoon::ode
