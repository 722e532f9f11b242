#include "ode/replay.hpp"

#include <algorithm>

namespace harpoon::ode {
namespace {

/// How many pairs ahead memory is asked for.
constexpr std::size_t kPrefetchDistance = 6;

}  // namespace

template <class Real>
void Replayer<Real>::deliver(Frame<Real>& frame, GeomPair pair) const {
  if (frame.verifier != nullptr) [[unlikely]]
    frame.verifier->expect(pair);
  frame.o1 = pair.o1;
  frame.o2 = pair.o2;
  frame.has_begun = true;
  callback(data, pair.o1, pair.o2);
}

/// Whether libode would still report the pair after what callbacks did. Only asked when they did
/// something.
template <class Real>
bool Replayer<Real>::is_due(Frame<Real>& frame, GeomPair pair) const {
  if (pair.o1 == nullptr || pair.o2 == nullptr) return false;
  if (!frame.toggled) return true;
  switch (frame.live) {
    case LiveCheck::none:
      return true;
    case LiveCheck::first:
      return takes_part(pair.o1);
    case LiveCheck::second:
      return takes_part(pair.o2);
    case LiveCheck::rows:
      // A row that had begun when the first geom was toggled goes on.
      if (pair.o1 != (frame.row != nullptr ? frame.row : frame.o1)) {
        frame.row_is_enabled = takes_part(pair.o1);
      }
      frame.row = pair.o1;
      return frame.row_is_enabled && takes_part(pair.o2);
  }
  return true;
}

/// libode's two questions to user classes.
template <class Real>
bool Replayer<Real>::is_near(const SpaceRecord<Real>& record, IndexPair pair) const {
  const Mirror<Real>& mirror = record.mirror;
  const auto says_no = [&](std::uint32_t geom, std::uint32_t other) {
    if ((mirror.traits[geom] & kHasAabbTest) == 0) return false;
    const int number = reader.class_of(mirror.geoms[geom]) - geom_class::kFirstUser;
    BoundsBox<Real> bounds = mirror.bounds[other];
    return reader.tests[number](mirror.geoms[geom], mirror.geoms[other], bounds.v) == 0;
  };
  return !says_no(pair.g1, pair.g2) && !says_no(pair.g2, pair.g1);
}

/// Deals with all further pairs, where they do not come from the sequence of the call's start.
template <class Real>
bool Replayer<Real>::goes_on_otherwise(Frame<Real>& frame) const {
  if (frame.stopped) return true;
  if (frame.course == Course::stock) {
    follow_walk(frame);
    return true;
  }
  if (frame.course == Course::filtered) {
    filter_rest(frame);
    return true;
  }
  return false;
}

template <class Real>
void Replayer<Real>::follow_walk(Frame<Real>& frame) const {
  GeomPair pair;
  while (frame.walk->next(pair)) {
    deliver(frame, pair);
    if (frame.stopped) {
      frame.walk->abandon();
      return;
    }
  }
}

template <class Real>
void Replayer<Real>::filter_rest(Frame<Real>& frame) const {
  const SpaceRecord<Real>& record = *frame.record;
  for (const IndexPair pair : frame.rest) {
    dxGeom* const o1 = record.mirror.geoms[pair.g1];
    dxGeom* const o2 = record.mirror.geoms[pair.g2];
    if (o1 == nullptr || o2 == nullptr) continue;
    if (const dxBody* const body = reader.body_of(o1);
        body != nullptr && body == reader.body_of(o2)) {
      continue;
    }
    if (((reader.category_of(o1) & reader.collide_of(o2)) |
         (reader.category_of(o2) & reader.collide_of(o1))) == 0) {
      continue;
    }
    if ((record.mirror.all_traits & kHasAabbTest) != 0 && !is_near(record, pair)) continue;
    deliver(frame, {o1, o2});
    if (frame.stopped) return;
  }
}

template <class Real>
template <class PairAt, class IsNear>
void Replayer<Real>::replay_all(Frame<Real>& frame, std::size_t count, const PairAt& pair_at,
                                const IsNear& is_near) const {
  for (std::size_t k = 0; k < count; ++k) {
    const GeomPair pair = pair_at(k);
    if (frame.disturbed) [[unlikely]] {
      if (goes_on_otherwise(frame)) return;
      if (!is_due(frame, pair)) continue;
    }
    if (!is_near(k)) continue;
    frame.number = k;
    deliver(frame, pair);
  }
  // The last callback, too, may have let libode's walk find more.
  if (frame.disturbed) (void)goes_on_otherwise(frame);
}

template <class Real>
void Replayer<Real>::replay(Frame<Real>& frame, SpaceRecord<Real>& record) const {
  frame.record = &record;
  frame.version = record.version.load(std::memory_order_relaxed);
  const bool asks = (record.mirror.all_traits & kHasAabbTest) != 0;
  const Mirror<Real>& mirror = record.mirror;
  dxGeom* const* const geoms = mirror.geoms.data();
  const IndexPair* const pairs = record.pairs.data();
  const std::size_t count = record.pairs.size();
  // Where contacts come from libode its next geoms can be on their way meanwhile.
  const bool fetches = !mirror.only_spheres;
  replay_all(
      frame, count,
      [&](std::size_t k) {
        if (fetches && k + kPrefetchDistance < count) {
          mirror.prefetch(pairs[k + kPrefetchDistance].g2);
        }
        return GeomPair{geoms[pairs[k].g1], geoms[pairs[k].g2]};
      },
      [&](std::size_t k) { return !asks || is_near(record, pairs[k]); });
}

template <class Real>
void Replayer<Real>::replay(Frame<Real>& frame) const {
  replay_all(
      frame, frame.scanned.size(), [&](std::size_t k) { return frame.scanned[k]; },
      [](std::size_t) { return true; });
}

template struct Replayer<float>;
template struct Replayer<double>;

}  // namespace harpoon::ode
