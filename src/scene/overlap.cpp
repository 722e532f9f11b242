// The stateless door for boxes: checks the call, orders the boxes in float where float resolves
// them and in double otherwise, searches and writes pairs.

#include <new>

#include "base/float_environment.hpp"
#include "base/out_of_memory.hpp"
#include "broad/boxes.hpp"
#include "scene/check.hpp"
#include "scene/output.hpp"

namespace harpoon {
namespace {

/// One call.
template <class Real>
class Overlaps {
 public:
  Overlaps(Workspace::State& state, const BoundsOf<Real>& boxes, std::span<IndexPair> out,
           ContactOrder order, DetectReport& report)
      : state_(state),
        means_(state.means(boxes.count)),
        source_{boxes.first, boxes.stride_bytes, boxes.count},
        filters_(boxes.filters),
        out_(out),
        order_(order),
        report_(report) {}

  std::optional<Error> run() {
    auto done = run_in_grids<float>();
    if (done.ok() && *done == broad::BoxOrder::needs_double) done = run_in_grids<double>();
    if (!done) return done.error();
    if (*done == broad::BoxOrder::nothing) return std::nullopt;
    const bool in_trees = *done == broad::BoxOrder::needs_trees || state_.search.gave_up;
    return in_trees ? run_in_trees() : std::nullopt;
  }

 private:
  /// With one number type of culling.
  template <class Cull>
  Result<broad::BoxOrder> run_in_grids() {
    broad::OrderedBoxes<Real, Cull> ordered;
    auto done =
        broad::order_boxes(means_, source_, state_.boxes, state_.order, report_.excluded, ordered);
    if (done.ok() && *done == broad::BoxOrder::done) {
      if (auto error = find_and_write(ordered)) return *std::move(error);
    }
    return done;
  }

  std::optional<Error> run_in_trees() {
    broad::OrderedBoxes<Real, Real> ordered;
    if (auto error = broad::order_boxes_in_trees(means_, source_, state_.boxes, state_.order,
                                                 state_.trees, ordered)) {
      return error;
    }
    return find_and_write(ordered);
  }

  template <class Cull>
  std::optional<Error> find_and_write(const broad::OrderedBoxes<Real, Cull>& ordered) {
    report_.times.order_ns += watch_.lap_ns();
    const broad::SearchRule rule{broad::SearchRule::Kind::boxes, &ordered, ordered.touching_unsure};
    const scene::PairSink sink{ordered.bodies.ids, out_};
    return scene::find_and_write(state_, means_, ordered.bodies, rule, filters_, sink, order_,
                                 source_.count, watch_, report_);
  }

  Workspace::State& state_;
  broad::Means means_;
  broad::BoxSource<Real> source_;
  Filters filters_;
  std::span<IndexPair> out_;
  ContactOrder order_;
  DetectReport& report_;
  scene::StopWatch watch_;
};

template <class Real>
Result<DetectReport> run(Workspace& workspace, const BoundsOf<Real>& boxes,
                         std::span<IndexPair> out, ContactOrder order) noexcept {
  try {
    if (auto error = scene::check(boxes)) return *std::move(error);
    DetectReport report;
    if (boxes.count == 0) return report;
    const FloatEnvironment environment;
    Overlaps<Real> overlaps(workspace.state(), boxes, out, order, report);
    if (auto error = overlaps.run()) return *std::move(error);
    return scene::checked(std::move(report), out.size());
  } catch (const std::bad_alloc&) {
    return out_of_memory();
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
