#pragma once

// One replay of a space's pairs on the stack of a thread: which pair the callback is looking at,
// and what has happened to the geoms meanwhile. dCollide has no argument that leads here, so the
// innermost frame of each thread is thread-local.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ode/space_record.hpp"

namespace harpoon::ode {

/// How often this thread began to call callbacks, ours or libode's own way: from then on a call
/// cannot be begun anew.
inline constinit thread_local unsigned hand_overs = 0;

/// Frames on this thread's stack: without any dCollide is libode's at once.
inline constinit thread_local int open_frames = 0;

template <class Real>
struct Frame {
  explicit Frame(dxSpace* the_space) : space(the_space), outer(current()) {
    current() = this;
    ++open_frames;
    ++hand_overs;
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

  dxSpace* const space;
  Frame* const outer;

  // The pair that the callback is looking at, or the last whose turn it was. Without a record
  // dCollide is libode's.
  dxGeom *o1 = nullptr, *o2 = nullptr;
  SpaceRecord<Real>* record = nullptr;
  std::size_t number = 0;
  std::uint64_t version = 0;  ///< of the record when its pairs were found to hold
  bool default_rules = true;  ///< the thread's floating-point mode is that of the batch
  std::uint64_t batch_contacts = 0, stock_contacts = 0;

  // What happened during callbacks.
  bool disturbed = false;      ///< any of the following: look closer at each pair
  bool stopped = false;        ///< the space is gone
  bool awakened = false;       ///< a geom that was not among the pairs may have to be
  bool toggled = false;        ///< a geom was enabled or disabled
  bool row_is_enabled = true;  ///< o1 was when its row began
  std::vector<dxGeom*> gone;

  [[nodiscard]] bool is_gone(const dxGeom* geom) const {
    return std::find(gone.begin(), gone.end(), geom) != gone.end();
  }
};

}  // namespace harpoon::ode
