// The stateless door for spheres: checks the call, then survey -> plan -> order -> search ->
// output.

#include <new>

#include "base/float_environment.hpp"
#include "base/out_of_memory.hpp"
#include "scene/check.hpp"
#include "scene/output.hpp"

namespace harpoon {
namespace {

using broad::Candidates;

/// Where a sink gets its bodies from, in sorted order.
template <class Real>
struct Sorted {
  const broad::Kernels<Real>& kernels;
  const SphereOf<Real>* spheres;
  const std::uint32_t* ids;
};

/// Contacts as the output.
template <class Real>
struct ContactSink {
  Sorted<Real> from;
  std::span<BodyContactOf<Real>> out;

  [[nodiscard]] std::uint64_t capacity() const noexcept { return out.size(); }
  void write(const Candidates& list, std::size_t begin, std::size_t end,
             std::size_t at) const noexcept {
    from.kernels.contacts(from.spheres, from.ids, list, begin, end, out.data() + at);
  }
};

/// No output: a count.
struct CountSink {
  [[nodiscard]] static std::uint64_t capacity() noexcept { return 0; }
  static void write(const Candidates&, std::size_t, std::size_t, std::size_t) noexcept {}
};

template <class Real>
ContactSink<Real> sink_of(const Sorted<Real>& from, std::span<BodyContactOf<Real>> out) {
  return {from, out};
}
template <class Real>
scene::PairSink sink_of(const Sorted<Real>& from, std::span<IndexPair> out) {
  return {from.ids, out};
}
struct Nothing {
  static std::size_t size() { return 0; }
};
template <class Real>
CountSink sink_of(const Sorted<Real>&, Nothing) {
  return {};
}

/// One call.
template <class Real, class Output>
class Detection {
 public:
  Detection(Workspace::State& state, const BodiesOf<Real>& bodies, Output out, ContactOrder order)
      : state_(state),
        means_(state.means(bodies.count)),
        source_{bodies.x, bodies.y, bodies.z, bodies.r, bodies.stride_bytes, bodies.count},
        filters_(bodies.filters),
        out_(out),
        order_(order) {}

  std::optional<Error> run(DetectReport& report) {
    if (source_.count == 0) return std::nullopt;
    broad::Survey<Real> survey;
    if (auto error = broad::survey(means_, source_, 0, report.excluded, survey)) return error;
    if (survey.census.bodies + survey.giants.size() == 0) return std::nullopt;
    const broad::Plan plan = broad::make_plan(survey.census);
    report.times.survey_ns = watch_.lap_ns();
    if (plan.in_trees) return run_in_trees(report);
    if (auto error = plan.cull_double ? run_in_grids<double>(survey, plan, report)
                                      : run_in_grids<float>(survey, plan, report)) {
      return error;
    }
    return state_.search.gave_up ? run_in_trees(report) : std::nullopt;
  }

 private:
  template <class Cull>
  std::optional<Error> run_in_grids(const broad::Survey<Real>& survey, const broad::Plan& plan,
                                    DetectReport& report) {
    broad::Ordered<Real, Cull> bodies;
    bodies.scanned = survey.giants.size();
    if (auto error = broad::order(means_, source_, survey, plan, state_.order, bodies)) {
      return error;
    }
    broad::place_giants(means_, source_, survey, plan, state_.order, bodies);
    return find_and_write(bodies, report);
  }

  std::optional<Error> run_in_trees(DetectReport& report) {
    broad::Ordered<Real, Real> bodies;
    if (auto error =
            broad::order_in_trees(means_, source_, 0, state_.order, state_.trees, bodies)) {
      return error;
    }
    return find_and_write(bodies, report);
  }

  template <class Cull>
  std::optional<Error> find_and_write(const broad::Ordered<Real, Cull>& bodies,
                                      DetectReport& report) {
    report.times.order_ns += watch_.lap_ns();
    const Sorted<Real> from{means_.kernels->of<Real>(), bodies.spheres, bodies.ids};
    return scene::find_and_write(state_, means_, bodies, {}, filters_, sink_of(from, out_), order_,
                                 source_.count, watch_, report);
  }

  Workspace::State& state_;
  broad::Means means_;
  broad::Source<Real> source_;
  Filters filters_;
  Output out_;
  ContactOrder order_;
  scene::StopWatch watch_;
};

template <class Real, class Output>
Result<DetectReport> run(Workspace& workspace, const BodiesOf<Real>& bodies, Output out,
                         ContactOrder order, bool count_only = false) noexcept {
  try {
    if (auto error = scene::check(bodies)) return *std::move(error);
    const FloatEnvironment environment;
    DetectReport report;
    Detection<Real, Output> detection(workspace.state(), bodies, out, order);
    if (auto error = detection.run(report)) return *std::move(error);
    return count_only ? report : scene::checked(std::move(report), out.size());
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

template <class Real>
Result<DetectReport> detect_once(const BodiesOf<Real>& bodies, std::span<BodyContactOf<Real>> out,
                                 ContactOrder order, const WorkspaceOptions& options) noexcept {
  Result<Workspace> workspace = Workspace::make(options);
  if (!workspace) return workspace.error();
  return run(*workspace, bodies, out, order);
}

}  // namespace

Result<DetectReport> detect(Workspace& workspace, const Bodies& bodies, std::span<BodyContact> out,
                            ContactOrder order) noexcept {
  return run(workspace, bodies, out, order);
}
Result<DetectReport> detect(Workspace& workspace, const BodiesF64& bodies,
                            std::span<BodyContactF64> out, ContactOrder order) noexcept {
  return run(workspace, bodies, out, order);
}

Result<DetectReport> detect(const Bodies& bodies, std::span<BodyContact> out, ContactOrder order,
                            const WorkspaceOptions& options) noexcept {
  return detect_once(bodies, out, order, options);
}
Result<DetectReport> detect(const BodiesF64& bodies, std::span<BodyContactF64> out,
                            ContactOrder order, const WorkspaceOptions& options) noexcept {
  return detect_once(bodies, out, order, options);
}

Result<DetectReport> detect_pairs(Workspace& workspace, const Bodies& bodies,
                                  std::span<IndexPair> out, ContactOrder order) noexcept {
  return run(workspace, bodies, out, order);
}
Result<DetectReport> detect_pairs(Workspace& workspace, const BodiesF64& bodies,
                                  std::span<IndexPair> out, ContactOrder order) noexcept {
  return run(workspace, bodies, out, order);
}

Result<DetectReport> count_contacts(Workspace& workspace, const Bodies& bodies) noexcept {
  return run(workspace, bodies, Nothing{}, ContactOrder::space, true);
}
Result<DetectReport> count_contacts(Workspace& workspace, const BodiesF64& bodies) noexcept {
  return run(workspace, bodies, Nothing{}, ContactOrder::space, true);
}

}  // namespace harpoon
