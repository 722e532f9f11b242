#pragma once

// Calls a near callback pair by pair in a given order and minds what callbacks do to the geoms
// meanwhile: geoms that are gone are left out, and where libode reads the enabled flag while it
// walks, so does the replay. libode's space is not locked during a replay.

#include <functional>
#include <span>
#include <vector>

#include "ode/frame.hpp"
#include "ode/libode.hpp"
#include "ode/space_record.hpp"

namespace harpoon::ode {

/// Which geoms of a pair libode checks for being enabled when the pair's turn comes.
enum class LiveCheck : std::uint8_t {
  none,    ///< all flags were read at the start: hash and SAP
  rows,    ///< o1 at the start of its row, o2 for each pair: simple and quadtree
  first,   ///< dSpaceCollide2: o1 is the geom of the space that is scanned
  second,  ///< o2 is
};

/// Runs libode's own traversal with the given callback.
using Rerun = std::function<void(void* data, NearCallback* callback)>;

template <class Real>
struct Replayer {
  const LibodeOf<Real>& ode;
  const UserTests& tests;
  void* data;
  NearCallback* callback;

  /// The pairs of a record, with contacts from its batch.
  void replay(Frame<Real>& frame, SpaceRecord<Real>& record, LiveCheck live,
              const Rerun& rerun) const;
  /// Pairs of geoms.
  void replay(Frame<Real>& frame, std::span<const GeomPair> pairs, LiveCheck live,
              const Rerun& rerun) const;
  /// Whether user classes among the pair, where there are any, let it through.
  [[nodiscard]] bool is_near(const SpaceRecord<Real>& record, IndexPair pair) const;

 private:
  [[nodiscard]] bool is_due(Frame<Real>& frame, GeomPair pair, LiveCheck live) const;
  [[nodiscard]] bool resume(Frame<Real>& frame, LiveCheck live, const Rerun& rerun) const;
};

/// A near callback that notes pairs: `data` is a std::vector<GeomPair>*.
void note_pair(void* data, dxGeom* o1, dxGeom* o2);

}  // namespace harpoon::ode
