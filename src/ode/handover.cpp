#include "ode/handover.hpp"

#include <algorithm>
#include <csetjmp>
#include <mutex>
#include <new>

namespace harpoon::ode {
namespace {

/// While it lives, geoms have other enabled flags than callbacks gave them.
template <class Real>
class OtherFlags {
 public:
  explicit OtherFlags(const LibodeOf<Real>& ode) : ode_(ode) {}
  ~OtherFlags() {
    for (dxGeom* geom : changed_) flip(geom);
  }
  OtherFlags(const OtherFlags&) = delete;
  OtherFlags& operator=(const OtherFlags&) = delete;

  /// Throws std::bad_alloc.
  void set(dxGeom* geom, bool enabled) {
    if ((ode_.geom_is_enabled(geom) != 0) == enabled) return;
    changed_.push_back(geom);
    flip(geom);
  }

  /// Those that all geoms of a space had when its mirror was read. Nothing else has happened to its
  /// list since. Throws std::bad_alloc.
  void set_back(dxSpace* space, const Mirror<Real>& mirror) {
    const int count = ode_.space_get_num_geoms(space);
    std::uint32_t slot = 0;
    for (int k = 0; k < count; ++k) {
      dxGeom* const geom = ode_.space_get_geom(space, k);
      while (slot < mirror.size() && mirror.geoms[slot] == nullptr) ++slot;
      const bool took_part = slot < mirror.size() && mirror.geoms[slot] == geom;
      if (took_part) ++slot;
      set(geom, took_part);
    }
  }

 private:
  void flip(dxGeom* geom) {
    (ode_.geom_is_enabled(geom) != 0 ? ode_.geom_disable : ode_.geom_enable)(geom);
  }

  const LibodeOf<Real>& ode_;
  std::vector<dxGeom*> changed_;
};

}  // namespace

namespace {

/// Whether a call of this thread walks over the space.
template <class Real>
bool is_walked_over(const dxSpace* space) {
  for (const Frame<Real>* frame = Frame<Real>::current(); frame != nullptr; frame = frame->outer) {
    if (frame->space == space) return true;
  }
  return false;
}

}  // namespace

/// Whether libode would have ended the process before the change: it looks at the space of a geom
/// whose filter changes, and at all spaces around what moves.
template <class Real>
bool Handover<Real>::ends_stock(dxGeom* geom, Change change) const {
  if (!locks_are_checked || change == Change::enabled || change == Change::disabled) return false;
  if (change == Change::filter) return is_walked_over<Real>(ode.geom_get_space(geom));
  dxSpace* around = change == Change::members ? as_space(geom) : ode.geom_get_space(geom);
  while (around != nullptr && !is_walked_over<Real>(around)) {
    around = ode.geom_get_space(as_geom(around));
  }
  return around != nullptr;
}

namespace {

/// Replays leave out what has been disabled. A space with libode's own order cannot be taken back
/// to the flags that it had at the start.
template <class Real>
bool reads_flags(const Frame<Real>& frame, Change change) {
  if (frame.live != LiveCheck::none) return change == Change::enabled;
  return frame.record != nullptr && !frame.record->mirror_valid;
}

}  // namespace

template <class Real>
bool Handover<Real>::concerns(const Frame<Real>& frame, dxGeom* geom, Change change) const {
  switch (change) {
    case Change::filter:
      return geom == frame.probe || ode.geom_get_space(geom) == frame.space;
    case Change::enabled:
    case Change::disabled:
      return ode.geom_get_space(geom) == frame.space && reads_flags(frame, change);
    case Change::moved:
    case Change::members:
      break;
  }
  if (frame.reads_filters_only) return false;
  // libode marks all spaces around what has moved.
  for (dxGeom* outer = geom; outer != nullptr; outer = as_geom(ode.geom_get_space(outer))) {
    if (outer == frame.probe || outer == as_geom(frame.space) || outer == as_geom(frame.looped)) {
      return true;
    }
  }
  return false;
}

namespace {

/// Whether a callback of the frame's own pairs is running.
template <class Real>
bool is_at_a_pair(const Frame<Real>& frame) {
  return frame.course == Course::own && frame.o1 != nullptr && !frame.stopped;
}

}  // namespace

template <class Real>
void Handover<Real>::before(dxGeom* geom, Change change) const {
  if (ends_stock(geom, change)) return;
  for (Frame<Real>* frame = Frame<Real>::current(); frame != nullptr; frame = frame->outer) {
    if (is_at_a_pair(*frame) && concerns(*frame, geom, change)) hand_over(*frame);
  }
}

/// libode's loop does not survive the loss of the geom that it stands at: that is left out here.
template <class Real>
void Handover<Real>::before_loss(const dxSpace* home, const dxGeom* geom) const {
  for (Frame<Real>* frame = Frame<Real>::current(); frame != nullptr; frame = frame->outer) {
    if (is_at_a_pair(*frame) && frame->looped == home && frame->probe != geom) hand_over(*frame);
  }
}

template <class Real>
void Handover<Real>::hand_over(Frame<Real>& frame) const {
  frame.disturbed = true;
  frame.course = Course::handing_over;
  const bool is_ours = frame.record != nullptr && frame.record->sap.has_value();
  try {
    if (is_ours ? find_rest(frame) : start_walk(frame)) {
      Statistics::add(statistics.handed_over, 1);
      return;
    }
  } catch (const std::bad_alloc&) {
    if (log) {
      log(LogLevel::error,
          "out of memory; what callbacks change is seen from the next collision on");
    }
  }
  frame.own_walk.reset();
  frame.course = Course::kept;
  frame.toggled = true;
}

/// False when libode does not come to the pair at hand: a geom of it is gone or has lost its size.
template <class Real>
bool Handover<Real>::start_walk(Frame<Real>& frame) const {
  const GeomPair pair{frame.o1, frame.o2};
  if (frame.has_begun && pair.o1 == nullptr) return false;
  frame.walk = frame.verifier != nullptr ? frame.verifier->give_walk() : nullptr;
  if (frame.walk == nullptr) {
    frame.own_walk.emplace(frame.stock, std::move(frame.stack));
    frame.walk = &*frame.own_walk;
  }
  if (frame.has_begun && frame.own_walk) {
    // On its way to the pair at hand libode is to see the flags that it saw the first time.
    OtherFlags<Real> flags(ode);
    if (frame.live == LiveCheck::none && frame.record->mirror_valid) {
      flags.set_back(frame.space, frame.record->mirror);
    }
    flags.set(pair.o1, true);
    flags.set(pair.o2, true);
    if (!frame.walk->skip_to(pair)) return false;
  }
  frame.course = Course::stock;
  frame.record = nullptr;
  if (frame.origin != nullptr) frame.origin->note_handover();
  return true;
}

template <class Real>
bool Handover<Real>::find_rest(Frame<Real>& frame) const {
  const SpaceRecord<Real>& record = *frame.record;
  Mirror<Real> open = record.mirror;
  open.drop_filters();
  SapOrder<Real> order = *record.sap;
  Result<PairSearch<Real>> search = PairSearch<Real>::make();
  if (!search || !search->find_sap(open, order, frame.rest)) throw std::bad_alloc();
  const IndexPair at_hand = record.pairs[frame.number];
  const auto found = std::find_if(frame.rest.begin(), frame.rest.end(), [&](const IndexPair& pair) {
    return pair.g1 == at_hand.g1 && pair.g2 == at_hand.g2;
  });
  if (found == frame.rest.end()) return false;
  frame.rest.erase(frame.rest.begin(), found + 1);
  frame.course = Course::filtered;
  return true;
}

namespace {

/// One trial of libode's lock. Its handler may not return, so it jumps back into the callback.
template <class Real>
struct LockTrial {
  const LibodeOf<Real>& ode;
  bool refused = false;
  std::jmp_buf callback = {};

  static LockTrial*& current() {
    static thread_local LockTrial* trial = nullptr;
    return trial;
  }
  static void refuse(int, const char*, va_list) {
    current()->refused = true;
    std::longjmp(current()->callback, 1);
  }
  static void near(void* trial, dxGeom* o1, dxGeom*) {
    LockTrial& self = *static_cast<LockTrial*>(trial);
    if (setjmp(self.callback) == 0) self.ode.geom_set_category_bits(o1, ~0UL);
  }
};

}  // namespace

template <class Real>
bool checks_locks(const LibodeOf<Real>& ode) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  dxSpace* const space = ode.simple_space_create(nullptr);
  for (int k = 0; k < 2; ++k) (void)ode.create_sphere(space, Real(1));
  LockTrial<Real> trial{ode};
  LockTrial<Real>::current() = &trial;
  MessageFunction* const handler = ode.get_debug_handler();
  ode.set_debug_handler(&LockTrial<Real>::refuse);
  ode.space_collide(space, &trial, &LockTrial<Real>::near);
  ode.set_debug_handler(handler);
  ode.geom_destroy(as_geom(space));
  return trial.refused;
}

template struct Handover<float>;
template struct Handover<double>;
template bool checks_locks(const LibodeOf<float>&);
template bool checks_locks(const LibodeOf<double>&);

}  // namespace harpoon::ode
