#include "ode/replay.hpp"

#include <algorithm>

namespace harpoon::ode {
namespace {

/// How many pairs ahead memory is asked for.
constexpr std::size_t kPrefetchDistance = 6;

}  // namespace

void note_pair(void* data, dxGeom* o1, dxGeom* o2) {
  static_cast<std::vector<GeomPair>*>(data)->push_back({o1, o2});
}

/// Whether libode would still report the pair after what callbacks did. Only asked when they did
/// something. `frame.o1` is that of the pair before: where it changes a row begins.
template <class Real>
bool Replayer<Real>::is_due(Frame<Real>& frame, GeomPair pair, LiveCheck live) const {
  if (frame.is_gone(pair.o1) || frame.is_gone(pair.o2)) return false;
  if (!frame.toggled) return true;
  switch (live) {
    case LiveCheck::none:
      return true;
    case LiveCheck::first:
      return ode.geom_is_enabled(pair.o1) != 0;
    case LiveCheck::second:
      return ode.geom_is_enabled(pair.o2) != 0;
    case LiveCheck::rows:
      if (pair.o1 != frame.o1) frame.row_is_enabled = ode.geom_is_enabled(pair.o1) != 0;
      return frame.row_is_enabled && ode.geom_is_enabled(pair.o2) != 0;
  }
  return true;
}

/// libode's two questions to user classes.
template <class Real>
bool Replayer<Real>::is_near(const SpaceRecord<Real>& record, IndexPair pair) const {
  const Mirror<Real>& mirror = record.mirror;
  const auto says_no = [&](std::uint32_t geom, std::uint32_t other) {
    if ((mirror.traits[geom] & kHasAabbTest) == 0) return false;
    const int number = ode.geom_get_class(mirror.geoms[geom]) - geom_class::kFirstUser;
    BoundsBox<Real> bounds = mirror.bounds[other];
    return tests[number](mirror.geoms[geom], mirror.geoms[other], bounds.v) == 0;
  };
  return !says_no(pair.g1, pair.g2) && !says_no(pair.g2, pair.g1);
}

/// A geom was enabled that libode's walk may yet come to. Walks once more, with the pair of this
/// moment enabled so that it is found, and goes on behind it. False when it is not found.
template <class Real>
bool Replayer<Real>::resume(Frame<Real>& frame, LiveCheck live, const Rerun& rerun) const {
  frame.awakened = false;
  const GeomPair last{frame.o1, frame.o2};
  if (frame.is_gone(last.o1) || frame.is_gone(last.o2)) return false;
  std::vector<GeomPair> pairs;
  bool was_enabled[2];
  dxGeom* const geoms[2] = {last.o1, last.o2};
  for (int side = 0; side < 2; ++side) {
    was_enabled[side] = ode.geom_is_enabled(geoms[side]) != 0;
    ode.geom_enable(geoms[side]);
  }
  rerun(&pairs, &note_pair);
  for (int side = 0; side < 2; ++side) {
    if (!was_enabled[side]) ode.geom_disable(geoms[side]);
  }
  const auto found = std::find(pairs.begin(), pairs.end(), last);
  if (found == pairs.end()) return false;
  frame.record = nullptr;
  replay(frame, std::span(found + 1, pairs.end()), live, rerun);
  return true;
}

template <class Real>
void Replayer<Real>::replay(Frame<Real>& frame, SpaceRecord<Real>& record, LiveCheck live,
                            const Rerun& rerun) const {
  frame.record = &record;
  frame.version = record.version.load(std::memory_order_relaxed);
  const bool asks = (record.mirror.all_traits & kHasAabbTest) != 0;
  dxGeom* const* const geoms = record.mirror.geoms.data();
  const IndexPair* const pairs = record.pairs.data();
  const std::size_t count = record.pairs.size();
  // Where contacts come from libode its next geoms can be on their way meanwhile.
  const bool fetches = !record.mirror.only_spheres;
  for (std::size_t k = 0; k < count; ++k) {
    if (fetches && k + kPrefetchDistance < count) {
      record.mirror.prefetch(pairs[k + kPrefetchDistance].g2);
    }
    const GeomPair pair{geoms[pairs[k].g1], geoms[pairs[k].g2]};
    bool due = true;
    if (frame.disturbed) [[unlikely]] {
      if (frame.stopped) return;
      if (frame.awakened && live != LiveCheck::none && resume(frame, live, rerun)) return;
      due = is_due(frame, pair, live);
    }
    due = due && (!asks || is_near(record, pairs[k]));
    frame.o1 = pair.o1;
    frame.o2 = pair.o2;
    frame.number = k;
    if (due) callback(data, pair.o1, pair.o2);
  }
  // The last callback, too, may have let libode's walk find more.
  if (frame.awakened && !frame.stopped && live != LiveCheck::none) {
    (void)resume(frame, live, rerun);
  }
}

template <class Real>
void Replayer<Real>::replay(Frame<Real>& frame, std::span<const GeomPair> pairs, LiveCheck live,
                            const Rerun& rerun) const {
  for (const GeomPair& pair : pairs) {
    bool due = true;
    if (frame.disturbed) [[unlikely]] {
      if (frame.stopped) return;
      if (frame.awakened && live != LiveCheck::none && resume(frame, live, rerun)) return;
      due = is_due(frame, pair, live);
    }
    frame.o1 = pair.o1;
    frame.o2 = pair.o2;
    if (due) callback(data, pair.o1, pair.o2);
  }
  if (frame.awakened && !frame.stopped && live != LiveCheck::none) {
    (void)resume(frame, live, rerun);
  }
}

template struct Replayer<float>;
template struct Replayer<double>;

}  // namespace harpoon::ode
