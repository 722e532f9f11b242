#pragma once

// What the drop-in remembers of one space: its mirror, its pairs in order, and whether they still
// hold. It decides nothing; the engine does.

#include <algorithm>
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

template <class Real>
struct SpaceRecord {
  SpaceRecord(dxSpace* the_space, int the_kind) : space(the_space), kind(the_kind) {}

  dxSpace* const space;
  const int kind;  ///< class number

  /// Anything that the pairs depend on has changed since they were found.
  std::atomic<bool> changed{true};
  /// More than the bounds and poses of `moved`.
  std::atomic<bool> changed_widely{true};
  /// Geoms that have moved since the mirror was read, some of them more than once. Of the thread
  /// that works on the space.
  std::vector<dxGeom*> moved;
  /// Grows whenever contacts of the space's geoms may have changed.
  std::atomic<std::uint64_t> version{0};
  /// The thread that is in a call on this space, by a token of its own; null: none.
  std::atomic<const void*> owner{nullptr};
  int calls_under_way = 0;  ///< on the owner's stack

  bool mirror_valid = false;
  bool pairs_valid = false;
  bool pairs_used =
      false;       ///< a call has asked for them since they were found or brought up to date
  int count = -1;  ///< of all its geoms when it was last looked at
  bool was_unchanged = false;  ///< nothing had changed between the last two looks
  std::uint64_t calls = 0;     ///< dSpaceCollide calls so far
  Mirror<Real> mirror;
  SlotChange change;             ///< of the mirror's last update
  std::vector<IndexPair> pairs;  ///< of the mirror, in the order of callbacks
  SphereContacts<Real> contacts;
  std::unique_ptr<PairSearch<Real>> search;
  typename PairSearch<Real>::Found found;  ///< about `pairs`
  std::vector<const dxGeom*> named;        ///< stray geoms that the log has named

  std::optional<SapOrder<Real>> sap;  ///< only for spaces whose creation was seen
  bool sap_is_ours = false;           ///< libode is not asked any more, its history is old
  bool sap_was_left = false;          ///< to libode, with as many geoms as are worth it
  std::vector<GeomPair> recorded;     ///< libode's own sequence
  bool recorded_valid = false;

  /// Calls yet to be left to libode, because callbacks change what it reads while it walks.
  int calls_left_to_stock = 0;
  int calls_left_last_time = 0;
  static constexpr int kMostCallsLeft = 63;
  /// A call had to be handed over: each time twice as many that follow it are left to libode.
  void note_handover() {
    calls_left_last_time = std::min(2 * calls_left_last_time + 1, kMostCallsLeft);
    calls_left_to_stock = calls_left_last_time;
  }
  /// libode's own way is the fastest for now. To find that out takes as long as a few calls.
  void leave_calls_to_stock() { calls_left_to_stock = 255; }
  /// A call went through without.
  void note_own_course() {
    if (calls_left_to_stock == 0) calls_left_last_time = 0;
  }
  [[nodiscard]] bool leaves_call_to_stock() {
    if (calls_left_to_stock == 0) return false;
    --calls_left_to_stock;
    return true;
  }

  /// The bounds and pose of one geom have changed. Allocates nothing: what `expect_moves` has made
  /// room for is remembered.
  void note_moved(dxGeom* geom) {
    count_version();
    changed.store(true, std::memory_order_relaxed);
    if (changed_widely.load(std::memory_order_relaxed)) return;
    if (!moved.empty() && moved.back() == geom) return;
    if (moved.size() == moved.capacity()) return mark_changed();
    moved.push_back(geom);
  }
  /// Makes room for so many calls of `note_moved` as are worth it: a geom may be moved a few times
  /// over. Throws std::bad_alloc.
  void expect_moves() {
    moved.clear();
    moved.reserve(4 * most_few());
  }
  /// Whether an update for so many different geoms is faster than to read and search anew.
  [[nodiscard]] bool are_few(std::size_t geoms) const { return geoms <= most_few(); }

  /// Contacts may have changed, and anything else.
  void mark_changed_with_contacts() {
    count_version();
    mark_changed();
  }
  void mark_changed() {
    changed_widely.store(true, std::memory_order_relaxed);
    changed.store(true, std::memory_order_relaxed);
  }

 private:
  /// In a SAP space each geom that moves takes a second one to another place. By measurement.
  [[nodiscard]] std::size_t most_few() const {
    const auto all = static_cast<std::size_t>(count);
    return kind == geom_class::kSapSpace ? std::min<std::size_t>(128, 1 + all / 32)
                                         : std::min<std::size_t>(256, 1 + all / 8);
  }
  void count_version() {
    version.store(version.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
};

}  // namespace harpoon::ode
