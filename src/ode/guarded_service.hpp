#pragma once

// An engine behind the C boundary: what runs out of memory in it ends here. Before the first
// callback libode takes over the call; an event that cannot be noted makes all that is known stale.

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "ode/engine.hpp"
#include "ode/libode.hpp"
#include "ode/service.hpp"

namespace harpoon::ode {

class ReportingService : public Service {
 public:
  /// This process is a copy of the one that the service was made in: it reports what it does
  /// itself.
  virtual void forked() = 0;
};

template <class Real>
class GuardedService final : public ReportingService {
 public:
  /// Without an engine every call is libode's. The line of statistics begins with `name`.
  GuardedService(const LibodeOf<Real>& ode, std::string name) : ode_(ode), name_(std::move(name)) {}

  /// From now on this one hears of events and answers nothing. Null: nobody.
  void listener_is(Engine* engine) { listener_.store(engine, std::memory_order_release); }
  /// From now on the engine answers. With `reports`, its line is written at the end.
  void engine_is(std::unique_ptr<Engine> engine, bool reports);
  void forked() override { calls_before_fork_ = calls(); }

  void space_collide(dxSpace* space, void* data, NearCallback* callback) override;
  void space_collide2(dxGeom* o1, dxGeom* o2, void* data, NearCallback* callback) override;
  void changing(dxGeom* geom, Change change) noexcept override;
  void filters_changed(dxGeom* geom) noexcept override;
  void toggled(dxGeom* geom) noexcept override;
  void added(dxSpace* space) noexcept override;
  void removed(dxSpace* space, dxGeom* geom) noexcept override;
  void destroying(dxGeom* geom) noexcept override;
  void levels_changed(dxSpace* space) noexcept override;
  void sap_created(dxSpace* space, int axis_order) noexcept override;
  void class_created(int number, AabbTest* test) noexcept override;
  void collider_overridden(int class1, int class2) noexcept override;
  void closed() noexcept override;
  void report() noexcept override;

 private:
  [[nodiscard]] std::uint64_t calls() const;
  /// Tells the listener; where that fails it has lost track.
  template <class Event>
  void tell(const Event& event) noexcept;

  const LibodeOf<Real> ode_;
  std::unique_ptr<Engine> engine_;
  std::atomic<Engine*> answers_{nullptr};
  std::atomic<Engine*> listener_{nullptr};
  std::atomic<bool> reports_{false};
  const std::string name_;
  std::uint64_t calls_before_fork_ = 0;
};

}  // namespace harpoon::ode
