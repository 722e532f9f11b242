#include "apps/stock_frame.hpp"

#include <ode/ode.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstdio>
#include <unordered_map>

#include "apps/exit_code.hpp"
#include "bench/ode/runtime.hpp"

namespace harpoon::app {
namespace {

/// A geom of the user's class carries a pointer to its recorded bounds.
void recorded_bounds(dGeomID geom, dReal bounds[6]) {
  const auto* const recorded = *static_cast<const ode::FrameGeom**>(dGeomGetClassData(geom));
  std::transform(recorded->bounds, recorded->bounds + 6, bounds,
                 [](double bound) { return static_cast<dReal>(bound); });
}

dColliderFn* no_collider(int) {
  return nullptr;
}

void note(void* pairs, dGeomID o1, dGeomID o2) {
  const auto number = [](dGeomID geom) {
    return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(dGeomGetData(geom)));
  };
  static_cast<std::vector<IndexPair>*>(pairs)->push_back({number(o1), number(o2)});
}

/// Leaves libode where it would abort. What it had allocated stays behind.
void throw_instead([[maybe_unused]] int number, const char* format, std::va_list arguments) {
  std::array<char, 500> text{};
  std::vsnprintf(text.data(), text.size(), format, arguments);
  throw CommandError(ExitCode::failure,
                     std::string("stock ODE aborts on these geoms: ") + text.data());
}

dSpaceID make_space(const ode::CollisionFrame& frame) {
  switch (frame.kind) {
    case dSimpleSpaceClass:
      return dSimpleSpaceCreate(nullptr);
    case dHashSpaceClass: {
      const dSpaceID space = dHashSpaceCreate(nullptr);
      dHashSpaceSetLevels(space, frame.min_level, frame.max_level);
      return space;
    }
    default:
      return dSweepAndPruneSpaceCreate(nullptr, frame.axis_order);
  }
}

}  // namespace

std::vector<IndexPair> collide_in_stock(const ode::CollisionFrame& frame) {
  const bench::OdeRuntime runtime;
  dSetDebugHandler(&throw_instead);
  const dGeomClass description{sizeof(const ode::FrameGeom*), &no_collider, &recorded_bounds,
                               nullptr, nullptr};
  const int number = dCreateGeomClass(&description);
  const dWorldID world = dWorldCreate();
  const dSpaceID space = make_space(frame);
  std::unordered_map<std::uint32_t, dBodyID> bodies;
  const std::size_t count = frame.geoms.size();
  for (std::size_t k = 0; k < count; ++k) {
    // Simple and hash spaces put new geoms in front.
    const std::size_t at = frame.kind == dSweepAndPruneSpaceClass ? k : count - 1 - k;
    const ode::FrameGeom& recorded = frame.geoms[at];
    const dGeomID geom = dCreateGeom(number);
    *static_cast<const ode::FrameGeom**>(dGeomGetClassData(geom)) = &recorded;
    dGeomSetData(geom, reinterpret_cast<void*>(at));
    if (recorded.body != 0) {
      dBodyID& body = bodies[recorded.body];
      if (body == nullptr) body = dBodyCreate(world);
      dGeomSetBody(geom, body);
    }
    dGeomSetCategoryBits(geom, recorded.category);
    dGeomSetCollideBits(geom, recorded.collide);
    dSpaceAdd(space, geom);
  }
  std::vector<IndexPair> pairs;
  dSpaceCollide(space, &pairs, &note);
  dSpaceDestroy(space);
  dWorldDestroy(world);
  return pairs;
}

}  // namespace harpoon::app
