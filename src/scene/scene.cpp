// The persistent door. Between searches it keeps a list of nearby pairs (Verlet 1967): pairs whose
// surfaces were closer than a margin. While no body has moved half the margin since, every contact
// is in the list, and the list is in order of ids, so a frame costs one pass over it.

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <new>

#include <fmt/format.h>

#include "base/float_environment.hpp"
#include "base/out_of_memory.hpp"
#include "scene/check.hpp"
#include "scene/ordered_writer.hpp"
#include "scene/workspace.hpp"

namespace harpoon {
namespace {

/// Frames that a list should last at the speed seen.
constexpr double kFramesPerSearch = 8;
/// A margin beyond this part of a usual large radius makes the list longer than it is worth.
constexpr double kLargestMargin = 0.5;
/// So does one that lists more pairs than these, as where all but a few bodies are small.
constexpr std::uint64_t kListPerBody = 8, kListPerContact = 4;
/// How the largest margin grows in each frame without one, after a list that was too long.
constexpr double kRetryGrowth = 1.0625;
/// Part of half the margin that a body may use: the rest covers rounding.
constexpr double kUsableMargin = 1 - 0x1p-8;
/// Fewest bodies of a piece of work.
constexpr std::size_t kPieceBodies = 8192;
/// Bytes compared at a time: after each block of them the threads look whether one found a
/// difference.
constexpr std::size_t kCompareBlock = std::size_t{64} << 10;

Error no_such_body() {
  return {Errc::invalid_index, "no such body"};
}
Error too_many_contacts(std::uint64_t contacts, std::uint64_t limit) {
  return {
      Errc::capacity,
      fmt::format("{} contacts and a limit of {}; limit_contacts() sets another", contacts, limit),
      contacts};
}

}  // namespace

template <class Real>
struct SceneOf<Real>::State {
  explicit State(Workspace made) noexcept : workspace(std::move(made)) {}

  using Spheres = std::vector<SphereOf<Real>, LargeAllocator<SphereOf<Real>>>;

  Workspace workspace;
  Spheres spheres;   ///< by id; a free id has radius -1
  Spheres searched;  ///< the spheres when `nearby` was made
  std::vector<std::uint32_t> category, collide, owner;
  std::vector<Rest> rest;
  std::vector<bool> taken;
  std::vector<std::uint32_t> free_ids;  ///< a heap, lowest first
  std::vector<std::uint32_t> excluded;
  broad::IdOrderMemory nearby_memory;
  Buffer contacts;
  broad::Candidates nearby;
  std::uint64_t contact_count = 0;
  std::uint64_t tests = 0;  ///< of the last frame
  std::optional<std::uint64_t> contact_limit;
  double margin = 0;
  /// Whose list was not too long.
  double largest_margin = std::numeric_limits<double>::infinity();
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
    largest_margin = std::numeric_limits<double>::infinity();
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

  [[nodiscard]] std::uint64_t most_contacts() const noexcept {
    return contact_limit.value_or(default_contact_limit(spheres.size()));
  }

  [[nodiscard]] broad::Means means() const noexcept {
    return workspace.state().means(spheres.size());
  }
  [[nodiscard]] Filters filters() const noexcept { return {category, collide, owner, rest}; }
  [[nodiscard]] broad::Source<Real> source() const noexcept {
    if (spheres.empty()) return {};
    const SphereOf<Real>* s = spheres.data();
    return {&s->x, &s->y, &s->z, &s->r, sizeof *s, spheres.size()};
  }
};

namespace {

template <class Real>
using StateOf = typename SceneOf<Real>::State;

template <class Real>
broad::Source<Real> source_of(const BodiesOf<Real>& b) {
  return {b.x, b.y, b.z, b.r, b.stride_bytes, b.count};
}

/// Bits, not values: a NaN that stays is no change, a zero of another sign is one.
template <class Real>
bool same_bits(const void* a, const SphereOf<Real>* b, std::size_t spheres) {
  return std::memcmp(a, static_cast<const void*>(b), spheres * sizeof *b) == 0;
}

template <class Real>
bool same_bits(const broad::Source<Real>& source, const SphereOf<Real>* spheres, std::size_t begin,
               std::size_t end) {
  if (source.records()) return same_bits(source.x + 4 * begin, spheres + begin, end - begin);
  for (std::size_t i = begin; i < end; ++i) {
    const SphereOf<Real> b = source[i];
    if (!same_bits(&b, &spheres[i], 1)) return false;
  }
  return true;
}

/// True when the source holds exactly the scene's spheres, bit by bit.
template <class Real>
Result<bool> same_spheres(const StateOf<Real>& state, const broad::Source<Real>& source) {
  constexpr std::size_t kBlock = kCompareBlock / sizeof(SphereOf<Real>);
  std::atomic<bool> same{true};
  const auto compare = [&](std::size_t, std::size_t begin, std::size_t end) {
    for (; begin < end && same.load(std::memory_order_relaxed); begin += kBlock) {
      if (!same_bits(source, state.spheres.data(), begin, std::min(end, begin + kBlock))) {
        same = false;
      }
    }
  };
  if (auto error = state.means().run_pieces(source.count, kPieceBodies, compare)) {
    return *std::move(error);
  }
  return same.load();
}

/// Copies the source's bodies to `spheres`.
template <class Real>
std::optional<Error> copy_spheres(const broad::Means& means, const broad::Source<Real>& source,
                                  typename StateOf<Real>::Spheres& spheres) {
  spheres.resize(source.count);
  SphereOf<Real>* const to = spheres.data();
  const auto copy = [&](std::size_t, std::size_t begin, std::size_t end) {
    if (source.records()) {
      std::memcpy(static_cast<void*>(to + begin), source.x + 4 * begin, (end - begin) * sizeof *to);
    } else {
      for (std::size_t i = begin; i < end; ++i) to[i] = source[i];
    }
  };
  return source.count == 0 ? std::nullopt : means.run_pieces(source.count, kPieceBodies, copy);
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

/// One search: makes `nearby` from the bodies as they are; without a margin, of contacts alone,
/// where with the one asked for there were too many.
template <class Real>
class Searcher {
 public:
  explicit Searcher(StateOf<Real>& state)
      : state_(state), work_(state.workspace.state()), means_(state.means()) {}

  std::optional<Error> run() {
    state_.tests = 0;
    if (state_.margin > 0) {
      const std::uint64_t limit =
          kListPerBody * state_.spheres.size() + kListPerContact * state_.contact_count;
      if (auto error = run({broad::SearchRule::Kind::near_spheres}, limit)) return error;
      if (work_.search.dropped() == 0) {
        // A list grows at most with the cube of its reach.
        if (8 * state_.nearby.count < limit) state_.largest_margin *= 2;
        return std::nullopt;
      }
      state_.largest_margin = state_.margin / 2;
      state_.margin = 0;
    } else {
      state_.largest_margin *= kRetryGrowth;  // without a list it is tried again at times
    }
    const std::uint64_t limit = state_.most_contacts();
    if (auto error = run({broad::SearchRule::Kind::touching_spheres}, limit)) return error;
    const std::uint64_t dropped = work_.search.dropped();
    if (dropped != 0) return too_many_contacts(dropped, limit);
    return std::nullopt;
  }

 private:
  std::optional<Error> run(const broad::SearchRule& rule, std::uint64_t limit) {
    rule_ = rule;
    work_.search.used = 0;
    state_.excluded.clear();
    state_.nearby.count = 0;
    if (state_.spheres.empty()) return std::nullopt;
    const broad::Source<Real> source = state_.source();
    broad::Survey<Real> survey;
    if (auto error = broad::survey(means_, source, state_.margin, state_.excluded, survey)) {
      return error;
    }
    std::erase_if(state_.excluded, [&](std::uint32_t id) { return !state_.taken[id]; });
    if (survey.census.bodies + survey.giants.size() == 0) return std::nullopt;
    const broad::Plan plan = broad::make_plan(survey.census);
    if (plan.in_trees) return search_trees(source, limit);
    if (auto error = plan.cull_double ? search_grids<double>(source, survey, plan, limit)
                                      : search_grids<float>(source, survey, plan, limit)) {
      return error;
    }
    return work_.search.gave_up ? search_trees(source, limit) : std::nullopt;
  }

  template <class Cull>
  std::optional<Error> search_grids(const broad::Source<Real>& source,
                                    const broad::Survey<Real>& survey, const broad::Plan& plan,
                                    std::uint64_t limit) {
    broad::Ordered<Real, Cull> bodies;
    bodies.scanned = survey.giants.size();
    if (auto error = broad::order(means_, source, survey, plan, work_.order, bodies)) return error;
    broad::place_giants(means_, source, survey, plan, work_.order, bodies);
    return search(source, bodies, limit);
  }

  std::optional<Error> search_trees(const broad::Source<Real>& source, std::uint64_t limit) {
    broad::Ordered<Real, Real> bodies;
    if (auto error = broad::order_in_trees(means_, source, state_.margin, work_.order, work_.trees,
                                           bodies)) {
      return error;
    }
    return search(source, bodies, limit);
  }

  template <class Cull>
  std::optional<Error> search(const broad::Source<Real>& source,
                              const broad::Ordered<Real, Cull>& bodies, std::uint64_t limit) {
    const broad::PairFilter filter(state_.filters());
    if (auto error = broad::search(means_, bodies, rule_, filter, limit, work_.search)) {
      return error;
    }
    state_.tests += work_.search.tests();
    if (work_.search.gave_up) return std::nullopt;
    const std::span<const broad::TaskList> lists(work_.search.lists.data(), work_.search.used);
    return broad::ids_in_order(means_, bodies.ids, source.count, lists, state_.nearby_memory,
                               state_.nearby);
  }

  StateOf<Real>& state_;
  Workspace::State& work_;
  broad::Means means_;
  broad::SearchRule rule_;
};

/// Contacts of the nearby pairs, in their order.
template <class Real>
std::optional<Error> collide_nearby(StateOf<Real>& state) {
  const std::size_t pairs = state.nearby.count;
  if (!state.contacts.reserve((pairs + 1) * sizeof(BodyContactOf<Real>))) return out_of_memory();
  auto* const out = state.contacts.template as<BodyContactOf<Real>>();
  const broad::Means means = state.means();
  const auto make = [&](std::size_t begin, std::size_t end, BodyContactOf<Real>* to) {
    return means.kernels->of<Real>().contacts(state.spheres.data(), nullptr, state.nearby, begin,
                                              end, to);
  };
  if (means.threads() == 1 || pairs <= scene::kChunkRecords) {
    state.contact_count = make(0, pairs, out);
    return std::nullopt;
  }
  const auto chunks =
      static_cast<std::uint32_t>((pairs + scene::kChunkRecords - 1) / scene::kChunkRecords);
  const auto make_chunk = [&](std::size_t chunk, BodyContactOf<Real>* to) {
    const std::size_t begin = chunk * scene::kChunkRecords;
    return make(begin, std::min(pairs, begin + scene::kChunkRecords), to);
  };
  return scene::write_in_order(means, chunks, state.workspace.state().scratch, out, make_chunk,
                               state.contact_count);
}

/// The largest distance that a body has moved since the last search; infinite where that is not
/// known.
template <class Real>
Result<double> largest_move(const StateOf<Real>& state) {
  const broad::Means means = state.means();
  std::array<Real, broad::Means::kMaxPieces> squares = {};
  if (auto error = means.run_pieces(state.spheres.size(), kPieceBodies,
                                    [&](std::size_t piece, std::size_t begin, std::size_t end) {
                                      squares[piece] = means.kernels->of<Real>().largest_move(
                                          state.searched.data() + begin,
                                          state.spheres.data() + begin, end - begin);
                                    })) {
    return *std::move(error);
  }
  return std::sqrt(static_cast<double>(*std::max_element(squares.begin(), squares.end())));
}

/// A margin for bodies that moved so far since the last search, which serves at least one more
/// frame at the speed seen; 0 where there is none whose list is worth its while.
template <class Real>
double choose_margin(const StateOf<Real>& state, double moved) {
  if (state.frames < 2) return 0;
  const double radius = broad::usual_radius(state.source());
  const double speed = moved / (state.frames - 1);
  const double largest = std::min(kLargestMargin * radius, state.largest_margin);
  if (!(2 * speed <= largest * kUsableMargin)) return 0;
  return std::min(std::max(2 * kFramesPerSearch * speed, 0x1p-6 * radius), largest);
}

/// Makes `nearby` anew if bodies that moved so far may be in contact without being in it. Returns
/// whether it was made.
template <class Real>
Result<bool> keep_nearby(StateOf<Real>& state) {
  double moved = std::numeric_limits<double>::infinity();
  if (state.frames >= 2) {
    const Result<double> largest = largest_move<Real>(state);
    if (!largest) return largest.error();
    moved = *largest;
  }
  if (!state.stale && state.margin > 0 && moved <= state.margin / 2 * kUsableMargin) return false;
  state.stale = true;  // until all of the following has succeeded
  state.margin = choose_margin<Real>(state, moved);
  state.frames = 0;
  if (auto error = Searcher<Real>(state).run()) return *std::move(error);
  if (auto error = copy_spheres<Real>(state.means(), state.source(), state.searched)) {
    return *std::move(error);
  }
  state.stale = false;
  state.frames = 1;
  return true;
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
    const broad::Source<Real> source = source_of(bodies);
    if (rules_kept) {
      const Result<bool> same = same_spheres<Real>(s, source);
      if (!same) return same.error();
      if (*same) return std::nullopt;
    }
    s.moved = true;
    if (!rules_kept) s.stale = true;
    if (!same_set) s.frames = 0;
    const broad::Means means = s.workspace.state().means(bodies.count);
    if (auto error = copy_spheres<Real>(means, source, s.spheres)) {
      s.clear();
      return error;
    }
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
void SceneOf<Real>::limit_contacts(std::uint64_t most) noexcept {
  state_->contact_limit = most;
  state_->moved = true;
}

template <class Real>
Result<FrameOf<Real>> SceneOf<Real>::detect() noexcept {
  State& s = *state_;
  FrameOf<Real> frame;
  frame.changed = s.moved;
  if (s.moved) {
    try {
      const FloatEnvironment environment;
      s.frames += s.frames != 0 ? 1 : 0;
      const Result<bool> searched = keep_nearby<Real>(s);
      if (!searched) return searched.error();
      frame.searched = *searched;
      if (!frame.searched) s.tests = s.nearby.count;
      if (auto error = collide_nearby<Real>(s)) return *std::move(error);
      if (s.contact_count > s.most_contacts()) {
        return too_many_contacts(s.contact_count, s.most_contacts());
      }
      s.moved = false;
    } catch (const std::bad_alloc&) {
      s.stale = true;
      return out_of_memory();
    }
  }
  frame.contacts = {s.contacts.template as<BodyContactOf<Real>>(), s.contact_count};
  frame.excluded = s.excluded;
  frame.tests = frame.changed ? s.tests : 0;
  return frame;
}

template class SceneOf<float>;
template class SceneOf<double>;

}  // namespace harpoon
