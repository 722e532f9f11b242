// The stateless door: checks the call, then survey -> plan -> order -> search -> output.

#include <fmt/format.h>

#include <chrono>
#include <cstring>
#include <new>
#include <type_traits>

#include "base/float_environment.hpp"
#include "scene/check.hpp"
#include "scene/id_order.hpp"
#include "scene/workspace.hpp"

namespace harpoon {
namespace {

using scene::Candidates;

class StopWatch {
 public:
  double lap_ns() noexcept {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double, std::nano> lap = now - last_;
    last_ = now;
    return lap.count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Contacts as the output.
template <class Real>
class ContactSink {
 public:
  explicit ContactSink(std::span<BodyContactOf<Real>> out) noexcept : out_(out) {}
  [[nodiscard]] std::uint64_t capacity() const noexcept { return out_.size(); }

  std::size_t write(const scene::Kernels<Real>& kernels, const SphereOf<Real>* spheres,
                    const std::uint32_t* ids, Candidates& list, std::size_t begin, std::size_t end,
                    std::size_t at) const noexcept {
    return kernels.contacts(spheres, ids, list, begin, end, out_.data() + at);
  }
  void move(std::size_t from, std::size_t count, std::size_t to) const noexcept {
    std::memmove(static_cast<void*>(out_.data() + to), out_.data() + from,
                 count * sizeof(BodyContactOf<Real>));
  }

 private:
  std::span<BodyContactOf<Real>> out_;
};

/// Pairs as the output.
template <class Real>
class PairSink {
 public:
  explicit PairSink(std::span<IndexPair> out) noexcept : out_(out) {}
  [[nodiscard]] std::uint64_t capacity() const noexcept { return out_.size(); }

  std::size_t write(const scene::Kernels<Real>& kernels, const SphereOf<Real>* spheres,
                    const std::uint32_t* ids, Candidates& list, std::size_t begin, std::size_t end,
                    std::size_t at) const noexcept {
    Candidates part = list;
    part.count = end;
    kernels.keep_hits(spheres, ids, begin, part);
    for (std::size_t p = begin; p < part.count; ++p) {
      const std::uint32_t a = ids[list.i[p]];
      const std::uint32_t b = ids[list.j[p]];
      out_[at + p - begin] = {std::min(a, b), std::max(a, b)};
    }
    return part.count - begin;
  }
  void move(std::size_t from, std::size_t count, std::size_t to) const noexcept {
    std::memmove(out_.data() + to, out_.data() + from, count * sizeof(IndexPair));
  }

 private:
  std::span<IndexPair> out_;
};

/// No output: a count.
template <class Real>
struct CountSink {
  [[nodiscard]] std::uint64_t capacity() const noexcept { return 0; }
  std::size_t write(const scene::Kernels<Real>&, const SphereOf<Real>*, const std::uint32_t*,
                    Candidates&, std::size_t, std::size_t, std::size_t) const noexcept {
    return 0;
  }
  void move(std::size_t, std::size_t, std::size_t) const noexcept {}
};

/// Writes the candidates of `lists` that touch, one list after the other. Returns their number.
template <class Real, class Cull, class Sink>
std::optional<Error> write_lists(const scene::Means& means,
                                 const scene::Ordered<Real, Cull>& bodies,
                                 std::span<scene::TaskList> lists, const Sink& sink,
                                 std::uint64_t& written) {
  const auto& kernels = means.kernels->of<Real>();
  const auto write = [&](scene::TaskList& task, std::size_t at) {
    return sink.write(kernels, bodies.spheres, bodies.ids, task.list, 0, task.list.count, at);
  };
  if (lists.size() == 1) {
    written = write(lists[0], 0);
    return std::nullopt;
  }
  std::vector<std::size_t> starts(lists.size());
  std::vector<std::size_t> counts(lists.size());
  for (std::size_t t = 1; t < lists.size(); ++t) {
    starts[t] = starts[t - 1] + lists[t - 1].list.count;
  }
  if (auto error =
          means.run(lists.size(), [&](std::size_t t) { counts[t] = write(lists[t], starts[t]); })) {
    return error;
  }
  written = 0;
  for (std::size_t t = 0; t < lists.size(); ++t) {
    if (written != starts[t] && counts[t] != 0) sink.move(starts[t], counts[t], written);
    written += counts[t];
  }
  return std::nullopt;
}

/// The stages after the plan, for one number type of culling.
template <class Real, class Cull, class Sink>
std::optional<Error> run_planned(Workspace::State& state, const scene::Means& means,
                                 const scene::Source<Real>& source,
                                 const scene::Survey<Real>& survey, const scene::Plan& plan,
                                 const Filters& filters, const Sink& sink, ContactOrder order,
                                 StopWatch& watch, DetectReport& report) {
  scene::Ordered<Real, Cull> bodies;
  if (auto error = scene::order(means, source, survey, plan, state.order, bodies)) return error;
  report.times.order_ns = watch.lap_ns();
  const scene::PairFilter filter(filters);
  if (auto error = scene::search(means, bodies, filter, sink.capacity(), true, state.search)) {
    return error;
  }
  const std::span<scene::TaskList> lists(state.search.lists.data(), state.search.used);
  std::uint64_t dropped = 0;
  for (const scene::TaskList& task : lists) {
    report.tests += task.tests;
    dropped += task.dropped;
  }
  report.times.search_ns = watch.lap_ns();
  if (dropped != 0) {
    report.contacts = dropped;
    return std::nullopt;
  }
  std::optional<Error> error;
  if (order == ContactOrder::space) {
    error = write_lists(means, bodies, lists, sink, report.contacts);
  } else {
    scene::IdOrder by_id{state.by_id, state.by_id_starts};
    Candidates list;
    error = scene::order_by_ids(bodies.ids, source.count, lists, by_id, list);
    if (!error) {
      report.contacts =
          sink.write(means.kernels->of<Real>(), bodies.spheres, bodies.ids, list, 0, list.count, 0);
    }
  }
  report.times.contacts_ns = watch.lap_ns();
  return error;
}

template <class Real, class Sink>
Result<DetectReport> run(Workspace& workspace, const BodiesOf<Real>& bodies, const Sink& sink,
                         ContactOrder order, bool count_only) noexcept {
  try {
    if (auto error = scene::check(bodies)) return *std::move(error);
    StopWatch watch;
    const FloatEnvironment environment;
    Workspace::State& state = workspace.state();
    const scene::Means means = state.means(bodies.count);
    const scene::Source<Real> source{bodies.x,    bodies.y, bodies.z, bodies.r, bodies.stride_bytes,
                                     bodies.count};
    DetectReport report;
    if (bodies.count == 0) return report;
    scene::Survey<Real> survey;
    if (auto error = scene::survey(means, source, 0, report.excluded, survey)) {
      return *std::move(error);
    }
    if (survey.census.bodies == 0) return report;
    const scene::Plan plan = scene::make_plan(survey.census);
    report.times.survey_ns = watch.lap_ns();
    auto error = plan.cull_double
                     ? run_planned<Real, double>(state, means, source, survey, plan, bodies.filters,
                                                 sink, order, watch, report)
                     : run_planned<Real, float>(state, means, source, survey, plan, bodies.filters,
                                                sink, order, watch, report);
    if (error) return *std::move(error);
    if (!count_only && report.contacts > sink.capacity()) {
      return Error{Errc::capacity,
                   fmt::format("{} contacts and room for {}; enlarge the output", report.contacts,
                               sink.capacity()),
                   report.contacts};
    }
    return report;
  } catch (const std::bad_alloc&) {
    return Error{Errc::out_of_memory, "out of memory"};
  }
}

template <class Real>
Result<DetectReport> detect_once(const BodiesOf<Real>& bodies, std::span<BodyContactOf<Real>> out,
                                 ContactOrder order, const WorkspaceOptions& options) noexcept {
  Result<Workspace> workspace = Workspace::make(options);
  if (!workspace) return workspace.error();
  return run(*workspace, bodies, ContactSink<Real>(out), order, false);
}

}  // namespace

Result<DetectReport> detect(Workspace& workspace, const Bodies& bodies, std::span<BodyContact> out,
                            ContactOrder order) noexcept {
  return run(workspace, bodies, ContactSink<float>(out), order, false);
}
Result<DetectReport> detect(Workspace& workspace, const BodiesF64& bodies,
                            std::span<BodyContactF64> out, ContactOrder order) noexcept {
  return run(workspace, bodies, ContactSink<double>(out), order, false);
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
  return run(workspace, bodies, PairSink<float>(out), order, false);
}
Result<DetectReport> detect_pairs(Workspace& workspace, const BodiesF64& bodies,
                                  std::span<IndexPair> out, ContactOrder order) noexcept {
  return run(workspace, bodies, PairSink<double>(out), order, false);
}

Result<DetectReport> count_contacts(Workspace& workspace, const Bodies& bodies) noexcept {
  return run(workspace, bodies, CountSink<float>(), ContactOrder::space, true);
}
Result<DetectReport> count_contacts(Workspace& workspace, const BodiesF64& bodies) noexcept {
  return run(workspace, bodies, CountSink<double>(), ContactOrder::space, true);
}

}  // namespace harpoon
