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

template <class Real>
struct ColliderOf<Real>::State {
  std::unique_ptr<Engine> engine;
  std::vector<ContactGeomOf<Real>> contacts;
};

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

}  // namespace

template <class Real>
ColliderOf<Real>::ColliderOf(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
template <class Real>
ColliderOf<Real>::ColliderOf(ColliderOf&& other) noexcept = default;
template <class Real>
ColliderOf<Real>& ColliderOf<Real>::operator=(ColliderOf&& other) noexcept = default;
template <class Real>
ColliderOf<Real>::~ColliderOf() = default;

template <class Real>
Result<ColliderOf<Real>> ColliderOf<Real>::make(const LibodeOf<Real>& ode,
                                                const ColliderOptions& options) noexcept {
  try {
    if (!is_complete(ode)) {
      return Error{Errc::invalid_argument,
                   "a function of ODE is missing; set every member of the table"};
    }
    Result<std::unique_ptr<Device>> cpu = make_cpu_device({.threads = 1});
    if (!cpu) return cpu.error();
    Options engine_options;
    engine_options.policy = options.with_missed_pairs ? Policy::fixed : Policy::compat;
    engine_options.changes_are_reported = false;
    auto engine = make_engine<Real>(
        ode,
        {.options = engine_options, .device = std::move(*cpu), .log = options.log, .differs = {}});
    if (!engine) return engine.error();
    auto state = std::make_unique<State>();
    state->engine = std::move(*engine);
    return ColliderOf(std::move(state));
  } catch (const std::bad_alloc&) {
    return Error{Errc::out_of_memory, "out of memory"};
  }
}

template <class Real>
void ColliderOf<Real>::space_collide(dxSpace* space, void* data, NearCallback* callback) {
  state_->engine->space_collide(space, data, callback);
}

template <class Real>
void ColliderOf<Real>::space_collide2(dxGeom* o1, dxGeom* o2, void* data, NearCallback* callback) {
  state_->engine->space_collide2(o1, o2, data, callback);
}

template <class Real>
int ColliderOf<Real>::collide(dxGeom* o1, dxGeom* o2, int flags, ContactGeomOf<Real>* contacts,
                              int skip) {
  return state_->engine->collide(o1, o2, flags, contacts, skip);
}

template <class Real>
Result<std::span<const ContactGeomOf<Real>>> ColliderOf<Real>::contacts(dxSpace* space,
                                                                        int max_contacts) noexcept {
  if (space == nullptr || max_contacts < 1 || max_contacts > kContactCountMask) {
    return Error{Errc::invalid_argument, "give a space and 1 to 65535 contacts for each pair"};
  }
  state_->contacts.clear();
  Gatherer<Real> gatherer{*state_->engine, state_->contacts, max_contacts};
  state_->engine->space_collide(space, &gatherer, &Gatherer<Real>::near);
  if (gatherer.out_of_memory) return Error{Errc::out_of_memory, "out of memory"};
  return std::span<const ContactGeomOf<Real>>(state_->contacts);
}

template <class Real>
void ColliderOf<Real>::sap_created(dxSpace* space, int axis_order) {
  state_->engine->sap_created(space, axis_order);
}

template <class Real>
void ColliderOf<Real>::destroying(dxSpace* space) {
  state_->engine->destroying(as_geom(space));
}

template class HARPOON_API ColliderOf<float>;
template class HARPOON_API ColliderOf<double>;

}  // namespace harpoon::ode
