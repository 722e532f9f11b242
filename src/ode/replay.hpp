#pragma once

// Calls a near callback pair by pair in a given order and minds what callbacks do to the geoms
// meanwhile: geoms that are gone are left out, where libode reads the enabled flag while it walks,
// so does the replay, and where the call was handed over, libode's own traversal goes on. libode's
// space is not locked during a replay.

#include <cstddef>
#include <span>
#include <vector>

#include "ode/frame.hpp"
#include "ode/libode.hpp"
#include "ode/space_record.hpp"

namespace harpoon::ode {

template <class Real>
struct Replayer {
  const GeomReader<Real>& reader;
  void* data;
  NearCallback* callback;

  /// The pairs of a record, with contacts from its batch.
  void replay(Frame<Real>& frame, SpaceRecord<Real>& record) const;
  /// `frame.scanned`.
  void replay(Frame<Real>& frame) const;

 private:
  template <class PairAt, class IsNear>
  void replay_all(Frame<Real>& frame, std::size_t count, const PairAt& pair_at,
                  const IsNear& is_near) const;
  void deliver(Frame<Real>& frame, GeomPair pair) const;
  [[nodiscard]] bool takes_part(dxGeom* geom) const {
    return reader.takes_part(geom, reader.class_of(geom));
  }
  [[nodiscard]] bool is_due(Frame<Real>& frame, GeomPair pair) const;
  [[nodiscard]] bool is_near(const SpaceRecord<Real>& record, IndexPair pair) const;
  [[nodiscard]] bool goes_on_otherwise(Frame<Real>& frame) const;
  void follow_walk(Frame<Real>& frame) const;
  void filter_rest(Frame<Real>& frame) const;
};

}  // namespace harpoon::ode
