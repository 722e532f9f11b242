#pragma once

// One replay of pairs on the stack of a thread: which pair the callback is looking at, what has
// happened to the geoms meanwhile, and who walks on from here. dCollide and the setters have no
// argument that leads here, so the innermost frame of each thread is thread-local.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ode/space_record.hpp"
#include "ode/stock_walk.hpp"
#include "ode/verify.hpp"

namespace harpoon::ode {

/// How often this thread began to call callbacks, ours or libode's own way: from then on a call
/// cannot be begun anew.
inline constinit thread_local unsigned walks_begun = 0;

/// Frames on this thread's stack: without any dCollide is libode's at once.
inline constinit thread_local int open_frames = 0;

/// Which geoms of a pair libode checks for being enabled when the pair's turn comes.
enum class LiveCheck : std::uint8_t {
  none,    ///< all flags were read at the start: hash and SAP
  rows,    ///< o1 at the start of its row, o2 for each pair: simple and quadtree
  first,   ///< dSpaceCollide2: o1 is the geom of the space that is scanned
  second,  ///< o2 is
};

/// Where the pairs that follow come from.
enum class Course : std::uint8_t {
  own,           ///< from the sequence that was found before the first callback
  handing_over,  ///< the next one is being entered
  stock,         ///< from libode's own traversal, `walk`
  filtered,      ///< from `rest`, by the filters of the moment
  kept,          ///< as `own`: libode could not take over
};

template <class Real>
struct Frame {
  /// `stock` is libode's traversal for this call; `stack` is there for it from the start, so that
  /// nothing is needed later that could fail.
  Frame(dxSpace* the_space, LiveCheck live_check, const Traversal<Real>& the_stock,
        WalkStack the_stack)
      : space(the_space),
        live(live_check),
        stock(the_stock),
        stack(std::move(the_stack)),
        outer(current()) {
    current() = this;
    ++open_frames;
    ++walks_begun;
  }
  ~Frame() {
    current() = outer;
    --open_frames;
  }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

  /// The innermost frame of this thread, or null.
  static Frame*& current() {
    static thread_local Frame* innermost = nullptr;
    return innermost;
  }

  dxSpace* const space;  ///< whose geoms are walked over
  const LiveCheck live;
  const Traversal<Real> stock;
  WalkStack stack;
  Frame* const outer;

  /// dSpaceCollide2: the geom that the space's geoms are compared with; null when it is gone.
  dxGeom* probe = nullptr;
  /// dSpaceCollide2 of two spaces: the one whose geoms are probes in turn.
  dxSpace* looped = nullptr;
  /// dSpaceCollide2: the pairs of the probe.
  std::span<GeomPair> scanned = {};
  Verifier<Real>* verifier = nullptr;  ///< sees every pair before the callback does
  /// What is remembered of the space.
  SpaceRecord<Real>* origin = nullptr;
  /// libode has all bounds and flags of this space from the start, and reads filters only: SAP.
  bool reads_filters_only = false;

  // The pair that the callback is looking at, or the last whose turn it was; null when a geom of it
  // is gone. Without a record dCollide is libode's.
  dxGeom *o1 = nullptr, *o2 = nullptr;
  SpaceRecord<Real>* record = nullptr;
  std::size_t number = 0;
  bool has_begun = false;     ///< there was such a pair
  std::uint64_t version = 0;  ///< of the record when its pairs were found to hold
  bool default_rules = true;  ///< the thread's floating-point mode is that of the batch
  std::uint64_t batch_contacts = 0, stock_contacts = 0;

  // What happened during callbacks.
  bool disturbed = false;      ///< any of the following: look closer at each pair
  bool stopped = false;        ///< the space is gone
  bool toggled = false;        ///< a geom was enabled or disabled
  dxGeom* row = nullptr;       ///< o1 of the last pair that was looked at closer
  bool row_is_enabled = true;  ///< it was when its row began
  Course course = Course::own;
  StockWalk<Real>* walk = nullptr;
  std::optional<StockWalk<Real>> own_walk;  ///< where `walk` is no verifier's
  std::vector<IndexPair> rest;              ///< of the record's mirror

  /// A geom is gone: pairs that it is in are left out.
  void forget(const dxGeom* geom) {
    const auto is_gone = [&](const dxGeom* other) { return other == geom; };
    if (record != nullptr) {
      record->mirror.forget(geom);
      record->mark_changed_with_contacts();
    }
    for (GeomPair& pair : scanned) {
      if (is_gone(pair.o1) || is_gone(pair.o2)) pair = {};
    }
    if (is_gone(o1) || is_gone(o2)) o1 = o2 = nullptr;
    disturbed = true;
  }
};

}  // namespace harpoon::ode
