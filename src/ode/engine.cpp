#include "ode/engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "ode/float_mode.hpp"
#include "ode/frame.hpp"
#include "ode/handover.hpp"
#include "ode/refresher.hpp"
#include "ode/replay.hpp"
#include "ode/scan.hpp"
#include "ode/space_table.hpp"
#include "ode/verify.hpp"

namespace harpoon::ode {
namespace {

constexpr std::string_view kOutOfMemory = "out of memory; the call is left to libode";

/// A different address for each thread.
const void* this_thread() {
  static thread_local char token = 0;
  return &token;
}

/// The calling thread in a call on a record. Other threads, which libode forbids, are kept out.
template <class Record>
class Entry {
 public:
  explicit Entry(Record& record) : record_(record) {
    const void* nobody = nullptr;
    entered_ =
        record.owner.compare_exchange_strong(nobody, this_thread()) || nobody == this_thread();
    if (entered_) ++record.calls_under_way;
  }
  ~Entry() {
    if (entered_ && --record_.calls_under_way == 0) {
      record_.owner.store(nullptr, std::memory_order_release);
    }
  }
  Entry(const Entry&) = delete;
  Entry& operator=(const Entry&) = delete;

  [[nodiscard]] bool entered() const { return entered_; }
  /// No replay further up the stack reads the record's arrays.
  [[nodiscard]] bool alone() const { return record_.calls_under_way == 1; }

 private:
  Record& record_;
  bool entered_;
};

/// Stands for the test of a user class that is not known.
int is_near(dxGeom*, dxGeom*, void*) {
  return 1;
}

/// libode's own traversal, its pairs noted down while the callback sees them.
struct Recorder {
  std::vector<GeomPair>& pairs;
  void* data;
  NearCallback* callback;
  bool complete = true;

  static void near(void* recorder, dxGeom* o1, dxGeom* o2) {
    Recorder& self = *static_cast<Recorder*>(recorder);
    self.note({o1, o2});
    self.callback(self.data, o1, o2);
  }

  void note(GeomPair pair) noexcept {
    try {
      if (complete) pairs.push_back(pair);
    } catch (const std::bad_alloc&) {
      complete = false;
    }
  }
};

template <class Real>
class EngineOf final : public Engine {
 public:
  EngineOf(const LibodeOf<Real>& ode, EngineParts parts)
      : ode_(ode), parts_(std::move(parts)), options_(parts_.options) {
    source_.device = parts_.device.get();
    source_.single_precision = options_.single_precision_contacts;
    source_.whole_frames = parts_.device->name() != "cpu";
    // Where classes are not reported either, every user class may ask.
    if (!options_.changes_are_reported)
      std::fill_n(user_tests_, geom_class::kUserClasses, &is_near);
  }

  void space_collide(dxSpace* space, void* data, NearCallback* callback) override;
  void space_collide2(dxGeom* o1, dxGeom* o2, void* data, NearCallback* callback) override;
  int collide(dxGeom* o1, dxGeom* o2, int flags, void* contact, int skip) override;

  void changing(dxGeom* geom, Change change) override;
  void moved(dxGeom* geom) override;
  void filters_changed(dxGeom* geom) override;
  void toggled(dxGeom* geom) override;
  void added(dxSpace* space) override;
  void removed(dxSpace* space, dxGeom* geom) override;
  void destroying(dxGeom* geom) override;
  void levels_changed(dxSpace* space) override;
  void sap_created(dxSpace* space, int axis_order) override;
  void class_created(int number, AabbTest* test) override;
  void collider_overridden(int class1, int class2) override;
  void closed() override;
  void lost_track() noexcept override;

  [[nodiscard]] const Statistics& statistics() const override { return statistics_; }
  [[nodiscard]] std::string report() const override {
    return to_line(statistics_, parts_.device->name(), options_.changes_are_reported);
  }

 private:
  using Record = SpaceRecord<Real>;

  [[nodiscard]] int kind_of(dxGeom* geom) const { return ode_.geom_get_class(geom); }
  /// A space of whose geoms no move is to be noted as long as `looks_` stays.
  struct Settled {
    const EngineOf* engine = nullptr;
    dxSpace* space = nullptr;
    std::uint64_t looks = 0;
    bool all = false;  ///< of no geom at all: no other space is known
  };
  static Settled& last_settled() {
    static thread_local Settled settled;
    return settled;
  }
  [[gnu::noinline]] void note_move(dxGeom* geom, dxSpace* home);
  /// Threads that look at spaces of their own may count as one; a thread sees its own.
  void count_look() {
    looks_.store(looks_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  }
  [[nodiscard]] int min_geoms(int kind) const;
  Record* find_or_make(dxSpace* space, int kind);
  Record* put(dxSpace* space, std::shared_ptr<Record> record);
  void begin_to_listen();
  void stop_listening(Record& record);
  void expect_frames();
  /// Where moves are not told of, what callbacks move cannot be seen: dSpaceCollide2 does not lock
  /// its probe, and some builds lock nothing.
  [[nodiscard]] bool sees_all_of_scans() const {
    return options_.changes_are_reported || !options_.callbacks_may_change;
  }
  [[nodiscard]] bool sees_all() const { return sees_all_of_scans() || locks_are_checked_; }
  [[nodiscard]] Record* record_to_collide(dxSpace* space, int kind);
  [[nodiscard]] bool prepare(Record& record);
  void note_changes(Record& record) {
    count_look();
    refresher_.note_changes(record);
  }
  void intern_recorded(Record& record) const;
  [[nodiscard]] bool answer_in_order(Record& record, void* data, NearCallback* callback);
  void record_or_replay(Record& record, void* data, NearCallback* callback);
  [[nodiscard]] bool replay_recorded(Record& record, void* data, NearCallback* callback);
  [[nodiscard]] bool replay_record(Record& record, LiveCheck live, void* data,
                                   NearCallback* callback);
  [[nodiscard]] bool is_comparable(const Record& record) const;
  template <class Replay>
  [[nodiscard]] bool run(Frame<Real>& frame, const VerifiedCall<Real>* verified,
                         const Replay& replay);
  /// A dSpaceCollide2: one geom against all of a space, or each geom of another space.
  struct ScanCall {
    dxGeom *o1, *o2;  ///< its arguments
    dxSpace* scanned;
    dxSpace* looped;  ///< null: `other` alone
    dxGeom* other;
    bool scanned_first;  ///< in callbacks

    /// libode's own, for one geom of the looped space.
    [[nodiscard]] Traversal<Real> of(const LibodeOf<Real>& ode, dxGeom* geom) const {
      return scanned_first ? Traversal<Real>{&ode, as_geom(scanned), geom}
                           : Traversal<Real>{&ode, geom, as_geom(scanned)};
    }
  };
  [[nodiscard]] std::optional<ScanCall> scan_call(dxGeom* o1, dxGeom* o2) const;
  [[nodiscard]] bool can_loop(dxSpace* space) const;
  [[nodiscard]] bool scan(const ScanCall& call, dxGeom* probe, std::vector<GeomPair>& pairs);
  [[nodiscard]] bool try_scan(const ScanCall& call, dxGeom* probe,
                              std::vector<GeomPair>& pairs) noexcept;
  [[nodiscard]] std::shared_ptr<Record> prepare_scan(const ScanCall& call, dxGeom* probe,
                                                     std::vector<GeomPair>& pairs);
  [[nodiscard]] bool answer_scan(const ScanCall& call, void* data, NearCallback* callback);
  void loop(const ScanCall& call, dxGeom* first, Frame<Real>& frame, const Replayer<Real>& replayer,
            std::vector<GeomPair>& pairs);
  [[nodiscard]] Handover<Real> handover() {
    return {ode_, parts_.log, statistics_, locks_are_checked_};
  }
  /// A quadtree's blocks are libode's secret.
  [[nodiscard]] bool can_scan(dxSpace* space) const {
    return kind_of(as_geom(space)) != geom_class::kQuadtreeSpace;
  }
  [[nodiscard]] bool spheres_are_ours();
  [[nodiscard]] bool is_as_mirrored(const Mirror<Real>& mirror, IndexPair pair) const;
  int answer_contact(Frame<Real>& frame, int flags, ContactGeomOf<Real>& contact, int skip);
  void leave_to_stock(dxSpace* space, void* data, NearCallback* callback) {
    // Small spaces come this way, whose calls are so short that counting them shows.
    if (options_.statistics) Statistics::add(statistics_.left_to_stock, 1);
    ++walks_begun;
    ode_.space_collide(space, data, callback);
  }
  void warn(std::string_view line) const {
    if (parts_.log) parts_.log(LogLevel::warning, line);
  }

  const LibodeOf<Real> ode_;
  EngineParts parts_;
  const Options& options_;
  Statistics statistics_;
  SpaceTable<Record> table_;
  std::atomic<bool> listens_{false};
  std::atomic<bool> expects_frames_{false};
  std::atomic<std::uint64_t> looks_{1};  ///< how often what is known of spaces has been renewed
  UserTests user_tests_{};
  GeomLayout layout_;               ///< found when the first space is looked at
  bool locks_are_checked_ = false;  ///< likewise
  std::once_flag libode_is_known_;
  const GeomReader<Real> reader_{ode_, layout_, user_tests_};
  const Refresher<Real> refresher_{reader_, options_, parts_.log, statistics_};
  ContactSource source_;
  enum class Agreement { unknown, yes, no };
  std::atomic<Agreement> spheres_{Agreement::unknown};
};

/// Adds the time of its life to a counter.
class Stopwatch {
 public:
  Stopwatch(bool on, Statistics::Counter& counter) : counter_(on ? &counter : nullptr) {
    if (on) begin_ = std::chrono::steady_clock::now();
  }
  ~Stopwatch() {
    if (counter_ == nullptr) return;
    const auto time = std::chrono::steady_clock::now() - begin_;
    Statistics::add(*counter_,
                    static_cast<std::uint64_t>(
                        std::chrono::duration_cast<std::chrono::nanoseconds>(time).count()));
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  Statistics::Counter* counter_;
  std::chrono::steady_clock::time_point begin_;
};

template <class Real>
int EngineOf<Real>::min_geoms(int kind) const {
  switch (kind) {
    case geom_class::kSimpleSpace:
      return options_.min_geoms_simple;
    case geom_class::kHashSpace:
      return options_.min_geoms_hash;
    case geom_class::kSapSpace:
      return options_.min_geoms_sap;
    default:
      return options_.min_geoms_quadtree;
  }
}

/// From the first space on that is not libode's alone, changes are to be heard of. Throws
/// std::bad_alloc.
template <class Real>
void EngineOf<Real>::begin_to_listen() {
  if (listens_.load(std::memory_order_acquire)) return;
  std::call_once(libode_is_known_, [this] {
    layout_ = find_geom_layout(ode_);
    locks_are_checked_ = options_.callbacks_may_change && checks_locks(ode_);
  });
  if (parts_.before_first_space) parts_.before_first_space();
  listens_.store(true, std::memory_order_release);
}

/// The only space is libode's for a while: in large ones that all move, to hear of it shows.
template <class Real>
void EngineOf<Real>::stop_listening(Record& record) {
  const bool is_left = record.sap.has_value() && !record.sap_is_ours;
  if (!is_left || table_.size() != 1 || open_frames != 0 || !parts_.without_spaces) return;
  listens_.store(false, std::memory_order_release);
  parts_.without_spaces();
}

template <class Real>
SpaceRecord<Real>* EngineOf<Real>::find_or_make(dxSpace* space, int kind) {
  begin_to_listen();
  Record* record = table_.empty() ? nullptr : table_.find(space);
  if (record != nullptr && record->kind == kind) return record;
  return put(space, std::make_shared<Record>(space, kind));
}

template <class Real>
SpaceRecord<Real>* EngineOf<Real>::put(dxSpace* space, std::shared_ptr<Record> record) {
  Statistics::add(statistics_.spaces, 1);
  count_look();
  return table_.put(space, std::move(record));
}

/// To be called before a frame is opened.
template <class Real>
void EngineOf<Real>::expect_frames() {
  if (expects_frames_.load(std::memory_order_acquire)) return;
  if (parts_.before_first_frame) parts_.before_first_frame();
  expects_frames_.store(true, std::memory_order_release);
}

/// Where stock aborts or pairs were added to stock's there is nothing to compare with.
template <class Real>
bool EngineOf<Real>::is_comparable(const Record& record) const {
  return options_.verify && !record.found.stock_aborts &&
         (options_.policy != Policy::fixed || record.found.missed_by_stock == 0);
}

/// Runs a replay, with stock's traversal beside it where there is something to verify. False before
/// the first callback, when there is no memory for that.
template <class Real>
template <class Replay>
bool EngineOf<Real>::run(Frame<Real>& frame, const VerifiedCall<Real>* verified,
                         const Replay& replay) {
  std::optional<Verifier<Real>> verifier;
  if (verified != nullptr && parts_.differs) {
    std::optional<WalkStack> stack = WalkStack::take();
    if (!stack) return false;
    verifier.emplace(ode_, *verified, frame.stock, *std::move(stack), parts_.differs);
    frame.verifier = &*verifier;
  }
  replay();
  if (verifier) {
    if (frame.stopped) verifier->abandon();
    verifier->finish();
    Statistics::add(statistics_.verified_pairs, verifier->compared());
  }
  Statistics::add(statistics_.batch_contacts, frame.batch_contacts);
  Statistics::add(statistics_.stock_contacts, frame.stock_contacts);
  return true;
}

/// False before the first callback, when the call is libode's after all.
template <class Real>
bool EngineOf<Real>::replay_record(Record& record, LiveCheck live, void* data,
                                   NearCallback* callback) {
  std::optional<WalkStack> stack = WalkStack::take();
  if (!stack) return false;
  record.contacts.rewind(record.was_unchanged);
  Frame<Real> frame(record.space, live, {&ode_, as_geom(record.space)}, *std::move(stack));
  frame.default_rules = computes_by_default_rules();
  frame.origin = &record;
  frame.reads_filters_only = record.kind == geom_class::kSapSpace;
  const VerifiedCall<Real> verified{
      "dSpaceCollide", record, options_.policy,
      record.kind != geom_class::kQuadtreeSpace && record.mirror_valid};
  const Replayer<Real> replayer{reader_, data, callback};
  Statistics::add(statistics_.pairs, record.pairs.size());
  if (!run(frame, is_comparable(record) ? &verified : nullptr,
           [&] { replayer.replay(frame, record); })) {
    return false;
  }
  if (frame.course == Course::own) record.note_own_course();
  return true;
}

/// Brings mirror and pairs up to date. False when the call is libode's.
template <class Real>
bool EngineOf<Real>::prepare(Record& record) {
  note_changes(record);
  if (!refresher_.refresh_pairs(record)) return false;
  expect_frames();
  return true;
}

/// Simple, hash and SAP. False when the call is libode's.
template <class Real>
bool EngineOf<Real>::answer_in_order(Record& record, void* data, NearCallback* callback) {
  const std::shared_ptr<Record> alive = table_.hold(record.space);
  const Entry entry(record);
  if (!entry.entered()) return false;
  if (record.kind != geom_class::kSapSpace && record.leaves_call_to_stock()) return false;
  if (entry.alone()) {
    try {
      if (!prepare(record)) return false;
    } catch (const std::bad_alloc&) {
      warn(kOutOfMemory);
      return false;
    }
  } else if (record.changed.load(std::memory_order_relaxed) || !record.pairs_valid) {
    return false;
  }
  ++record.calls;
  record.pairs_used = true;
  const LiveCheck live =
      record.kind == geom_class::kSimpleSpace ? LiveCheck::rows : LiveCheck::none;
  return replay_record(record, live, data, callback);
}

/// Gives the geoms of a recorded sequence places in a mirror, so that it can be replayed like one.
template <class Real>
void EngineOf<Real>::intern_recorded(Record& record) const {
  Mirror<Real>& mirror = record.mirror;
  mirror.clear();
  record.mirror_valid = false;
  record.pairs.clear();
  record.contacts.reset();
  std::unordered_map<dxGeom*, std::uint32_t> places;
  const auto place_of = [&](dxGeom* geom) {
    const auto [place, is_new] = places.try_emplace(geom, mirror.size());
    if (is_new) mirror.append_for_contacts(reader_, geom);
    return place->second;
  };
  for (const auto& [o1, o2] : record.recorded) {
    const std::uint32_t first = place_of(o1);
    record.pairs.push_back({first, place_of(o2)});
  }
  record.pairs_valid = true;
}

/// Replays what was recorded of a space of which nothing has changed since. False when the call is
/// libode's.
template <class Real>
bool EngineOf<Real>::replay_recorded(Record& record, void* data, NearCallback* callback) {
  try {
    if (record.recorded_valid && !record.pairs_valid) intern_recorded(record);
    // What a user class answers may change without notice.
    if (!record.recorded_valid || (record.mirror.all_traits & kHasAabbTest) != 0) return false;
    expect_frames();
  } catch (const std::bad_alloc&) {
    record.mark_changed();
    return false;
  }
  Statistics::add(statistics_.unchanged, 1);
  const LiveCheck live =
      record.kind == geom_class::kQuadtreeSpace ? LiveCheck::rows : LiveCheck::none;
  return replay_record(record, live, data, callback);
}

/// Quadtree spaces and SAP spaces whose creation nobody saw: recorded when nothing has changed
/// since the call before, replayed when nothing has since then.
template <class Real>
void EngineOf<Real>::record_or_replay(Record& record, void* data, NearCallback* callback) {
  const std::shared_ptr<Record> alive = table_.hold(record.space);
  const Entry entry(record);
  if (!entry.entered() || !entry.alone()) {
    leave_to_stock(record.space, data, callback);
    return;
  }
  note_changes(record);
  ++record.calls;
  if (replay_recorded(record, data, callback)) return;
  if (!record.was_unchanged) {
    leave_to_stock(record.space, data, callback);
    return;
  }
  Statistics::add(statistics_.recorded, 1);
  record.recorded.clear();
  record.pairs_valid = false;
  Recorder recorder{record.recorded, data, callback};
  ++walks_begun;
  ode_.space_collide(record.space, &recorder, &Recorder::near);
  record.recorded_valid = recorder.complete && !record.changed.load(std::memory_order_relaxed);
  Statistics::add(statistics_.pairs, record.recorded.size());
}

/// The record of a space whose dSpaceCollide is not libode's alone, or null.
template <class Real>
SpaceRecord<Real>* EngineOf<Real>::record_to_collide(dxSpace* space, int kind) {
  Record* const sap =
      kind == geom_class::kSapSpace && !table_.empty() ? table_.find(space) : nullptr;
  const bool is_ours = sap != nullptr && sap->sap.has_value() && sap->sap_is_ours;
  if (sap != nullptr && !is_ours && sap->leaves_call_to_stock()) return nullptr;
  if (!is_space_class(kind) || (!is_ours && ode_.space_get_num_geoms(space) < min_geoms(kind))) {
    return nullptr;
  }
  try {
    begin_to_listen();
    return sees_all() ? find_or_make(space, kind) : nullptr;
  } catch (const std::bad_alloc&) {
    warn(kOutOfMemory);
    return nullptr;
  }
}

template <class Real>
void EngineOf<Real>::space_collide(dxSpace* space, void* data, NearCallback* callback) {
  if (space == nullptr || callback == nullptr) {
    ++walks_begun;
    ode_.space_collide(space, data, callback);
    return;
  }
  const Stopwatch stopwatch(options_.statistics, statistics_.inside_ns);
  const int kind = kind_of(as_geom(space));
  Record* const record = record_to_collide(space, kind);
  if (record == nullptr) {
    leave_to_stock(space, data, callback);
    return;
  }
  const bool is_recorded = kind == geom_class::kQuadtreeSpace ||
                           (kind == geom_class::kSapSpace && !record->sap.has_value());
  if (is_recorded) {
    record_or_replay(*record, data, callback);
  } else if (!answer_in_order(*record, data, callback)) {
    record->mark_changed();
    stop_listening(*record);
    leave_to_stock(space, data, callback);
  }
}

/// Finds the pairs of one geom and the space. False when they are libode's. Throws std::bad_alloc.
template <class Real>
bool EngineOf<Real>::scan(const ScanCall& call, dxGeom* probe, std::vector<GeomPair>& pairs) {
  pairs.clear();
  const int probe_kind = kind_of(probe);
  if (probe_kind >= geom_class::kFirstUser &&
      user_tests_[probe_kind - geom_class::kFirstUser] != nullptr) {
    return false;
  }
  Record& record = *find_or_make(call.scanned, kind_of(as_geom(call.scanned)));
  const Entry entry(record);
  if (!entry.entered()) return false;
  if (entry.alone()) {
    note_changes(record);
    refresher_.refresh_mirror(record, false);
  } else if (record.changed.load(std::memory_order_relaxed) || !record.mirror_valid) {
    return false;
  }
  if ((record.mirror.all_traits & kHasAabbTest) != 0) return false;
  if (record.mirror.has_stale) {
    record.note_handover();
    return false;
  }
  append_scan(record.mirror, Probe<Real>(ode_, probe), call.scanned_first, pairs);
  return true;
}

/// The same; false for want of memory, too.
template <class Real>
bool EngineOf<Real>::try_scan(const ScanCall& call, dxGeom* probe,
                              std::vector<GeomPair>& pairs) noexcept {
  try {
    return scan(call, probe, pairs);
  } catch (const std::bad_alloc&) {
    return false;
  }
}

/// Before the first callback of a dSpaceCollide2: the record of the space that is scanned, and the
/// pairs of the first geom. Null when the call is libode's.
template <class Real>
std::shared_ptr<SpaceRecord<Real>> EngineOf<Real>::prepare_scan(const ScanCall& call, dxGeom* probe,
                                                                std::vector<GeomPair>& pairs) {
  try {
    if (find_or_make(call.scanned, kind_of(as_geom(call.scanned)))->leaves_call_to_stock()) {
      return nullptr;
    }
    if (call.looped != nullptr) (void)find_or_make(call.looped, kind_of(as_geom(call.looped)));
    if (!scan(call, probe, pairs)) return nullptr;
    expect_frames();
    return table_.hold(call.scanned);
  } catch (const std::bad_alloc&) {
    warn(kOutOfMemory);
    return nullptr;
  }
}

/// False before the first callback, when the call is libode's.
template <class Real>
bool EngineOf<Real>::answer_scan(const ScanCall& call, void* data, NearCallback* callback) {
  dxGeom* const first = call.looped == nullptr ? call.other : ode_.space_get_geom(call.looped, 0);
  std::vector<GeomPair> pairs;
  const std::shared_ptr<Record> record = prepare_scan(call, first, pairs);
  if (record == nullptr) return false;
  const bool verifies = options_.verify && parts_.differs;
  if (pairs.empty() && call.looped == nullptr && !verifies) return true;
  std::optional<WalkStack> stack = WalkStack::take();
  if (!stack) return false;
  Frame<Real> frame(call.scanned, call.scanned_first ? LiveCheck::first : LiveCheck::second,
                    {&ode_, call.o1, call.o2}, *std::move(stack));
  frame.looped = call.looped;
  frame.origin = record.get();
  const VerifiedCall<Real> verified{"dSpaceCollide2", *record, options_.policy, false};
  const Replayer<Real> replayer{reader_, data, callback};
  if (!run(frame, verifies ? &verified : nullptr,
           [&] { loop(call, first, frame, replayer, pairs); })) {
    return false;
  }
  if (frame.course == Course::own) record->note_own_course();
  return true;
}

/// One geom after the other against the space: those of `call.looped` in libode's order, or the
/// first alone. A change of the looped space's list is handed over before it is made.
template <class Real>
void EngineOf<Real>::loop(const ScanCall& call, dxGeom* first, Frame<Real>& frame,
                          const Replayer<Real>& replayer, std::vector<GeomPair>& pairs) {
  frame.probe = first;
  for (int k = 0;;) {
    Statistics::add(statistics_.pairs, pairs.size());
    frame.scanned = pairs;
    replayer.replay(frame);
    if (frame.stopped || frame.course == Course::stock || call.looped == nullptr) return;
    // The next has come to the place of one that is gone.
    if (frame.probe != nullptr) ++k;
    if (k >= ode_.space_get_num_geoms(call.looped)) return;
    frame.probe = ode_.space_get_geom(call.looped, k);
    if (try_scan(call, frame.probe, pairs)) continue;
    pairs.clear();
    handover().all_that_follows(frame);
    if (frame.course != Course::stock) call.of(ode_, frame.probe)(replayer.data, replayer.callback);
  }
}

/// Whether libode's loop over a space can be made here, geom by geom. dSpaceCollide2 would not take
/// a space for a geom where the call has to be left to it.
template <class Real>
bool EngineOf<Real>::can_loop(dxSpace* space) const {
  const int kind = kind_of(as_geom(space));
  if (kind != geom_class::kSimpleSpace && kind != geom_class::kHashSpace) return false;
  const int count = ode_.space_get_num_geoms(space);
  for (int k = 0; k < count; ++k) {
    if (is_space_class(kind_of(ode_.space_get_geom(space, k)))) return false;
  }
  return count > 0;
}

/// What dSpaceCollide2 makes of its arguments, neither of which is null. Nothing where the call is
/// libode's.
template <class Real>
std::optional<typename EngineOf<Real>::ScanCall> EngineOf<Real>::scan_call(dxGeom* o1,
                                                                           dxGeom* o2) const {
  dxSpace* space1 = is_space_class(kind_of(o1)) ? as_space(o1) : nullptr;
  dxSpace* space2 = is_space_class(kind_of(o2)) ? as_space(o2) : nullptr;
  if (space1 != nullptr && space2 != nullptr) {
    const int level1 = ode_.space_get_sublevel(space1), level2 = ode_.space_get_sublevel(space2);
    if (level1 > level2) space2 = nullptr;
    if (level1 < level2) space1 = nullptr;
  }
  ScanCall call{o1, o2, nullptr, nullptr, nullptr, true};
  int most = 0;
  if (space1 != nullptr && space2 != nullptr) {
    // libode's loop over the space that has fewer geoms, each of which is compared with the other
    // space. The looped space is not locked meanwhile.
    const int count1 = ode_.space_get_num_geoms(space1), count2 = ode_.space_get_num_geoms(space2);
    call.looped = count1 < count2 ? space1 : space2;
    call.scanned = call.looped == space1 ? space2 : space1;
    call.scanned_first = call.scanned == space1;
    most = std::max(count1, count2);
    if (most >= options_.min_geoms_scan && !can_loop(call.looped)) return std::nullopt;
  } else if (space1 != nullptr || space2 != nullptr) {
    call.scanned_first = space1 != nullptr;
    call.scanned = call.scanned_first ? space1 : space2;
    call.other = call.scanned_first ? o2 : o1;
    most = ode_.space_get_num_geoms(call.scanned);
  } else {
    return std::nullopt;
  }
  if (most < options_.min_geoms_scan || !can_scan(call.scanned) || !sees_all_of_scans()) {
    return std::nullopt;
  }
  return call;
}

template <class Real>
void EngineOf<Real>::space_collide2(dxGeom* o1, dxGeom* o2, void* data, NearCallback* callback) {
  if (o1 == nullptr || o2 == nullptr || callback == nullptr) {
    ++walks_begun;
    ode_.space_collide2(o1, o2, data, callback);
    return;
  }
  if (o1 == o2 && is_space_class(kind_of(o1))) {
    space_collide(as_space(o1), data, callback);
    return;
  }
  const Stopwatch stopwatch(options_.statistics, statistics_.inside_ns);
  const std::optional<ScanCall> call = scan_call(o1, o2);
  const bool answered = call && answer_scan(*call, data, callback);
  if (answered && call->looped != nullptr) Statistics::add(statistics_.scanned_spaces, 1);
  Statistics::add(answered ? statistics_.scanned : statistics_.left_to_stock, 1);
  if (answered) return;
  ++walks_begun;
  ode_.space_collide2(o1, o2, data, callback);
}

/// Tried once, at the first pair of spheres: libode is initialised by then.
template <class Real>
bool EngineOf<Real>::spheres_are_ours() {
  Agreement agreement = spheres_.load(std::memory_order_relaxed);
  if (agreement == Agreement::unknown) {
    const bool wanted = source_.single_precision || spheres_agree(ode_, *source_.device);
    agreement = wanted ? Agreement::yes : Agreement::no;
    spheres_.store(agreement, std::memory_order_relaxed);
    if (!wanted) {
      warn(
          "this libode computes spheres with other bits than IEEE-754 operation by operation; "
          "their contacts are left to it");
    }
  }
  return agreement == Agreement::yes;
}

/// Whether a pair's geoms are spheres where the mirror has them, on the bodies that it has.
template <class Real>
bool EngineOf<Real>::is_as_mirrored(const Mirror<Real>& mirror, IndexPair pair) const {
  if (!mirror.are_spheres(pair)) return false;
  for (const std::uint32_t slot : {pair.g1, pair.g2}) {
    dxGeom* const geom = mirror.geoms[slot];
    const Real* const at = reader_.position_of(geom);
    const SphereOf<Real>& sphere = mirror.spheres[slot];
    if (at[0] != sphere.x || at[1] != sphere.y || at[2] != sphere.z ||
        reader_.radius_of(geom) != sphere.r || reader_.body_of(geom) != mirror.bodies[slot]) {
      return false;
    }
  }
  return true;
}

/// The contact of the frame's pair: 0 or 1 as dCollide, -1 when it is libode's.
template <class Real>
int EngineOf<Real>::answer_contact(Frame<Real>& frame, int flags, ContactGeomOf<Real>& contact,
                                   int skip) {
  Record& record = *frame.record;
  if (record.version.load(std::memory_order_relaxed) != frame.version || !frame.default_rules ||
      (flags & kContactCountMask) == 0 || skip < static_cast<int>(sizeof contact)) {
    return -1;
  }
  SphereContacts<Real>& contacts = record.contacts;
  if (!contacts.has(frame.number)) {
    if (!record.mirror.are_spheres(record.pairs[frame.number])) return -1;
    try {
      if (!spheres_are_ours()) return -1;
      contacts.load(source_, record.mirror, record.pairs, frame.number);
    } catch (const std::bad_alloc&) {
      contacts.reset();
      return -1;
    }
  }
  // Nobody tells what callbacks do meanwhile.
  if (!options_.changes_are_reported &&
      !is_as_mirrored(record.mirror, record.pairs[frame.number])) {
    return -1;
  }
  using Answer = typename SphereContacts<Real>::Answer;
  const Answer answer = contacts.find(record.mirror, record.pairs, frame.number);
  if (answer == Answer::none) return -1;
  contact.g1 = frame.o1;
  contact.g2 = frame.o2;
  contact.side1 = contact.side2 = -1;
  if (answer == Answer::apart) return 0;
  const BodyContactOf<Real>& found = contacts.contact();
  for (int axis = 0; axis < 3; ++axis) {
    contact.pos[axis] = found.pos[axis];
    contact.normal[axis] = found.normal[axis];
  }
  contact.depth = found.depth;
  return 1;
}

template <class Real>
int EngineOf<Real>::collide(dxGeom* o1, dxGeom* o2, int flags, void* contact, int skip) {
  auto* const contacts = static_cast<ContactGeomOf<Real>*>(contact);
  Frame<Real>* const frame = Frame<Real>::current();
  if (frame == nullptr) return ode_.collide(o1, o2, flags, contacts, skip);
  if (frame->o1 == o1 && frame->o2 == o2 && frame->record != nullptr && contact != nullptr) {
    const int count = answer_contact(*frame, flags, *contacts, skip);
    if (count >= 0) {
      ++frame->batch_contacts;
      if (options_.verify && !source_.single_precision) {
        ContactGeomOf<Real> stock;
        const int stock_count = ode_.collide(o1, o2, flags, &stock, sizeof stock);
        const auto difference = compare_contacts<Real>(
            ode_, {o1, o2}, count == 1 ? contacts : nullptr, stock_count == 1 ? &stock : nullptr);
        if (difference && parts_.differs) parts_.differs(*difference, nullptr);
      }
      return count;
    }
  }
  ++frame->stock_contacts;
  return ode_.collide(o1, o2, flags, contacts, skip);
}

/// In a world where everything moves this is called for every geom, mostly for one whose space is
/// known to have changed beyond counting: then nothing is to be noted until the space is looked at.
template <class Real>
void EngineOf<Real>::moved(dxGeom* geom) {
  const Settled& settled = last_settled();
  const bool holds =
      settled.looks == looks_.load(std::memory_order_relaxed) && settled.engine == this;
  if (holds && settled.all) return;
  dxSpace* const home = ode_.geom_get_space(geom);
  if (holds && settled.space == home) return;
  note_move(geom, home);
}

template <class Real>
void EngineOf<Real>::changing(dxGeom* geom, Change change) {
  if (open_frames == 0 || geom == nullptr) return;
  handover().before(geom, change);
}

template <class Real>
void EngineOf<Real>::note_move(dxGeom* geom, dxSpace* home) {
  if (!listens_.load(std::memory_order_relaxed)) return;
  const std::uint64_t looks = looks_.load(std::memory_order_relaxed);
  bool is_settled = open_frames == 0, is_known = false;
  for (dxSpace* space = home; space != nullptr; space = ode_.geom_get_space(geom)) {
    if (Record* record = table_.find(space)) {
      record->note_moved(geom);
      is_known = true;
      is_settled = is_settled && record->changed_widely.load(std::memory_order_relaxed);
    }
    geom = as_geom(space);
  }
  if (is_settled) last_settled() = {this, home, looks, is_known && table_.size() == 1};
}

template <class Real>
void EngineOf<Real>::filters_changed(dxGeom* geom) {
  if (table_.empty() || geom == nullptr) return;
  dxSpace* const space = ode_.geom_get_space(geom);
  if (space == nullptr) return;
  if (Record* record = table_.find(space)) record->mark_changed_with_contacts();
}

template <class Real>
void EngineOf<Real>::toggled(dxGeom* geom) {
  dxSpace* const space = ode_.geom_get_space(geom);
  if (space == nullptr) return;
  if (!table_.empty()) {
    if (Record* record = table_.find(space)) record->mark_changed();
  }
  for (Frame<Real>* frame = Frame<Real>::current(); frame != nullptr; frame = frame->outer) {
    if (frame->space == space) frame->disturbed = frame->toggled = true;
  }
}

/// The bounds of the space may have changed with its geoms: to the spaces around it it has moved.
template <class Real>
void EngineOf<Real>::added(dxSpace* space) {
  if (table_.empty() || space == nullptr) return;
  if (Record* record = table_.find(space)) record->mark_changed_with_contacts();
  if (dxSpace* const outer = ode_.geom_get_space(as_geom(space))) note_move(as_geom(space), outer);
}

/// libode's traversals of other builds go on with a geom that has been removed, or end: there the
/// call was handed over. Where locks are checked nothing is known of what they would do.
template <class Real>
void EngineOf<Real>::removed(dxSpace* space, dxGeom* geom) {
  added(space);
  if (!locks_are_checked_) return;
  for (Frame<Real>* frame = Frame<Real>::current(); frame != nullptr; frame = frame->outer) {
    if (frame->space == space) frame->forget(geom);
  }
}

template <class Real>
void EngineOf<Real>::destroying(dxGeom* geom) {
  if (geom == nullptr) return;
  // Nothing is known of what libode does when the geom at hand of such a loop is destroyed.
  if (dxSpace* const home = ode_.geom_get_space(geom); open_frames != 0 && home != nullptr) {
    handover().before_loss(home, geom);
  }
  for (Frame<Real>* frame = Frame<Real>::current(); frame != nullptr; frame = frame->outer) {
    if (as_geom(frame->space) == geom || as_geom(frame->looped) == geom) {
      frame->disturbed = frame->stopped = true;
      frame->record = nullptr;
    } else if (geom == frame->probe || ode_.geom_get_space(geom) == frame->space) {
      frame->forget(geom);
      if (geom == frame->probe) frame->probe = nullptr;
    }
  }
  if (!table_.empty() && is_space_class(kind_of(geom))) table_.erase(as_space(geom));
}

template <class Real>
void EngineOf<Real>::levels_changed(dxSpace* space) {
  added(space);
}

template <class Real>
void EngineOf<Real>::sap_created(dxSpace* space, int axis_order) {
  if (space == nullptr) return;
  SapOrder<Real> order(axis_order);
  if (!order.usable()) return;
  auto record = std::make_shared<Record>(space, geom_class::kSapSpace);
  record->sap = std::move(order);
  put(space, std::move(record));
}

template <class Real>
void EngineOf<Real>::class_created(int number, AabbTest* test) {
  const int index = number - geom_class::kFirstUser;
  if (index >= 0 && index < geom_class::kUserClasses) user_tests_[index] = test;
}

template <class Real>
void EngineOf<Real>::collider_overridden(int class1, int class2) {
  if (class1 == geom_class::kSphere && class2 == geom_class::kSphere) {
    spheres_.store(Agreement::no, std::memory_order_relaxed);
    table_.for_each([](Record& record) { record.mark_changed_with_contacts(); });
  }
}

template <class Real>
void EngineOf<Real>::lost_track() noexcept {
  table_.for_each([](Record& record) { record.mark_changed_with_contacts(); });
  count_look();
}

template <class Real>
void EngineOf<Real>::closed() {
  table_.clear();
  std::fill(std::begin(user_tests_), std::end(user_tests_), nullptr);
  spheres_.store(Agreement::unknown, std::memory_order_relaxed);
}

}  // namespace

template <class Real>
Result<std::unique_ptr<Engine>> make_engine(const LibodeOf<Real>& ode, EngineParts parts) {
  try {
    return std::unique_ptr<Engine>(std::make_unique<EngineOf<Real>>(ode, std::move(parts)));
  } catch (const std::bad_alloc&) {
    return Error{Errc::out_of_memory, "out of memory"};
  }
}

template Result<std::unique_ptr<Engine>> make_engine(const LibodeOf<float>&, EngineParts);
template Result<std::unique_ptr<Engine>> make_engine(const LibodeOf<double>&, EngineParts);

}  // namespace harpoon::ode
