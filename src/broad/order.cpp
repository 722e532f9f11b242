// A counting sort in up to three passes, each stable, so that ids ascend within a bucket:
//   1. by level, when there are several (or bodies to leave out);
//   2. by part of a level, a run of buckets small enough for the second-level cache, when the level
//      is large or threads share the work;
//   3. by bucket, part by part.
// Each pass reads in order and writes to few places at a time: memory order is what decides.

#include "broad/order.hpp"

#include <algorithm>
#include <atomic>

#include "base/out_of_memory.hpp"

namespace harpoon::broad {
namespace {

/// Bodies that a part should hold: with tables they fill about half of a second-level cache.
constexpr std::size_t kPartBodies = 16384;
/// Up to this many bodies a level is sorted in one go on one thread.
constexpr std::size_t kWholeBodies = 131072;
constexpr std::size_t kMaxParts = 512;
/// Below this many bodies a pass is not shared between threads.
constexpr std::size_t kParallelBodies = 16384;
/// Tasks for a pass over `bodies`, and where they begin.
struct Chunks {
  std::size_t bodies, count;

  Chunks(const Means& means, std::size_t all) noexcept
      : bodies(all),
        count(means.threads() == 1 || all < kParallelBodies
                  ? 1
                  : std::min(std::size_t{4} * means.threads(), all / (kParallelBodies / 4))) {}
  [[nodiscard]] std::size_t begin(std::size_t chunk) const noexcept {
    return bodies * chunk / count;
  }
};

/// Bodies of each level or part in each chunk, then the position of the first of them.
class CountTable {
 public:
  CountTable(std::uint32_t* counts, std::size_t chunks, std::size_t keys) noexcept
      : counts_(counts), chunks_(chunks), keys_(keys) {
    std::fill(counts, counts + chunks * keys, 0U);
  }
  [[nodiscard]] std::uint32_t* of(std::size_t chunk) const noexcept {
    return counts_ + chunk * keys_;
  }
  /// Counts become positions from `begin` on; `starts` gets keys + 1 of them.
  void sum(std::uint32_t begin, std::uint32_t* starts) noexcept {
    std::uint32_t position = begin;
    for (std::size_t key = 0; key < keys_; ++key) {
      starts[key] = position;
      for (std::size_t chunk = 0; chunk < chunks_; ++chunk) {
        std::uint32_t& count = counts_[chunk * keys_ + key];
        const std::uint32_t bodies = count;
        count = position;
        position += bodies;
      }
    }
    starts[keys_] = position;
  }

 private:
  std::uint32_t* counts_;
  std::size_t chunks_, keys_;
};

template <class Real>
Source<Real> records(const SphereOf<Real>* spheres, std::size_t count) noexcept {
  return {&spheres->x, &spheres->y, &spheres->z, &spheres->r, sizeof spheres[0], count};
}

/// Calls with(body_at), which gives body i: by address where the source is made of records.
template <class Real, class With>
void with_bodies(const Source<Real>& source, const With& with) {
  if (source.records()) {
    with([from = reinterpret_cast<const SphereOf<Real>*>(source.x)](
             std::size_t i) -> const SphereOf<Real>& { return from[i]; });
  } else {
    with([&source](std::size_t i) { return source[i]; });
  }
}

/// One ordering under way.
template <class Real, class Cull>
class Sorter {
 public:
  Sorter(const Means& means, const Source<Real>& source, const Survey<Real>& survey,
         const Plan& plan, OrderMemory& memory, Ordered<Real, Cull>& out) noexcept
      : means_(means),
        kernels_(means.kernels->of<Real>().template cull<Cull>()),
        source_(source),
        survey_(survey),
        plan_(plan),
        memory_(memory),
        out_(out) {}

  std::optional<Error> run() {
    const std::size_t bodies = survey_.census.bodies;
    const std::size_t all = bodies + out_.scanned;
    if (!make_grids() || !reserve_sorted(memory_, all, out_) ||
        !memory_.buckets.reserve((all + kSlack) * sizeof(std::uint32_t))) {
      return out_of_memory();
    }
    if (bodies == 0) return std::nullopt;
    const std::uint32_t* ids = nullptr;
    Source<Real> source = source_;
    if (plan_.level_count > 1 || survey_.left_out() != 0) {
      if (auto error = stage_levels()) return error;
      source = records(memory_.staged.template as<SphereOf<Real>>(), bodies);
      ids = memory_.staged_ids.as<std::uint32_t>();
    }
    for (std::size_t level = 0; level < plan_.level_count; ++level) {
      if (auto error = sort_level(source, ids, out_.grids[level])) return error;
    }
    out_.most_in_bucket = most_in_bucket_;
    return std::nullopt;
  }

 private:
  bool make_grids() noexcept {
    out_.levels = plan_.level_count;
    out_.bodies = survey_.census.bodies;
    Cull min[3];
    Cull max[3];
    for (int k = 0; k < 3; ++k) {
      min[k] = static_cast<Cull>(survey_.census.min[k] - plan_.map.origin[k]);
      max[k] = static_cast<Cull>(survey_.census.max[k] - plan_.map.origin[k]);
    }
    std::size_t buckets = 0;
    std::size_t position = 0;
    for (std::size_t l = 0; l < out_.levels; ++l) {
      Grid<Cull>& grid = out_.grids[l];
      grid = make_grid<Cull>(plan_.levels[l], plan_.map, min, max);
      grid.begin = static_cast<std::uint32_t>(position);
      position += plan_.levels[l].bodies;
      grid.end = static_cast<std::uint32_t>(position);
      buckets += grid.buckets + 1;
    }
    if (!memory_.tables.reserve((buckets + kSlack) * sizeof(std::uint32_t))) return false;
    auto* table = memory_.tables.as<std::uint32_t>();
    for (std::size_t l = 0; l < out_.levels; ++l) {
      Grid<Cull>& grid = out_.grids[l];
      table[0] = grid.begin;
      grid.ends = table + 1;
      table += grid.buckets + 1;
    }
    return true;
  }

  /// Pass 1.
  std::optional<Error> stage_levels() {
    const Chunks chunks(means_, source_.count);
    const std::size_t levels = plan_.level_count;
    const std::size_t bodies = survey_.census.bodies;
    if (!memory_.staged.reserve((bodies + kSlack) * sizeof(SphereOf<Real>)) ||
        !memory_.staged_ids.reserve((bodies + kSlack) * sizeof(std::uint32_t)) ||
        !memory_.counts.reserve(chunks.count * levels * sizeof(std::uint32_t))) {
      return out_of_memory();
    }
    CountTable counts(memory_.counts.as<std::uint32_t>(), chunks.count, levels);
    const Classifier<Real> class_of(survey_.largest);
    const bool all_valid = survey_.extremes.invalid == 0;
    const auto each = [&](std::size_t chunk, const auto& visit) {
      const std::size_t end = chunks.begin(chunk + 1);
      for (std::size_t i = chunks.begin(chunk); i < end; ++i) {
        const SphereOf<Real> b = source_[i];
        if (!all_valid && !is_valid(b)) continue;
        const int size = survey_.one_class ? 0 : class_of(b.r);
        if (size < 0) continue;
        visit(i, b, plan_.level_of_class[static_cast<std::size_t>(size)]);
      }
    };
    if (chunks.count == 1) {  // counted by the survey
      for (std::size_t level = 0; level < levels; ++level) {
        counts.of(0)[level] = static_cast<std::uint32_t>(plan_.levels[level].bodies);
      }
    } else if (auto error = means_.run(chunks.count, [&](std::size_t chunk) {
                 std::uint32_t* const of = counts.of(chunk);
                 each(chunk,
                      [&](std::size_t, const SphereOf<Real>&, std::size_t level) { ++of[level]; });
               })) {
      return error;
    }
    std::uint32_t starts[kRadiusClasses + 1];
    counts.sum(0, starts);
    auto* const spheres = memory_.staged.template as<SphereOf<Real>>();
    auto* const ids = memory_.staged_ids.as<std::uint32_t>();
    return means_.run(chunks.count, [&](std::size_t chunk) {
      std::uint32_t* const next = counts.of(chunk);
      each(chunk, [&](std::size_t i, const SphereOf<Real>& b, std::size_t level) {
        const std::uint32_t to = next[level]++;
        spheres[to] = b;
        ids[to] = static_cast<std::uint32_t>(i);
      });
    });
  }

  /// Passes 2 and 3 for one level. `ids` is null when bodies are their own ids.
  std::optional<Error> sort_level(const Source<Real>& source, const std::uint32_t* ids,
                                  const Grid<Cull>& grid) {
    const std::size_t bodies = grid.end - grid.begin;
    const Chunks chunks(means_, bodies);
    std::uint32_t* const buckets = memory_.buckets.as<std::uint32_t>();
    if (bodies <= kWholeBodies && chunks.count == 1) {
      kernels_.buckets(source, plan_.map, grid, grid.begin, grid.end, buckets);
      const Run run{source, ids, buckets, grid.begin, grid.end};
      if (ids == nullptr) {
        sort_part<false>(run, grid, 0, grid.buckets);
      } else {
        sort_part<true>(run, grid, 0, grid.buckets);
      }
      return std::nullopt;
    }
    return sort_in_parts(source, ids, grid, chunks);
  }

  /// Bodies to be sorted by bucket: a source, ids and buckets by the same index.
  struct Run {
    const Source<Real>& source;
    const std::uint32_t* ids;
    const std::uint32_t* buckets;
    std::size_t begin, end;
  };

  /// Pass 3: sorts the bodies of buckets [first, last) to the places from `run.begin` on.
  template <bool kHasIds>
  void sort_part(const Run& run, const Grid<Cull>& grid, std::size_t first, std::size_t last) {
    std::uint32_t* const ends = grid.ends;
    std::fill(ends + first, ends + last, 0U);
    for (std::size_t i = run.begin; i < run.end; ++i) ++ends[run.buckets[i]];
    auto position = static_cast<std::uint32_t>(run.begin);
    std::uint32_t most = 0;
    for (std::size_t b = first; b < last; ++b) {
      const std::uint32_t bodies = ends[b];
      ends[b] = position;
      position += bodies;
      most = std::max(most, bodies);
    }
    std::uint32_t before = most_in_bucket_;
    while (before < most && !most_in_bucket_.compare_exchange_weak(before, most)) {
    }
    auto* const spheres = memory_.sorted.template as<SphereOf<Real>>();
    auto* const ids = memory_.ids.as<std::uint32_t>();
    with_bodies(run.source, [&](const auto& body_at) {
      for (std::size_t i = run.begin; i < run.end; ++i) {
        const std::uint32_t to = ends[run.buckets[i]]++;
        spheres[to] = body_at(i);
        ids[to] = kHasIds ? run.ids[i] : static_cast<std::uint32_t>(i);
      }
    });
    kernels_.cull_arrays(spheres, plan_.map, run.begin, run.end, out_.cull);
  }

  std::optional<Error> sort_in_parts(const Source<Real>& source, const std::uint32_t* ids,
                                     const Grid<Cull>& grid, const Chunks& chunks) {
    const std::size_t bodies = grid.end - grid.begin;
    std::uint32_t shift = 0;
    const std::size_t wanted =
        std::min(kMaxParts, std::max(bodies / kPartBodies, 4 * std::size_t{means_.threads()}));
    while ((grid.buckets >> shift) > wanted) ++shift;
    const std::size_t parts = (grid.buckets >> shift) + 1;
    const std::size_t with_slack = out_.bodies + kSlack;
    if (!memory_.parted.reserve(with_slack * sizeof(SphereOf<Real>)) ||
        !memory_.parted_ids.reserve(with_slack * sizeof(std::uint32_t)) ||
        !memory_.parted_buckets.reserve(with_slack * sizeof(std::uint32_t)) ||
        !memory_.counts.reserve((chunks.count * parts + parts + 1) * sizeof(std::uint32_t))) {
      return out_of_memory();
    }
    CountTable counts(memory_.counts.as<std::uint32_t>(), chunks.count, parts);
    std::uint32_t* const starts = memory_.counts.as<std::uint32_t>() + chunks.count * parts;
    std::uint32_t* const buckets = memory_.buckets.as<std::uint32_t>();
    if (auto error = means_.run(chunks.count, [&](std::size_t chunk) {
          const std::size_t begin = grid.begin + chunks.begin(chunk);
          const std::size_t end = grid.begin + chunks.begin(chunk + 1);
          kernels_.buckets(source, plan_.map, grid, begin, end, buckets);
          std::uint32_t* const of = counts.of(chunk);
          for (std::size_t i = begin; i < end; ++i) ++of[buckets[i] >> shift];
        })) {
      return error;
    }
    counts.sum(grid.begin, starts);
    auto* const spheres = memory_.parted.template as<SphereOf<Real>>();
    auto* const parted_ids = memory_.parted_ids.as<std::uint32_t>();
    auto* const parted_buckets = memory_.parted_buckets.as<std::uint32_t>();
    if (auto error = means_.run(chunks.count, [&](std::size_t chunk) {
          std::uint32_t* const next = counts.of(chunk);
          const std::size_t end = grid.begin + chunks.begin(chunk + 1);
          with_bodies(source, [&](const auto& body_at) {
            for (std::size_t i = grid.begin + chunks.begin(chunk); i < end; ++i) {
              const std::uint32_t to = next[buckets[i] >> shift]++;
              spheres[to] = body_at(i);
              parted_ids[to] = ids == nullptr ? static_cast<std::uint32_t>(i) : ids[i];
              parted_buckets[to] = buckets[i];
            }
          });
        })) {
      return error;
    }
    const Source<Real> parted = records(spheres, out_.bodies);
    return means_.run(parts, [&](std::size_t part) {
      const std::size_t first = part << shift;
      const std::size_t last = std::min<std::size_t>((part + 1) << shift, grid.buckets);
      sort_part<true>({parted, parted_ids, parted_buckets, starts[part], starts[part + 1]}, grid,
                      first, last);
    });
  }

  const Means& means_;
  const CullKernels<Real, Cull>& kernels_;
  const Source<Real>& source_;
  const Survey<Real>& survey_;
  const Plan& plan_;
  OrderMemory& memory_;
  Ordered<Real, Cull>& out_;
  std::atomic<std::uint32_t> most_in_bucket_{0};
};

}  // namespace

template <class Real, class Cull>
bool reserve_sorted(OrderMemory& memory, std::size_t bodies, Ordered<Real, Cull>& out) noexcept {
  const std::size_t with_slack = bodies + kSlack;
  if (!memory.sorted.reserve(with_slack * sizeof(SphereOf<Real>)) ||
      !memory.ids.reserve(with_slack * sizeof(std::uint32_t)) ||
      !memory.cull.reserve(4 * with_slack * sizeof(Cull))) {
    return false;
  }
  auto* cull = memory.cull.as<Cull>();
  out.cull = {cull, cull + with_slack, cull + 2 * with_slack, cull + 3 * with_slack};
  for (std::size_t k = bodies; k < with_slack; ++k) {
    out.cull.x[k] = out.cull.y[k] = out.cull.z[k] = out.cull.r[k] = 0;
  }
  out.spheres = memory.sorted.as<SphereOf<Real>>();
  out.ids = memory.ids.as<std::uint32_t>();
  return true;
}

template <class Real, class Cull>
std::optional<Error> order(const Means& means, const Source<Real>& source,
                           const Survey<Real>& survey, const Plan& plan, OrderMemory& memory,
                           Ordered<Real, Cull>& out) {
  return Sorter<Real, Cull>(means, source, survey, plan, memory, out).run();
}

template <class Real, class Cull>
void place_giants(const Means& means, const Source<Real>& source, const Survey<Real>& survey,
                  const Plan& plan, OrderMemory& memory, Ordered<Real, Cull>& out) noexcept {
  auto* const spheres = memory.sorted.as<SphereOf<Real>>();
  const std::size_t end = out.bodies + survey.giants.size();
  for (std::size_t p = out.bodies; p < end; ++p) {
    const std::uint32_t id = survey.giants[p - out.bodies];
    spheres[p] = source[id];
    out.ids[p] = id;
  }
  means.kernels->of<Real>().template cull<Cull>().cull_arrays(spheres, plan.map, out.bodies, end,
                                                              out.cull);
}

template bool reserve_sorted(OrderMemory&, std::size_t, Ordered<float, float>&) noexcept;
template bool reserve_sorted(OrderMemory&, std::size_t, Ordered<float, double>&) noexcept;
template bool reserve_sorted(OrderMemory&, std::size_t, Ordered<double, float>&) noexcept;
template bool reserve_sorted(OrderMemory&, std::size_t, Ordered<double, double>&) noexcept;
template std::optional<Error> order(const Means&, const Source<float>&, const Survey<float>&,
                                    const Plan&, OrderMemory&, Ordered<float, float>&);
template std::optional<Error> order(const Means&, const Source<float>&, const Survey<float>&,
                                    const Plan&, OrderMemory&, Ordered<float, double>&);
template std::optional<Error> order(const Means&, const Source<double>&, const Survey<double>&,
                                    const Plan&, OrderMemory&, Ordered<double, float>&);
template std::optional<Error> order(const Means&, const Source<double>&, const Survey<double>&,
                                    const Plan&, OrderMemory&, Ordered<double, double>&);

template void place_giants(const Means&, const Source<float>&, const Survey<float>&, const Plan&,
                           OrderMemory&, Ordered<float, float>&) noexcept;
template void place_giants(const Means&, const Source<float>&, const Survey<float>&, const Plan&,
                           OrderMemory&, Ordered<float, double>&) noexcept;
template void place_giants(const Means&, const Source<double>&, const Survey<double>&, const Plan&,
                           OrderMemory&, Ordered<double, float>&) noexcept;
template void place_giants(const Means&, const Source<double>&, const Survey<double>&, const Plan&,
                           OrderMemory&, Ordered<double, double>&) noexcept;

}  // namespace harpoon::broad
