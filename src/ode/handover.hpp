#pragma once

// Hands a call over to libode in the middle, when a callback is about to change what libode reads
// while it walks: filters, bodies, flags, the order of its lists, bounds that are computed anew.
// libode's traversal is started beside the callback before the change is made, goes to the pair
// that the callback is looking at, and walks on from there: no pair is lost, none comes twice, and
// everything that changes is seen as libode sees it.
//
// A sweep-and-prune space whose order is Harpoon's cannot be handed over, for libode's own history
// is another one. It reads filters only, so its remaining pairs are found without them and filtered
// one by one.

#include "harpoon/device.hpp"
#include "ode/frame.hpp"
#include "ode/statistics.hpp"

namespace harpoon::ode {

template <class Real>
struct Handover {
  const LibodeOf<Real>& ode;
  const LogCallback& log;
  Statistics& statistics;
  /// libode ends the process when a callback changes the geoms of a space that is walked over. Such
  /// changes are let through and seen from the next call on.
  bool locks_are_checked;

  /// To be called before the change is made; `geom` is the space where members change. Looks at all
  /// frames of the thread.
  void before(dxGeom* geom, Change change) const;
  /// Before a geom of a space is destroyed: for calls that walk over the space's list as probes.
  void before_loss(const dxSpace* home, const dxGeom* geom) const;
  /// Lets libode find all pairs that follow the last one of the call.
  void all_that_follows(Frame<Real>& frame) const { hand_over(frame); }

 private:
  [[nodiscard]] bool concerns(const Frame<Real>& frame, dxGeom* geom, Change change) const;
  [[nodiscard]] bool ends_stock(dxGeom* geom, Change change) const;
  void hand_over(Frame<Real>& frame) const;
  [[nodiscard]] bool start_walk(Frame<Real>& frame) const;
  [[nodiscard]] bool find_rest(Frame<Real>& frame) const;
};

/// Whether this build of libode checks its locks: tried on a space of our own, whose callback
/// changes a geom. Takes libode's debug handler for that moment. Throws std::bad_alloc.
template <class Real>
[[nodiscard]] bool checks_locks(const LibodeOf<Real>& ode);

}  // namespace harpoon::ode
