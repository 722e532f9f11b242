// The public face of an engine for callers who hand it their own libode.

#include <algorithm>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include "harpoon/ode.hpp"
#include "ode/engine.hpp"
#include "ode/libode.hpp"

namespace harpoon::ode {

namespace {

/// Gathers all contacts of a space.
template <class Real>
struct Gatherer {
  Engine& engine;
  std::vector<ContactGeomOf<Real>>& contacts;
  int max_contacts;
  bool out_of_memory = false;

  static void near(void* gatherer, dxGeom* o1, dxGeom* o2) {
    auto& self = *static_cast<Gatherer*>(gatherer);
    if (self.out_of_memory) return;
    const std::size_t before = self.contacts.size();
    try {
      // ODE writes no more than it finds, but may write any of what it was promised.
      self.contacts.resize(before + static_cast<std::size_t>(self.max_contacts));
    } catch (const std::bad_alloc&) {
      self.out_of_memory = true;
      return;
    }
    const int count = self.engine.collide(o1, o2, self.max_contacts, &self.contacts[before],
                                          sizeof(ContactGeomOf<Real>));
    self.contacts.resize(before + static_cast<std::size_t>(std::max(count, 0)));
  }
};

/// The table is pointers and nothing else.
template <class Real>
bool is_complete(const LibodeOf<Real>& ode) {
  const auto* const entries = reinterpret_cast<void* const*>(&ode);
  return std::none_of(entries, entries + sizeof ode / sizeof(void*),
                      [](const void* entry) { return entry == nullptr; });
}

template <class Real>
class Collider final : public detail::ColliderWork<Real> {
 public:
  explicit Collider(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}

  void space_collide(dxSpace* space, void* data, NearCallback* callback) override {
    engine_->space_collide(space, data, callback);
  }
  void space_collide2(dxGeom* o1, dxGeom* o2, void* data, NearCallback* callback) override {
    engine_->space_collide2(o1, o2, data, callback);
  }
  int collide(dxGeom* o1, dxGeom* o2, int flags, ContactGeomOf<Real>* contacts, int skip) override {
    return engine_->collide(o1, o2, flags, contacts, skip);
  }
  Result<std::span<const ContactGeomOf<Real>>> contacts(dxSpace* space,
                                                        int max_contacts) noexcept override {
    if (space == nullptr || max_contacts < 1 || max_contacts > kContactCountMask) {
      return Error{Errc::invalid_argument, "give a space and 1 to 65535 contacts for each pair"};
    }
    contacts_.clear();
    Gatherer<Real> gatherer{*engine_, contacts_, max_contacts};
    engine_->space_collide(space, &gatherer, &Gatherer<Real>::near);
    if (gatherer.out_of_memory) return Error{Errc::out_of_memory, "out of memory"};
    return std::span<const ContactGeomOf<Real>>(contacts_);
  }
  void sap_created(dxSpace* space, int axis_order) override {
    engine_->sap_created(space, axis_order);
  }
  void destroying(dxSpace* space) override { engine_->destroying(as_geom(space)); }

 private:
  std::unique_ptr<Engine> engine_;
  std::vector<ContactGeomOf<Real>> contacts_;
};

template <class Real>
Result<std::unique_ptr<detail::ColliderWork<Real>>> make(const LibodeOf<Real>& ode,
                                                         const ColliderOptions& options) {
  if (!is_complete(ode)) {
    return Error{Errc::invalid_argument,
                 "a function of ODE is missing; set every member of the table"};
  }
  Result<std::unique_ptr<Device>> cpu = make_cpu_device({.threads = 1});
  if (!cpu) return cpu.error();
  Options engine_options;
  engine_options.policy = options.with_missed_pairs ? Policy::fixed : Policy::compat;
  engine_options.changes_are_reported = engine_options.callbacks_may_change = false;
  auto engine = make_engine<Real>(
      ode,
      {.options = engine_options, .device = std::move(*cpu), .log = options.log, .differs = {}});
  if (!engine) return engine.error();
  return std::unique_ptr<detail::ColliderWork<Real>>(
      std::make_unique<Collider<Real>>(std::move(*engine)));
}

template <class Real>
void make_into(const void* ode, const ColliderOptions& options, void* collider) {
  auto& made = *static_cast<Result<std::unique_ptr<detail::ColliderWork<Real>>>*>(collider);
  try {
    made = make(*static_cast<const LibodeOf<Real>*>(ode), options);
  } catch (const std::bad_alloc&) {
    made = Error{Errc::out_of_memory, "out of memory"};
  }
}

}  // namespace
}  // namespace harpoon::ode

extern "C" bool harpoon_ode_make_collider(int real_bytes, const void* ode,
                                          const harpoon::ode::ColliderOptions* options,
                                          void* collider) {
  if (real_bytes == sizeof(float)) {
    harpoon::ode::make_into<float>(ode, *options, collider);
  } else {
    harpoon::ode::make_into<double>(ode, *options, collider);
  }
  return true;
}
