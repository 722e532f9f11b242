#include "ode/guarded_service.hpp"

#include <unistd.h>

#include <cstdlib>
#include <new>
#include <utility>

#include "ode/frame.hpp"
#include "ode/log.hpp"

namespace harpoon::ode {
namespace {

/// Makes the call in the engine, or in libode when the engine runs out of memory before it handed
/// over to callbacks. What callbacks throw is the caller's, were it the same exception.
template <class InEngine, class InLibode>
void call_guarded(const InEngine& in_engine, const InLibode& in_libode) {
  const unsigned before = walks_begun;
  try {
    in_engine();
    return;
  } catch (const std::bad_alloc&) {
    if (walks_begun != before) throw;
  }
  write_log_line(LogLevel::warning, "out of memory; the call is left to libode");
  in_libode();
}

}  // namespace

template <class Real>
void GuardedService<Real>::engine_is(std::unique_ptr<Engine> engine, bool reports) {
  engine_ = std::move(engine);
  reports_ = reports;
  listener_.store(engine_.get(), std::memory_order_release);
  answers_.store(engine_.get(), std::memory_order_release);
}

template <class Real>
void GuardedService<Real>::space_collide(dxSpace* space, void* data, NearCallback* callback) {
  Engine* const engine = answers_.load(std::memory_order_acquire);
  if (engine == nullptr) return ode_.space_collide(space, data, callback);
  call_guarded([&] { engine->space_collide(space, data, callback); },
               [&] { ode_.space_collide(space, data, callback); });
}

template <class Real>
void GuardedService<Real>::space_collide2(dxGeom* o1, dxGeom* o2, void* data,
                                          NearCallback* callback) {
  Engine* const engine = answers_.load(std::memory_order_acquire);
  if (engine == nullptr) return ode_.space_collide2(o1, o2, data, callback);
  call_guarded([&] { engine->space_collide2(o1, o2, data, callback); },
               [&] { ode_.space_collide2(o1, o2, data, callback); });
}

template <class Real>
template <class Event>
void GuardedService<Real>::tell(const Event& event) noexcept {
  Engine* const engine = listener_.load(std::memory_order_acquire);
  if (engine == nullptr) return;
  try {
    event(*engine);
  } catch (const std::bad_alloc&) {
    engine->lost_track();
  }
}

template <class Real>
void GuardedService<Real>::changing(dxGeom* geom, Change change) noexcept {
  tell([&](Engine& engine) { engine.changing(geom, change); });
}
template <class Real>
void GuardedService<Real>::filters_changed(dxGeom* geom) noexcept {
  tell([&](Engine& engine) { engine.filters_changed(geom); });
}
template <class Real>
void GuardedService<Real>::toggled(dxGeom* geom) noexcept {
  tell([&](Engine& engine) { engine.toggled(geom); });
}
template <class Real>
void GuardedService<Real>::added(dxSpace* space) noexcept {
  tell([&](Engine& engine) { engine.added(space); });
}
template <class Real>
void GuardedService<Real>::removed(dxSpace* space, dxGeom* geom) noexcept {
  tell([&](Engine& engine) { engine.removed(space, geom); });
}
template <class Real>
void GuardedService<Real>::destroying(dxGeom* geom) noexcept {
  tell([&](Engine& engine) { engine.destroying(geom); });
}
template <class Real>
void GuardedService<Real>::levels_changed(dxSpace* space) noexcept {
  tell([&](Engine& engine) { engine.levels_changed(space); });
}
template <class Real>
void GuardedService<Real>::sap_created(dxSpace* space, int axis_order) noexcept {
  tell([&](Engine& engine) { engine.sap_created(space, axis_order); });
}
template <class Real>
void GuardedService<Real>::class_created(int number, AabbTest* test) noexcept {
  tell([&](Engine& engine) { engine.class_created(number, test); });
}
template <class Real>
void GuardedService<Real>::collider_overridden(int class1, int class2) noexcept {
  tell([&](Engine& engine) { engine.collider_overridden(class1, class2); });
}
template <class Real>
void GuardedService<Real>::closed() noexcept {
  tell([&](Engine& engine) { engine.closed(); });
}

template <class Real>
std::uint64_t GuardedService<Real>::calls() const {
  const Engine* const engine = answers_.load(std::memory_order_acquire);
  if (engine == nullptr) return 0;
  const Statistics& s = engine->statistics();
  return s.searched + s.updated + s.unchanged + s.recorded + s.scanned + s.left_to_stock;
}

template <class Real>
void GuardedService<Real>::report() noexcept {
  if (calls_before_fork_ != 0 && calls() == calls_before_fork_) return;
  if (!reports_.exchange(false)) return;
  tell([&](Engine& engine) { write_log_line(LogLevel::info, {name_, engine.report()}); });
}

template class GuardedService<float>;
template class GuardedService<double>;

}  // namespace harpoon::ode
