#include "ode/engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <unordered_map>
#include <utility>

#include "ode/float_mode.hpp"
#include "ode/frame.hpp"
#include "ode/refresher.hpp"
#include "ode/replay.hpp"
#include "ode/scan.hpp"
#include "ode/space_table.hpp"
#include "ode/verify.hpp"

namespace harpoon::ode {
namespace {

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

  static void near(void* recorder, dxGeom* o1, dxGeom* o2) {
    Recorder& self = *static_cast<Recorder*>(recorder);
    self.pairs.push_back({o1, o2});
    self.callback(self.data, o1, o2);
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

  void moved(dxGeom* geom) override;
  void filters_changed(dxGeom* geom) override;
  void toggled(dxGeom* geom, bool enabled) override;
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
  void expect_frames();
  void note_changes(Record& record) {
    count_look();
    refresher_.note_changes(record);
  }
  void intern_recorded(Record& record) const;
  [[nodiscard]] bool answer_in_order(Record& record, void* data, NearCallback* callback);
  void record_or_replay(Record& record, void* data, NearCallback* callback);
  void replay_record(Record& record, LiveCheck live, void* data, NearCallback* callback);
  void verify_pairs(const Record& record);
  [[nodiscard]] bool answer_scan(dxSpace* scanned, dxGeom* other, bool scanned_first, void* data,
                                 NearCallback* callback);
  [[nodiscard]] std::optional<std::vector<GeomPair>> scan(dxSpace* scanned, dxGeom* other,
                                                          bool scanned_first);
  void verify_scan(dxSpace* scanned, std::span<const GeomPair> pairs, const Rerun& rerun);
  [[nodiscard]] bool answer_spaces(dxSpace* space1, dxSpace* space2, void* data,
                                   NearCallback* callback);
  [[nodiscard]] std::vector<dxGeom*> list_of(dxSpace* space) const;
  /// A quadtree's blocks are libode's secret.
  [[nodiscard]] bool can_scan(dxSpace* space) const {
    return kind_of(as_geom(space)) != geom_class::kQuadtreeSpace;
  }
  /// In all others libode's list is not the order that it gives geoms out in.
  [[nodiscard]] bool can_list(dxSpace* space) const {
    const int kind = kind_of(as_geom(space));
    return kind == geom_class::kSimpleSpace || kind == geom_class::kHashSpace;
  }
  void stock_scan(dxSpace* scanned, dxGeom* other, bool scanned_first, void* data,
                  NearCallback* callback) const {
    dxGeom* const space = as_geom(scanned);
    ++hand_overs;
    ode_.space_collide2(scanned_first ? space : other, scanned_first ? other : space, data,
                        callback);
  }
  [[nodiscard]] bool spheres_are_ours();
  [[nodiscard]] bool is_as_mirrored(const Mirror<Real>& mirror, IndexPair pair) const;
  int answer_contact(Frame<Real>& frame, int flags, ContactGeomOf<Real>& contact, int skip);
  void leave_to_stock(dxSpace* space, void* data, NearCallback* callback) {
    // Small spaces come this way, whose calls are so short that counting them shows.
    if (options_.statistics) Statistics::add(statistics_.left_to_stock, 1);
    ++hand_overs;
    ode_.space_collide(space, data, callback);
  }
  void warn(const std::string& line) const {
    if (parts_.log) parts_.log(LogLevel::warning, line);
  }

  const LibodeOf<Real> ode_;
  EngineParts parts_;
  const Options& options_;
  Statistics statistics_;
  SpaceTable<Record> table_;
  std::atomic<bool> expects_frames_{false};
  std::atomic<std::uint64_t> looks_{1};  ///< how often what is known of spaces has been renewed
  UserTests user_tests_{};
  const Refresher<Real> refresher_{ode_, options_, user_tests_, parts_.log, statistics_};
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

template <class Real>
SpaceRecord<Real>* EngineOf<Real>::find_or_make(dxSpace* space, int kind) {
  Record* record = table_.empty() ? nullptr : table_.find(space);
  if (record != nullptr && record->kind == kind) return record;
  return put(space, std::make_shared<Record>(space, kind));
}

template <class Real>
SpaceRecord<Real>* EngineOf<Real>::put(dxSpace* space, std::shared_ptr<Record> record) {
  Statistics::add(statistics_.spaces, 1);
  if (table_.empty() && parts_.before_first_space) parts_.before_first_space();
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

template <class Real>
void EngineOf<Real>::verify_pairs(const Record& record) {
  // Where stock aborts or pairs were added to stock's there is nothing to compare with.
  if (record.found.stock_aborts ||
      (options_.policy == Policy::fixed && record.found.missed_by_stock != 0)) {
    return;
  }
  std::vector<GeomPair> stock, ours;
  ode_.space_collide(record.space, &stock, &note_pair);
  const bool asks = (record.mirror.all_traits & kHasAabbTest) != 0;
  const Replayer<Real> replayer{ode_, user_tests_, nullptr, nullptr};
  for (const auto& pair : record.pairs) {
    if (asks && !replayer.is_near(record, pair)) continue;
    ours.push_back({record.mirror.geoms[pair.g1], record.mirror.geoms[pair.g2]});
  }
  Statistics::add(statistics_.verified_pairs, stock.size());
  if (const auto difference = compare_pairs<Real>(ode_, record, ours, stock);
      difference && parts_.differs) {
    if (record.kind == geom_class::kQuadtreeSpace || !record.mirror_valid) {
      parts_.differs(*difference, nullptr);
      return;
    }
    CollisionFrame frame = frame_of<Real>(ode_, record, options_.policy, stock);
    frame.difference = *difference;
    parts_.differs(*difference, &frame);
  }
}

template <class Real>
void EngineOf<Real>::replay_record(Record& record, LiveCheck live, void* data,
                                   NearCallback* callback) {
  const std::shared_ptr<Record> alive = table_.hold(record.space);
  Statistics::add(statistics_.pairs, record.pairs.size());
  record.contacts.rewind(record.was_unchanged);
  expect_frames();
  Frame<Real> frame(record.space);
  frame.default_rules = computes_by_default_rules();
  Replayer<Real>{ode_, user_tests_, data, callback}.replay(
      frame, record, live,
      [&](void* d, NearCallback* c) { ode_.space_collide(record.space, d, c); });
  Statistics::add(statistics_.batch_contacts, frame.batch_contacts);
  Statistics::add(statistics_.stock_contacts, frame.stock_contacts);
}

/// Simple, hash and SAP. False when the call is libode's.
template <class Real>
bool EngineOf<Real>::answer_in_order(Record& record, void* data, NearCallback* callback) {
  const Entry entry(record);
  if (!entry.entered()) return false;
  if (entry.alone()) {
    note_changes(record);
    try {
      if (!refresher_.refresh_pairs(record)) return false;
    } catch (const std::bad_alloc&) {
      warn("out of memory; the call is left to libode");
      return false;
    }
    if (options_.verify) verify_pairs(record);
  } else if (record.changed.load(std::memory_order_relaxed) || !record.pairs_valid) {
    return false;
  }
  ++record.calls;
  record.pairs_used = true;
  const LiveCheck live =
      record.kind == geom_class::kSimpleSpace ? LiveCheck::rows : LiveCheck::none;
  replay_record(record, live, data, callback);
  return true;
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
    if (is_new) mirror.append_for_contacts(ode_, geom, user_tests_);
    return place->second;
  };
  for (const auto& [o1, o2] : record.recorded) {
    const std::uint32_t first = place_of(o1);
    record.pairs.push_back({first, place_of(o2)});
  }
  record.pairs_valid = true;
}

/// Quadtree spaces and SAP spaces whose creation nobody saw: recorded when nothing has changed
/// since the call before, replayed when nothing has since then.
template <class Real>
void EngineOf<Real>::record_or_replay(Record& record, void* data, NearCallback* callback) {
  const Entry entry(record);
  if (!entry.entered() || !entry.alone()) {
    leave_to_stock(record.space, data, callback);
    return;
  }
  note_changes(record);
  ++record.calls;
  if (record.recorded_valid && !record.pairs_valid) intern_recorded(record);
  // What a user class answers may change without notice.
  if (record.recorded_valid && (record.mirror.all_traits & kHasAabbTest) == 0) {
    Statistics::add(statistics_.unchanged, 1);
    if (options_.verify) verify_pairs(record);
    replay_record(record,
                  record.kind == geom_class::kQuadtreeSpace ? LiveCheck::rows : LiveCheck::none,
                  data, callback);
    return;
  }
  if (!record.was_unchanged) {
    leave_to_stock(record.space, data, callback);
    return;
  }
  Statistics::add(statistics_.recorded, 1);
  record.recorded.clear();
  Recorder recorder{record.recorded, data, callback};
  ++hand_overs;
  ode_.space_collide(record.space, &recorder, &Recorder::near);
  record.recorded_valid = !record.changed.load(std::memory_order_relaxed);
  Statistics::add(statistics_.pairs, record.recorded.size());
}

template <class Real>
void EngineOf<Real>::space_collide(dxSpace* space, void* data, NearCallback* callback) {
  if (space == nullptr || callback == nullptr) {
    ++hand_overs;
    ode_.space_collide(space, data, callback);
    return;
  }
  const Stopwatch stopwatch(options_.statistics, statistics_.inside_ns);
  const int kind = kind_of(as_geom(space));
  Record* record = kind == geom_class::kSapSpace && !table_.empty() ? table_.find(space) : nullptr;
  const bool follows_sap = record != nullptr && record->sap.has_value();
  if (!is_space_class(kind) || ((!follows_sap || !record->sap_is_ours) &&
                                ode_.space_get_num_geoms(space) < min_geoms(kind))) {
    leave_to_stock(space, data, callback);
    return;
  }
  if (record == nullptr) record = find_or_make(space, kind);
  if (kind == geom_class::kQuadtreeSpace || (kind == geom_class::kSapSpace && !follows_sap)) {
    record_or_replay(*record, data, callback);
  } else if (!answer_in_order(*record, data, callback)) {
    record->mark_changed();
    leave_to_stock(space, data, callback);
  }
}

/// One geom against a space. Nothing when the call is libode's.
template <class Real>
std::optional<std::vector<GeomPair>> EngineOf<Real>::scan(dxSpace* scanned, dxGeom* other,
                                                          bool scanned_first) {
  const int kind = kind_of(as_geom(scanned)), other_kind = kind_of(other);
  if (other_kind >= geom_class::kFirstUser &&
      user_tests_[other_kind - geom_class::kFirstUser] != nullptr) {
    return std::nullopt;
  }
  Record& record = *find_or_make(scanned, kind);
  const Entry entry(record);
  if (!entry.entered()) return std::nullopt;
  if (entry.alone()) {
    note_changes(record);
    refresher_.refresh_mirror(record, false);
  } else if (record.changed.load(std::memory_order_relaxed) || !record.mirror_valid) {
    return std::nullopt;
  }
  if ((record.mirror.all_traits & kHasAabbTest) != 0) return std::nullopt;
  std::vector<GeomPair> pairs;
  append_scan(record.mirror, Probe<Real>(ode_, other), scanned_first, pairs);
  return pairs;
}

/// Compares a scan with stock's.
template <class Real>
void EngineOf<Real>::verify_scan(dxSpace* scanned, std::span<const GeomPair> pairs,
                                 const Rerun& rerun) {
  std::vector<GeomPair> stock;
  rerun(&stock, &note_pair);
  Statistics::add(statistics_.verified_pairs, stock.size());
  const std::shared_ptr<Record> record = table_.hold(scanned);
  const auto difference = compare_pairs<Real>(ode_, *record, pairs, stock);
  if (difference && parts_.differs) parts_.differs("dSpaceCollide2: " + *difference, nullptr);
}

template <class Real>
bool EngineOf<Real>::answer_scan(dxSpace* scanned, dxGeom* other, bool scanned_first, void* data,
                                 NearCallback* callback) {
  const Rerun rerun = [&](void* d, NearCallback* c) {
    stock_scan(scanned, other, scanned_first, d, c);
  };
  std::optional<std::vector<GeomPair>> pairs;
  try {
    pairs = scan(scanned, other, scanned_first);
  } catch (const std::bad_alloc&) {
    warn("out of memory; the call is left to libode");
  }
  if (!pairs) return false;
  if (options_.verify) verify_scan(scanned, *pairs, rerun);
  Statistics::add(statistics_.pairs, pairs->size());
  if (pairs->empty()) return true;
  expect_frames();
  Frame<Real> frame(scanned);
  Replayer<Real>{ode_, user_tests_, data, callback}.replay(
      frame, *pairs, scanned_first ? LiveCheck::first : LiveCheck::second, rerun);
  Statistics::add(statistics_.stock_contacts, frame.stock_contacts);
  return true;
}

/// The geoms of a simple or hash space in the order in which libode walks over them.
template <class Real>
std::vector<dxGeom*> EngineOf<Real>::list_of(dxSpace* space) const {
  std::vector<dxGeom*> geoms(static_cast<std::size_t>(ode_.space_get_num_geoms(space)));
  for (std::size_t k = 0; k < geoms.size(); ++k) {
    geoms[k] = ode_.space_get_geom(space, static_cast<int>(k));
  }
  return geoms;
}

/// libode's loop over the space that has fewer geoms, each of which is compared with the other
/// space. The looped space is not locked meanwhile: where callbacks change its list, libode goes on
/// behind the geom at hand, wherever that is then. False when the call is libode's.
template <class Real>
bool EngineOf<Real>::answer_spaces(dxSpace* space1, dxSpace* space2, void* data,
                                   NearCallback* callback) {
  const int count1 = ode_.space_get_num_geoms(space1), count2 = ode_.space_get_num_geoms(space2);
  dxSpace* const looped = count1 < count2 ? space1 : space2;
  dxSpace* const scanned = looped == space1 ? space2 : space1;
  if (std::max(count1, count2) < options_.min_geoms_scan || !can_scan(scanned) ||
      !can_list(looped)) {
    return false;
  }
  const bool scanned_first = scanned == space1;
  try {
    std::vector<dxGeom*> geoms = list_of(looped);
    // dSpaceCollide2 would not take a space for a geom where the call has to be left to it.
    if (std::any_of(geoms.begin(), geoms.end(),
                    [&](dxGeom* geom) { return is_space_class(kind_of(geom)); })) {
      return false;
    }
    (void)find_or_make(looped, kind_of(as_geom(looped)));
    const std::shared_ptr<Record> list = table_.hold(looped);
    for (std::size_t k = 0; k < geoms.size();) {
      dxGeom* const geom = geoms[k];
      const std::uint64_t version = list->version.load(std::memory_order_relaxed);
      count_look();
      if (!answer_scan(scanned, geom, scanned_first, data, callback)) {
        stock_scan(scanned, geom, scanned_first, data, callback);
      }
      ++k;
      if (list->version.load(std::memory_order_relaxed) == version) continue;
      if (table_.hold(looped) != list) break;
      geoms = list_of(looped);
      const auto at = std::find(geoms.begin(), geoms.end(), geom);
      k = at == geoms.end() ? geoms.size() : static_cast<std::size_t>(at - geoms.begin()) + 1;
    }
  } catch (const std::bad_alloc&) {
    if (parts_.log) parts_.log(LogLevel::error, "out of memory; pairs of two spaces are missing");
  }
  return true;
}

template <class Real>
void EngineOf<Real>::space_collide2(dxGeom* o1, dxGeom* o2, void* data, NearCallback* callback) {
  if (o1 == nullptr || o2 == nullptr || callback == nullptr) {
    ++hand_overs;
    ode_.space_collide2(o1, o2, data, callback);
    return;
  }
  const Stopwatch stopwatch(options_.statistics, statistics_.inside_ns);
  dxSpace* space1 = is_space_class(kind_of(o1)) ? as_space(o1) : nullptr;
  dxSpace* space2 = is_space_class(kind_of(o2)) ? as_space(o2) : nullptr;
  if (space1 != nullptr && space1 == space2) {
    space_collide(space1, data, callback);
    return;
  }
  const bool are_spaces = space1 != nullptr && space2 != nullptr;
  if (are_spaces) {
    const int level1 = ode_.space_get_sublevel(space1), level2 = ode_.space_get_sublevel(space2);
    if (level1 > level2) space2 = nullptr;
    if (level1 < level2) space1 = nullptr;
  }
  bool answered = false;
  if (space1 != nullptr && space2 != nullptr) {
    answered = answer_spaces(space1, space2, data, callback);
    if (answered) Statistics::add(statistics_.scanned_spaces, 1);
  } else if (dxSpace* const scanned = space1 != nullptr ? space1 : space2;
             scanned != nullptr && ode_.space_get_num_geoms(scanned) >= options_.min_geoms_scan &&
             can_scan(scanned)) {
    answered = answer_scan(scanned, space1 != nullptr ? o2 : o1, space1 != nullptr, data, callback);
  }
  Statistics::add(answered ? statistics_.scanned : statistics_.left_to_stock, 1);
  if (answered) return;
  ++hand_overs;
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
    const Real* const at = ode_.geom_get_position(geom);
    const SphereOf<Real>& sphere = mirror.spheres[slot];
    if (at[0] != sphere.x || at[1] != sphere.y || at[2] != sphere.z ||
        ode_.sphere_get_radius(geom) != sphere.r ||
        ode_.geom_get_body(geom) != mirror.bodies[slot]) {
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
    if (!record.mirror.are_spheres(record.pairs[frame.number]) || !spheres_are_ours()) return -1;
    contacts.load(source_, record.mirror, record.pairs, frame.number);
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
  dxSpace* const home = ode_.geom_get_space(geom);
  if (settled.space == home && settled.looks == looks_.load(std::memory_order_relaxed) &&
      settled.engine == this) {
    return;
  }
  note_move(geom, home);
}

template <class Real>
void EngineOf<Real>::note_move(dxGeom* geom, dxSpace* home) {
  const std::uint64_t looks = looks_.load(std::memory_order_relaxed);
  bool is_settled = open_frames == 0;
  for (dxSpace* space = home; space != nullptr; space = ode_.geom_get_space(geom)) {
    if (Record* record = table_.find(space)) {
      record->note_moved(geom);
      is_settled = is_settled && record->changed_widely.load(std::memory_order_relaxed);
    }
    geom = as_geom(space);
  }
  if (is_settled) last_settled() = {this, home, looks};
}

template <class Real>
void EngineOf<Real>::filters_changed(dxGeom* geom) {
  if (table_.empty() || geom == nullptr) return;
  dxSpace* const space = ode_.geom_get_space(geom);
  if (space == nullptr) return;
  if (Record* record = table_.find(space)) record->mark_changed_with_contacts();
}

template <class Real>
void EngineOf<Real>::toggled(dxGeom* geom, bool enabled) {
  dxSpace* const space = ode_.geom_get_space(geom);
  if (space == nullptr) return;
  if (!table_.empty()) {
    if (Record* record = table_.find(space)) record->mark_changed();
  }
  for (Frame<Real>* frame = Frame<Real>::current(); frame != nullptr; frame = frame->outer) {
    if (frame->space != space) continue;
    frame->disturbed = frame->toggled = true;
    frame->awakened = frame->awakened || enabled;
  }
}

/// The bounds of the space may have changed with its geoms: to the spaces around it it has moved.
template <class Real>
void EngineOf<Real>::added(dxSpace* space) {
  if (table_.empty() || space == nullptr) return;
  if (Record* record = table_.find(space)) record->mark_changed_with_contacts();
  if (dxSpace* const outer = ode_.geom_get_space(as_geom(space))) note_move(as_geom(space), outer);
}

template <class Real>
void EngineOf<Real>::removed(dxSpace* space, dxGeom* geom) {
  added(space);
  for (Frame<Real>* frame = Frame<Real>::current(); frame != nullptr; frame = frame->outer) {
    if (frame->space != space) continue;
    frame->disturbed = true;
    frame->gone.push_back(geom);
  }
}

template <class Real>
void EngineOf<Real>::destroying(dxGeom* geom) {
  if (geom == nullptr) return;
  for (Frame<Real>* frame = Frame<Real>::current(); frame != nullptr; frame = frame->outer) {
    const bool is_space = as_geom(frame->space) == geom;
    // All geoms of a record's pairs are in its space; those of dSpaceCollide2 may be anywhere.
    if (frame->record != nullptr && !is_space && ode_.geom_get_space(geom) != frame->space)
      continue;
    frame->disturbed = true;
    frame->gone.push_back(geom);
    if (is_space) {
      frame->stopped = true;
      frame->record = nullptr;
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
  // A geom that is gone may be in what they have yet to replay.
  for (Frame<Real>* frame = Frame<Real>::current(); frame != nullptr; frame = frame->outer) {
    frame->disturbed = frame->stopped = true;
  }
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
