#include "ode/refresher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

namespace harpoon::ode {

template <class Real>
void Refresher<Real>::note_changes(Record& record) const {
  const int count = reader.ode.space_get_num_geoms(record.space);
  const bool reported = record.changed.load(std::memory_order_relaxed) &&
                        record.changed.exchange(false, std::memory_order_relaxed);
  const bool told_widely = record.changed_widely.load(std::memory_order_relaxed) &&
                           record.changed_widely.exchange(false, std::memory_order_relaxed);
  // A geom that libode has missed is missed until its bounds are asked for, and nobody tells.
  const bool widely = told_widely || (record.mirror_valid && record.mirror.has_stale);
  const bool is_told = options.changes_are_reported && count == record.count;
  record.was_unchanged = !reported && !widely && is_told;
  if (record.was_unchanged) return;
  record.count = count;
  record.recorded_valid = false;
  bool can_follow = !widely && is_told && record.mirror_valid;
  if (can_follow) {
    std::sort(record.moved.begin(), record.moved.end());
    record.moved.erase(std::unique(record.moved.begin(), record.moved.end()), record.moved.end());
    can_follow = record.are_few(record.moved.size());
  }
  if (!can_follow) {
    record.moved.clear();
    record.mirror_valid = record.pairs_valid = false;
  }
}

/// Brings the mirror up to date after a few geoms have moved, and the pairs with it when they are
/// in use. What cannot be brought up to date is invalid afterwards.
template <class Real>
void Refresher<Real>::follow_moved(Record& record, bool in_collide) const {
  const bool is_sap = record.kind == geom_class::kSapSpace;
  // A SAP space is sorted once for each dSpaceCollide, as stock sorts it.
  const bool with_pairs = record.pairs_valid && (is_sap ? in_collide : record.pairs_used);
  record.mirror_valid = record.pairs_valid = false;
  record.contacts.reset();
  Mirror<Real>& mirror = record.mirror;
  const bool follows = is_sap
                           ? mirror.update_array(reader, record.space, record.moved, record.change)
                           : mirror.update_list(reader, record.space, record.moved, record.change);
  record.moved.clear();
  if (!follows) return;
  record.mirror_valid = true;
  record.pairs_valid = with_pairs && update_pairs(record);
  record.pairs_used = false;
}

template <class Real>
bool Refresher<Real>::update_pairs(Record& record) const {
  PairSearch<Real>& search = *record.search;
  if (record.kind == geom_class::kSimpleSpace) {
    return search.update_simple(record.mirror, record.change, record.pairs);
  }
  if (record.kind == geom_class::kSapSpace) {
    return search.update_sap(record.mirror, record.change, *record.sap, record.pairs);
  }
  int min_level = 0, max_level = 0;
  reader.ode.hash_space_get_levels(record.space, &min_level, &max_level);
  const bool done = search.update_hash(record.mirror, record.change, min_level, max_level,
                                       options.policy, record.found, record.pairs);
  if (done) Statistics::add(statistics.missed_by_stock, record.found.missed_by_stock);
  return done;
}

template <class Real>
void Refresher<Real>::refresh_mirror(Record& record, bool in_collide) const {
  if (record.mirror_valid && !record.moved.empty()) follow_moved(record, in_collide);
  if (record.mirror_valid) return;
  record.contacts.reset();
  record.expect_moves();
  // A recorded sequence has its own numbers.
  record.pairs_valid = false;
  record.mirror.read(reader, record.space, record.count);
  record.mirror_valid = true;
}

template <class Real>
void Refresher<Real>::name_strays(Record& record) const {
  const std::span<const std::uint8_t> stray = record.search->stray();
  for (std::uint32_t i = 0; i < record.mirror.size(); ++i) {
    dxGeom* const geom = record.mirror.geoms[i];
    if (stray[i] == 0 ||
        std::find(record.named.begin(), record.named.end(), geom) != record.named.end()) {
      continue;
    }
    record.named.push_back(geom);
    const Real* const box = record.mirror.bounds[i].v;
    warn(fmt::format(
        "geom {} of hash space {} lies where libode would abort: x {} to {}, y {} to "
        "{}, z {} to {}; {}",
        fmt::ptr(geom), fmt::ptr(record.space), box[0], box[1], box[2], box[3], box[4], box[5],
        (record.mirror.traits[i] & kIsNan) != 0 ? "it touches nothing"
                                                : "it is compared with every geom"));
  }
}

/// Before a SAP space that is libode's is looked at.
template <class Real>
bool Refresher<Real>::is_worth_a_look(Record& record) const {
  reader.ode.space_clean(record.space);
  if (!record.sap->is_sparse(reader, record.space, record.count)) return true;
  record.sap_was_left = true;
  record.leave_calls_to_stock();
  return false;
}

/// While a SAP space is small or sparse libode sorts it, and only libode knows in which order. That
/// order is forgotten when the number of sorted geoms changes: with more than there ever were, it
/// has. Another time a space can be taken over when its order does not hang on that of the call
/// before.
template <class Real>
bool Refresher<Real>::takes_over_sap(Record& record) const {
  if (record.sap_is_ours) return true;
  const bool is_large =
      record.sap->sorted_geoms(record.mirror) >= static_cast<std::size_t>(options.min_geoms_sap);
  record.sap_is_ours =
      is_large && (!record.sap_was_left || record.sap->finds_one_order(record.mirror));
  return record.sap_is_ours;
}

template <class Real>
Result<typename PairSearch<Real>::Found> Refresher<Real>::find_pairs(Record& record) const {
  if (record.kind == geom_class::kSimpleSpace) {
    return record.search->find_simple(record.mirror, record.pairs);
  }
  if (record.kind == geom_class::kSapSpace) {
    return record.search->find_sap(record.mirror, *record.sap, record.pairs);
  }
  int min_level = 0, max_level = 0;
  reader.ode.hash_space_get_levels(record.space, &min_level, &max_level);
  return record.search->find_hash(record.mirror, min_level, max_level, options.policy,
                                  record.pairs);
}

template <class Real>
bool Refresher<Real>::refresh_pairs(Record& record) const {
  Statistics::Counter* found_by = &statistics.unchanged;
  if (!record.moved.empty()) found_by = &statistics.updated;
  const bool is_libodes = record.kind == geom_class::kSapSpace && !record.sap_is_ours;
  if (is_libodes && !is_worth_a_look(record)) return false;
  refresh_mirror(record, true);
  if (record.mirror.has_stale && record.kind != geom_class::kSapSpace) {
    record.note_handover();
    return false;
  }
  if (record.pairs_valid) {
    Statistics::add(*found_by, 1);
    return true;
  }
  const bool asks_unknown_tests =
      !options.changes_are_reported && (record.mirror.all_traits & kHasAabbTest) != 0;
  if (asks_unknown_tests) return false;
  if (record.kind == geom_class::kSapSpace && !takes_over_sap(record)) return false;
  record.contacts.reset();
  if (!record.search) {
    Result<PairSearch<Real>> search = PairSearch<Real>::make();
    if (!search) {
      warn(search.error().message);
      return false;
    }
    record.search = std::make_unique<PairSearch<Real>>(std::move(*search));
  }
  const auto found = find_pairs(record);
  if (!found) {
    warn(found.error().message);
    return false;
  }
  if (record.kind == geom_class::kSapSpace && options.changes_are_reported &&
      record.sap->is_for_libode()) {
    record.sap_is_ours = false;
    record.sap_was_left = true;
    record.leave_calls_to_stock();
    return false;
  }
  record.found = *found;
  if (found->stock_aborts) {
    if (options.policy == Policy::strict) return false;
    name_strays(record);
  }
  Statistics::add(statistics.searched, 1);
  Statistics::add(statistics.missed_by_stock, found->missed_by_stock);
  record.pairs_valid = true;
  return true;
}

template struct Refresher<float>;
template struct Refresher<double>;

}  // namespace harpoon::ode
