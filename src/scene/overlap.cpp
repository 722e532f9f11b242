// The stateless door for boxes: checks the call, orders the boxes in float where float resolves
// them and in double otherwise, searches and writes pairs.

#include <new>

#include "base/float_environment.hpp"
#include "scene/boxes.hpp"
#include "scene/check.hpp"
#include "scene/output.hpp"

namespace harpoon {
namespace {

/// The call with one number type of culling. True when it was done, false when it has to be double.
template <class Cull, class Real>
Result<bool> run_in(Workspace::State& state, const BoundsOf<Real>& boxes, std::span<IndexPair> out,
                    ContactOrder order, DetectReport& report) {
  scene::StopWatch watch;
  const scene::Means means = state.means(boxes.count);
  scene::OrderedBoxes<Real, Cull> ordered;
  const auto done = scene::order_boxes(
      means, scene::BoxSource<Real>{boxes.first, boxes.stride_bytes, boxes.count}, state.boxes,
      state.order, report.excluded, ordered);
  if (!done) return done.error();
  if (*done != scene::BoxOrder::done) return *done == scene::BoxOrder::nothing;
  report.times.order_ns = watch.lap_ns();
  const scene::SearchRule rule{scene::SearchRule::Kind::boxes, &ordered, ordered.touching_unsure};
  const scene::PairSink sink{ordered.bodies.ids, out};
  if (auto error = scene::find_and_write(state, means, ordered.bodies, rule, boxes.filters, sink,
                                         order, boxes.count, watch, report)) {
    return *std::move(error);
  }
  return true;
}

template <class Real>
Result<DetectReport> run(Workspace& workspace, const BoundsOf<Real>& boxes,
                         std::span<IndexPair> out, ContactOrder order) noexcept {
  try {
    if (auto error = scene::check(boxes)) return *std::move(error);
    DetectReport report;
    if (boxes.count == 0) return report;
    const FloatEnvironment environment;
    auto done = run_in<float>(workspace.state(), boxes, out, order, report);
    if (done.ok() && !*done) done = run_in<double>(workspace.state(), boxes, out, order, report);
    if (!done) return done.error();
    return scene::checked(std::move(report), out.size());
  } catch (const std::bad_alloc&) {
    return Error{Errc::out_of_memory, "out of memory"};
  }
}

}  // namespace

Result<DetectReport> overlap_pairs(Workspace& workspace, const Bounds& boxes,
                                   std::span<IndexPair> out, ContactOrder order) noexcept {
  return run(workspace, boxes, out, order);
}
Result<DetectReport> overlap_pairs(Workspace& workspace, const BoundsF64& boxes,
                                   std::span<IndexPair> out, ContactOrder order) noexcept {
  return run(workspace, boxes, out, order);
}

}  // namespace harpoon
