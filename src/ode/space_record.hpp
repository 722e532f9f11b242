#pragma once

// What the drop-in remembers of one space: its mirror, its pairs in order, and whether they still
// hold. It decides nothing; the engine does.

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "ode/mirror.hpp"
#include "ode/pair_search.hpp"
#include "ode/sap_order.hpp"
#include "ode/sphere_contacts.hpp"

namespace harpoon::ode {

/// o1 and o2 of a callback.
struct GeomPair {
  dxGeom *o1, *o2;
  bool operator==(const GeomPair&) const = default;
};

template <class Real>
struct SpaceRecord {
  SpaceRecord(dxSpace* the_space, int the_kind) : space(the_space), kind(the_kind) {}

  dxSpace* const space;
  const int kind;  ///< class number

  /// Anything that the pairs depend on has changed since they were found.
  std::atomic<bool> changed{true};
  /// Grows whenever contacts of the space's geoms may have changed.
  std::atomic<std::uint64_t> version{0};
  /// The thread that is in a call on this space, by a token of its own; null: none.
  std::atomic<const void*> owner{nullptr};
  int calls_under_way = 0;  ///< on the owner's stack

  bool mirror_valid = false;
  bool pairs_valid = false;
  int count = -1;              ///< of all its geoms when it was last looked at
  bool was_unchanged = false;  ///< nothing had changed between the last two looks
  std::uint64_t calls = 0;     ///< dSpaceCollide calls so far
  Mirror<Real> mirror;
  std::vector<IndexPair> pairs;  ///< of the mirror, in the order of callbacks
  SphereContacts<Real> contacts;
  std::unique_ptr<PairSearch<Real>> search;
  typename PairSearch<Real>::Found found;  ///< about `pairs`
  std::vector<const dxGeom*> named;        ///< stray geoms that the log has named

  std::optional<SapOrder<Real>> sap;  ///< only for spaces whose creation was seen
  bool sap_is_ours = false;           ///< libode is not asked any more, its history is old
  std::vector<GeomPair> recorded;     ///< libode's own sequence
  bool recorded_valid = false;

  void mark_moved() {
    version.store(version.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
    changed.store(true, std::memory_order_relaxed);
  }
  void mark_changed() { changed.store(true, std::memory_order_relaxed); }
};

}  // namespace harpoon::ode
