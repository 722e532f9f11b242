// The persistent door. Between searches it keeps a list of nearby pairs (Verlet 1967): pairs whose
// surfaces were closer than a margin. While no body has moved half the margin since, every contact
// is in the list, and the list is in order of ids, so a frame costs one pass over it.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <new>

#include "base/float_environment.hpp"
#include "scene/check.hpp"
#include "scene/id_order.hpp"
#include "scene/workspace.hpp"

namespace harpoon {
namespace {

/// Frames that a list should last at the speed seen.
constexpr double kFramesPerSearch = 8;
/// A margin beyond this part of the largest radius makes the list longer than it is worth.
constexpr double kLargestMargin = 0.5;
/// Part of half the margin that a body may use: the rest covers rounding.
constexpr double kUsableMargin = 1 - 0x1p-8;
/// Pairs of one task when threads share a frame.
constexpr std::size_t kTaskPairs = 16384;

Error no_such_body() {
  return {Errc::invalid_index, "no such body"};
}
Error out_of_memory() {
  return {Errc::out_of_memory, "out of memory"};
}

}  // namespace

template <class Real>
struct SceneOf<Real>::State {
  explicit State(Workspace made) noexcept : workspace(std::move(made)) {}

  Workspace workspace;
  std::vector<SphereOf<Real>> spheres;   ///< by id; a free id has radius -1
  std::vector<SphereOf<Real>> searched;  ///< the spheres when `nearby` was made
  std::vector<std::uint32_t> category, collide, owner;
  std::vector<Rest> rest;
  std::vector<bool> taken;
  std::vector<std::uint32_t> free_ids;  ///< a heap, lowest first
  std::vector<std::uint32_t> excluded;
  std::vector<std::size_t> task_hits;
  scene::Buffer nearby_memory, contacts;
  scene::Candidates nearby;
  std::size_t contact_count = 0;
  double margin = 0;
  bool moved = true;    ///< since the last frame
  bool stale = true;    ///< `nearby` no longer fits the set of bodies or their rules
  unsigned frames = 0;  ///< seen with the bodies of `searched`; 0 where the set has changed

  void clear() noexcept {
    spheres.clear();
    taken.clear();
    for (auto* bits : {&category, &collide, &owner}) bits->clear();
    rest.clear();
    free_ids.clear();
    moved = stale = true;
    frames = 0;
  }

  [[nodiscard]] bool has(std::uint32_t id) const noexcept { return id < taken.size() && taken[id]; }

  [[nodiscard]] bool ruled() const noexcept { return !category.empty(); }

  void rule_all() {
    const BodyRules none;
    category.resize(spheres.size(), none.category);
    collide.resize(spheres.size(), none.collide);
    owner.resize(spheres.size(), none.owner);
    rest.resize(spheres.size(), none.rest);
  }

  void set_rules(std::uint32_t id, const BodyRules& rules) {
    rule_all();
    category[id] = rules.category;
    collide[id] = rules.collide;
    owner[id] = rules.owner;
    rest[id] = rules.rest;
    stale = moved = true;
  }

  [[nodiscard]] Filters filters() const noexcept { return {category, collide, owner, rest}; }
  [[nodiscard]] scene::Source<Real> source() const noexcept {
    const SphereOf<Real>* s = spheres.data();
    return {&s->x, &s->y, &s->z, &s->r, sizeof *s, spheres.size()};
  }
};

namespace {

template <class Real>
using StateOf = typename SceneOf<Real>::State;

/// Bits, not values: a NaN that stays is no change, a zero of another sign is one.
template <class Real>
bool same_bits(const void* a, const SphereOf<Real>* b, std::size_t spheres) {
  return std::memcmp(a, static_cast<const void*>(b), spheres * sizeof *b) == 0;
}

/// True when the view holds exactly the scene's spheres, bit by bit.
template <class Real>
bool same_spheres(const BodiesOf<Real>& bodies, const std::vector<SphereOf<Real>>& spheres) {
  const scene::Source<Real> source{bodies.x,    bodies.y, bodies.z, bodies.r, bodies.stride_bytes,
                                   bodies.count};
  if (source.records()) {
    return same_bits(bodies.x, spheres.data(), spheres.size());
  }
  for (std::size_t i = 0; i < bodies.count; ++i) {
    const SphereOf<Real> b = source[i];
    if (!same_bits(&b, &spheres[i], 1)) return false;
  }
  return true;
}

template <class Real>
void copy_spheres(const BodiesOf<Real>& bodies, std::vector<SphereOf<Real>>& spheres) {
  const scene::Source<Real> source{bodies.x,    bodies.y, bodies.z, bodies.r, bodies.stride_bytes,
                                   bodies.count};
  spheres.resize(bodies.count);
  if (source.records()) {
    if (bodies.count != 0) {
      std::memcpy(static_cast<void*>(spheres.data()), bodies.x, bodies.count * sizeof spheres[0]);
    }
    return;
  }
  for (std::size_t i = 0; i < bodies.count; ++i) spheres[i] = source[i];
}

template <class T, class Element>
bool same(std::span<const T> view, const std::vector<Element>& kept, T none) {
  if (kept.empty()) {
    return std::all_of(view.begin(), view.end(), [&](const T& v) { return v == none; });
  }
  if (view.empty()) {
    return std::all_of(kept.begin(), kept.end(), [&](const T& v) { return v == none; });
  }
  return std::equal(view.begin(), view.end(), kept.begin(), kept.end());
}

template <class State>
bool same_rules(const Filters& f, const State& state) {
  const BodyRules none;
  return same(f.category, state.category, none.category) &&
         same(f.collide, state.collide, none.collide) && same(f.owner, state.owner, none.owner) &&
         same(f.rest, state.rest, none.rest);
}

template <class State>
void copy_rules(const Filters& f, State& state) {
  for (auto* bits : {&state.category, &state.collide, &state.owner}) bits->clear();
  state.rest.clear();
  if (f.category.empty() && f.owner.empty() && f.rest.empty()) return;
  state.rule_all();
  std::copy(f.category.begin(), f.category.end(), state.category.begin());
  std::copy(f.collide.begin(), f.collide.end(), state.collide.begin());
  std::copy(f.owner.begin(), f.owner.end(), state.owner.begin());
  std::copy(f.rest.begin(), f.rest.end(), state.rest.begin());
}

/// One search: makes `nearby` from the bodies as they are.
template <class Real>
class Searcher {
 public:
  explicit Searcher(StateOf<Real>& state)
      : state_(state), work_(state.workspace.state()), means_(work_.means(state.spheres.size())) {}

  std::optional<Error> run() {
    state_.excluded.clear();
    state_.nearby.count = 0;
    if (state_.spheres.empty()) return std::nullopt;
    const scene::Source<Real> source = state_.source();
    scene::Survey<Real> survey;
    if (auto error = scene::survey(means_, source, state_.margin, state_.excluded, survey)) {
      return error;
    }
    std::erase_if(state_.excluded, [&](std::uint32_t id) { return !state_.taken[id]; });
    if (survey.census.bodies == 0) return std::nullopt;
    const scene::Plan plan = scene::make_plan(survey.census);
    return plan.cull_double ? search<double>(source, survey, plan)
                            : search<float>(source, survey, plan);
  }

 private:
  template <class Cull>
  std::optional<Error> search(const scene::Source<Real>& source, const scene::Survey<Real>& survey,
                              const scene::Plan& plan) {
    scene::Ordered<Real, Cull> bodies;
    if (auto error = scene::order(means_, source, survey, plan, work_.order, bodies)) return error;
    const scene::PairFilter filter(state_.filters());
    const scene::SearchRule rule{scene::SearchRule::Kind::near_spheres};
    if (auto error = scene::search(means_, bodies, rule, filter, 0, work_.search)) return error;
    const std::span<const scene::TaskList> lists(work_.search.lists.data(), work_.search.used);
    scene::IdOrder memory{state_.nearby_memory, work_.by_id_starts};
    if (auto error = scene::order_by_ids(bodies.ids, source.count, lists, memory, state_.nearby)) {
      return error;
    }
    for (std::size_t p = 0; p < state_.nearby.count; ++p) {
      state_.nearby.i[p] = bodies.ids[state_.nearby.i[p]];
      state_.nearby.j[p] = bodies.ids[state_.nearby.j[p]];
    }
    return std::nullopt;
  }

  StateOf<Real>& state_;
  Workspace::State& work_;
  scene::Means means_;
};

/// Contacts of the nearby pairs, in their order.
template <class Real>
std::optional<Error> collide_nearby(StateOf<Real>& state) {
  const std::size_t pairs = state.nearby.count;
  if (!state.contacts.reserve((pairs + 1) * sizeof(BodyContactOf<Real>))) return out_of_memory();
  auto* const out = state.contacts.template as<BodyContactOf<Real>>();
  const scene::Means means = state.workspace.state().means(state.spheres.size());
  const auto kernel = means.kernels->of<Real>().contacts;
  const std::size_t tasks = means.threads() == 1 ? 1 : (pairs + kTaskPairs - 1) / kTaskPairs;
  if (tasks <= 1) {
    state.contact_count = kernel(state.spheres.data(), nullptr, state.nearby, 0, pairs, out);
    return std::nullopt;
  }
  state.task_hits.assign(tasks, 0);
  if (auto error = means.run(tasks, [&](std::size_t t) {
        const std::size_t begin = t * kTaskPairs;
        const std::size_t end = std::min(pairs, begin + kTaskPairs);
        state.task_hits[t] =
            kernel(state.spheres.data(), nullptr, state.nearby, begin, end, out + begin);
      })) {
    return error;
  }
  state.contact_count = 0;
  for (std::size_t t = 0; t < tasks; ++t) {
    std::memmove(static_cast<void*>(out + state.contact_count), out + t * kTaskPairs,
                 state.task_hits[t] * sizeof *out);
    state.contact_count += state.task_hits[t];
  }
  return std::nullopt;
}

/// Whether the list still holds every contact.
template <class Real>
bool list_holds(const StateOf<Real>& state, const scene::Kernels<Real>& kernels) {
  if (state.stale || state.margin <= 0) return false;
  const double allowed = state.margin / 2 * kUsableMargin;
  const double moved = static_cast<double>(
      kernels.largest_move(state.searched.data(), state.spheres.data(), state.spheres.size()));
  return moved <= allowed * allowed;
}

/// A margin for the speed since the last search; 0 where a list is not worth its while.
template <class Real>
double choose_margin(const StateOf<Real>& state, const scene::Kernels<Real>& kernels) {
  if (state.frames < 2) return 0;
  const double moved = std::sqrt(static_cast<double>(kernels.largest_move(
                           state.searched.data(), state.spheres.data(), state.spheres.size()))) /
                       (state.frames - 1);
  double radius = 0;
  for (const SphereOf<Real>& s : state.spheres) radius = std::max(radius, static_cast<double>(s.r));
  const double margin = 2 * kFramesPerSearch * moved;
  return margin <= kLargestMargin * radius ? std::max(margin, 0x1p-6 * radius) : 0;
}

}  // namespace

template <class Real>
Result<SceneOf<Real>> SceneOf<Real>::make(const WorkspaceOptions& options) noexcept {
  Result<Workspace> workspace = Workspace::make(options);
  if (!workspace) return workspace.error();
  try {
    return SceneOf(std::make_unique<State>(std::move(workspace.value())));
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

template <class Real>
SceneOf<Real>::SceneOf(std::unique_ptr<State> state) noexcept : state_(std::move(state)) {}
template <class Real>
SceneOf<Real>::SceneOf(SceneOf&& other) noexcept = default;
template <class Real>
SceneOf<Real>& SceneOf<Real>::operator=(SceneOf&& other) noexcept = default;
template <class Real>
SceneOf<Real>::~SceneOf() = default;

template <class Real>
std::optional<Error> SceneOf<Real>::set_bodies(const BodiesOf<Real>& bodies) noexcept {
  State& s = *state_;
  try {
    if (auto error = scene::check(bodies)) return error;
    const bool same_set = bodies.count == s.spheres.size() && s.free_ids.empty();
    const bool rules_kept = same_set && same_rules(bodies.filters, s);
    if (rules_kept && (bodies.count == 0 || same_spheres(bodies, s.spheres))) return std::nullopt;
    s.moved = true;
    if (!rules_kept) s.stale = true;
    if (!same_set) s.frames = 0;
    copy_spheres(bodies, s.spheres);
    if (!rules_kept) copy_rules(bodies.filters, s);
    s.taken.assign(bodies.count, true);
    s.free_ids.clear();
    return std::nullopt;
  } catch (const std::bad_alloc&) {
    s.clear();
    return out_of_memory();
  }
}

template <class Real>
Result<std::uint32_t> SceneOf<Real>::add(const SphereOf<Real>& sphere,
                                         const BodyRules& rules) noexcept {
  State& s = *state_;
  const BodyRules none;
  const bool ruled = rules.category != none.category || rules.collide != none.collide ||
                     rules.owner != none.owner || rules.rest != none.rest;
  try {
    auto id = static_cast<std::uint32_t>(s.spheres.size());
    if (s.free_ids.empty()) {
      if (id >= kMaxBodies) return Error{Errc::batch_too_large, "scene is full"};
      // Room everywhere first: after it nothing fails half-way.
      const std::size_t room =
          id + 1 > s.spheres.capacity() ? 2 * std::size_t{id} + 16 : s.spheres.capacity();
      s.taken.reserve(room);
      s.free_ids.reserve(room);
      if (ruled || s.ruled()) {
        for (auto* bits : {&s.category, &s.collide, &s.owner}) bits->reserve(room);
        s.rest.reserve(room);
      }
      s.spheres.reserve(room);
      s.spheres.push_back(sphere);
      s.taken.push_back(true);
    } else {
      if (ruled) s.rule_all();
      std::pop_heap(s.free_ids.begin(), s.free_ids.end(), std::greater<>());
      id = s.free_ids.back();
      s.free_ids.pop_back();
      s.spheres[id] = sphere;
      s.taken[id] = true;
    }
    if (ruled || s.ruled()) s.set_rules(id, rules);
    s.stale = s.moved = true;
    s.frames = 0;
    return id;
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

template <class Real>
std::optional<Error> SceneOf<Real>::remove(std::uint32_t id) noexcept {
  State& s = *state_;
  if (!s.has(id)) return no_such_body();
  try {
    s.free_ids.push_back(id);
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
  std::push_heap(s.free_ids.begin(), s.free_ids.end(), std::greater<>());
  s.spheres[id].r = -1;
  s.taken[id] = false;
  s.stale = s.moved = true;
  s.frames = 0;
  return std::nullopt;
}

template <class Real>
std::optional<Error> SceneOf<Real>::move(std::uint32_t id, const SphereOf<Real>& sphere) noexcept {
  State& s = *state_;
  if (!s.has(id)) return no_such_body();
  if (same_bits(&s.spheres[id], &sphere, 1)) return std::nullopt;
  s.spheres[id] = sphere;
  s.moved = true;
  return std::nullopt;
}

template <class Real>
std::optional<Error> SceneOf<Real>::set_rules(std::uint32_t id, const BodyRules& rules) noexcept {
  if (!state_->has(id)) return no_such_body();
  try {
    state_->set_rules(id, rules);
    return std::nullopt;
  } catch (const std::bad_alloc&) {
    state_->stale = state_->moved = true;
    return out_of_memory();
  }
}

template <class Real>
std::size_t SceneOf<Real>::size() const noexcept {
  return state_->spheres.size() - state_->free_ids.size();
}

template <class Real>
Result<FrameOf<Real>> SceneOf<Real>::detect() noexcept {
  State& s = *state_;
  FrameOf<Real> frame;
  frame.changed = s.moved;
  if (s.moved) {
    try {
      const FloatEnvironment environment;
      const scene::Kernels<Real>& kernels = s.workspace.state().kernels->template of<Real>();
      s.frames += s.frames != 0 ? 1 : 0;
      if (!list_holds<Real>(s, kernels)) {
        frame.searched = true;
        s.stale = true;  // until all of the following has succeeded
        s.margin = choose_margin<Real>(s, kernels);
        s.frames = 0;
        if (auto error = Searcher<Real>(s).run()) return *std::move(error);
        s.searched = s.spheres;
        s.stale = false;
        s.frames = 1;
      }
      if (auto error = collide_nearby<Real>(s)) return *std::move(error);
      s.moved = false;
    } catch (const std::bad_alloc&) {
      s.stale = true;
      return out_of_memory();
    }
  }
  frame.contacts = {s.contacts.template as<BodyContactOf<Real>>(), s.contact_count};
  frame.excluded = s.excluded;
  return frame;
}

template class SceneOf<float>;
template class SceneOf<double>;

}  // namespace harpoon
