// A counting sort in up to three passes, each stable, so that ids ascend within a bucket:
//   1. by level, when there are several (or bodies to leave out);
//   2. by part of a level, a run of buckets small enough for the second-level cache, when the level
//      is large or threads share the work;
//   3. by bucket, part by part.
// Each pass reads in order and writes to few places at a time: memory order is what decides.

#include "scene/order.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace harpoon::scene {
namespace {

/// Bodies that a part should hold: with tables they fill about half of a second-level cache.
constexpr std::size_t kPartBodies = 16384;
/// Up to this many bodies a level is sorted in one go on one thread.
constexpr std::size_t kWholeBodies = 131072;
constexpr std::size_t kMaxParts = 512;
/// Below this many bodies a pass is not shared between threads.
constexpr std::size_t kParallelBodies = 16384;
/// Most bodies looked at to find out how much of the world is occupied, and one in how many.
constexpr std::size_t kSamples = 256;
constexpr std::size_t kBodiesPerSample = 16;

Error out_of_memory() {
  return {Errc::out_of_memory, "out of memory"};
}

template <class Real>
bool valid(const SphereOf<Real>& b) noexcept {
  const auto in_range = [](Real v) { return std::abs(v) <= kLimit<Real>; };  // false for NaN
  return in_range(b.x) && in_range(b.y) && in_range(b.z) && b.r >= 0 && b.r <= kLimit<Real>;
}

/// Powers of two between a radius and the largest one.
template <class Real>
class Classifier {
 public:
  explicit Classifier(Real largest) noexcept : top_(exponent(largest)) {}
  std::size_t operator()(Real radius) const noexcept {
    return std::min<std::size_t>(static_cast<std::size_t>(top_ - exponent(radius)),
                                 kRadiusClasses - 1);
  }

 private:
  static int exponent(Real value) noexcept {
    using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
    Bits bits;
    std::memcpy(&bits, &value, sizeof bits);
    return static_cast<int>(bits >> (std::numeric_limits<Real>::digits - 1));
  }
  int top_;
};

/// Radii this close share a class.
constexpr double kOneClassRatio = 1.5;

template <class Real>
bool one_class(const Extremes<Real>& e) noexcept {
  return static_cast<double>(e.max[3]) <= kOneClassRatio * static_cast<double>(e.min[3]);
}

/// Bodies of each class, and the largest radius among them, in a part of the bodies.
template <class Real>
class ClassCounts {
 public:
  void count(const Source<Real>& source, const Classifier<Real>& class_of, bool all_valid,
             std::size_t begin, std::size_t end) noexcept {
    for (std::size_t i = begin; i < end; ++i) {
      const SphereOf<Real> b = source[i];
      if (!all_valid && !valid(b)) continue;
      // Neighbours count apart, or each would wait for the one before it.
      Class& c = classes_[i % kTurns][class_of(b.r)];
      ++c.bodies;
      c.max_radius = std::max(c.max_radius, b.r);
    }
  }

  void add_to(std::array<RadiusClass, kRadiusClasses>& classes) const noexcept {
    for (const auto& turn : classes_) {
      for (std::size_t c = 0; c < kRadiusClasses; ++c) {
        classes[c].bodies += turn[c].bodies;
        classes[c].max_radius =
            std::max(classes[c].max_radius, static_cast<double>(turn[c].max_radius));
      }
    }
  }

 private:
  static constexpr std::size_t kTurns = 4;
  struct Class {
    std::size_t bodies = 0;
    Real max_radius = 0;
  };
  std::array<std::array<Class, kRadiusClasses>, kTurns> classes_ = {};
};

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

template <class Real>
void merge(Extremes<Real>& into, const Extremes<Real>& from) noexcept {
  for (int k = 0; k < 4; ++k) {
    into.min[k] = std::min(into.min[k], from.min[k]);
    into.max[k] = std::max(into.max[k], from.max[k]);
  }
  into.invalid += from.invalid;
}

/// Length of an axis near which bodies are, from a sample: long gaps count as short ones.
template <class Real>
double occupied_length(const Source<Real>& source, int axis, double longest_gap) noexcept {
  Real samples[kSamples];
  std::size_t count = 0;
  const std::size_t step =
      std::max(std::min(source.count, kBodiesPerSample), source.count / kSamples);
  for (std::size_t i = 0; i < source.count && count < kSamples; i += step) {
    const SphereOf<Real> b = source[i];
    if (valid(b)) samples[count++] = axis == 0 ? b.x : axis == 1 ? b.y : b.z;
  }
  std::sort(samples, samples + count);
  double length = 0;
  for (std::size_t k = 1; k < count; ++k) {
    length += std::min(static_cast<double>(samples[k]) - static_cast<double>(samples[k - 1]),
                       longest_gap);
  }
  return length;
}

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
    if (!make_grids() || !reserve(bodies + out_.scanned)) return out_of_memory();
    if (bodies == 0) return std::nullopt;
    const std::uint32_t* ids = nullptr;
    Source<Real> source = source_;
    if (plan_.level_count > 1 || survey_.extremes.invalid != 0) {
      if (auto error = stage_levels()) return error;
      source = records(memory_.staged.template as<SphereOf<Real>>(), bodies);
      ids = memory_.staged_ids.as<std::uint32_t>();
    }
    for (std::size_t level = 0; level < plan_.level_count; ++level) {
      if (auto error = sort_level(source, ids, out_.grids[level])) return error;
    }
    return std::nullopt;
  }

 private:
  bool make_grids() noexcept {
    out_.levels = plan_.level_count;
    out_.bodies = survey_.census.bodies;
    Cull min[3];
    Cull max[3];
    for (int k = 0; k < 3; ++k) {
      min[k] =
          static_cast<Cull>(static_cast<double>(survey_.extremes.min[k]) - plan_.map.origin[k]);
      max[k] =
          static_cast<Cull>(static_cast<double>(survey_.extremes.max[k]) - plan_.map.origin[k]);
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

  bool reserve(std::size_t bodies) noexcept {
    const std::size_t with_slack = bodies + kSlack;
    if (!memory_.sorted.reserve(with_slack * sizeof(SphereOf<Real>)) ||
        !memory_.ids.reserve(with_slack * sizeof(std::uint32_t)) ||
        !memory_.buckets.reserve(with_slack * sizeof(std::uint32_t)) ||
        !memory_.cull.reserve(4 * with_slack * sizeof(Cull))) {
      return false;
    }
    auto* cull = memory_.cull.template as<Cull>();
    out_.cull = {cull, cull + with_slack, cull + 2 * with_slack, cull + 3 * with_slack};
    for (std::size_t k = bodies; k < with_slack; ++k) {
      out_.cull.x[k] = out_.cull.y[k] = out_.cull.z[k] = out_.cull.r[k] = 0;
    }
    out_.spheres = memory_.sorted.template as<SphereOf<Real>>();
    out_.ids = memory_.ids.as<std::uint32_t>();
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
    const Classifier<Real> class_of(survey_.extremes.max[3]);
    const bool single = one_class(survey_.extremes);
    const bool all_valid = survey_.extremes.invalid == 0;
    const auto each = [&](std::size_t chunk, const auto& visit) {
      const std::size_t end = chunks.begin(chunk + 1);
      for (std::size_t i = chunks.begin(chunk); i < end; ++i) {
        const SphereOf<Real> b = source_[i];
        if (!all_valid && !valid(b)) continue;
        visit(i, b, plan_.level_of_class[single ? 0 : class_of(b.r)]);
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
    for (std::size_t b = first; b < last; ++b) {
      const std::uint32_t bodies = ends[b];
      ends[b] = position;
      position += bodies;
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
};

}  // namespace

template <class Real>
std::optional<Error> survey(const Means& means, const Source<Real>& source, double margin,
                            std::vector<std::uint32_t>& excluded, Survey<Real>& out) {
  const Chunks chunks(means, source.count);
  const auto& kernels = means.kernels->of<Real>();
  constexpr std::size_t kMaxChunks = 64;
  const std::size_t tasks = std::min(chunks.count, kMaxChunks);
  Extremes<Real> extremes[kMaxChunks];
  if (auto error = means.run(tasks, [&](std::size_t task) {
        extremes[task] = kernels.extremes(source, source.count * task / tasks,
                                          source.count * (task + 1) / tasks);
      })) {
    return error;
  }
  for (std::size_t task = 1; task < tasks; ++task) merge(extremes[0], extremes[task]);
  out.extremes = extremes[0];
  if (out.extremes.invalid != 0) {
    excluded.reserve(excluded.size() + out.extremes.invalid);
    for (std::size_t i = 0; i < source.count; ++i) {
      if (!valid(source[i])) excluded.push_back(static_cast<std::uint32_t>(i));
    }
  }
  Census& census = out.census;
  census.bodies = source.count - out.extremes.invalid;
  census.margin = margin;
  census.real_digits = std::numeric_limits<Real>::digits;
  if (census.bodies == 0) return std::nullopt;
  for (int k = 0; k < 3; ++k) {
    census.min[k] = static_cast<double>(out.extremes.min[k]);
    census.max[k] = static_cast<double>(out.extremes.max[k]);
    census.occupied[k] = census.max[k] - census.min[k];
  }
  if (one_class(out.extremes)) {
    census.classes[0] = {census.bodies, static_cast<double>(out.extremes.max[3])};
  } else {
    const Classifier<Real> class_of(out.extremes.max[3]);
    constexpr std::size_t kLeast = kParallelBodies / 4;
    std::vector<ClassCounts<Real>> counts(means.pieces(source.count, kLeast));
    if (auto error = means.run_pieces(
            source.count, kLeast, [&](std::size_t piece, std::size_t begin, std::size_t end) {
              counts[piece].count(source, class_of, out.extremes.invalid == 0, begin, end);
            })) {
      return error;
    }
    for (const ClassCounts<Real>& piece : counts) piece.add_to(census.classes);
  }
  if (is_sparse(census)) {
    const double gap = 8 * (2 * static_cast<double>(out.extremes.max[3]) + margin);
    for (int k = 0; k < 3; ++k) census.occupied[k] = occupied_length(source, k, gap);
  }
  return std::nullopt;
}

template <class Real, class Cull>
std::optional<Error> order(const Means& means, const Source<Real>& source,
                           const Survey<Real>& survey, const Plan& plan, OrderMemory& memory,
                           Ordered<Real, Cull>& out) {
  return Sorter<Real, Cull>(means, source, survey, plan, memory, out).run();
}

template std::optional<Error> survey(const Means&, const Source<float>&, double,
                                     std::vector<std::uint32_t>&, Survey<float>&);
template std::optional<Error> survey(const Means&, const Source<double>&, double,
                                     std::vector<std::uint32_t>&, Survey<double>&);
template std::optional<Error> order(const Means&, const Source<float>&, const Survey<float>&,
                                    const Plan&, OrderMemory&, Ordered<float, float>&);
template std::optional<Error> order(const Means&, const Source<float>&, const Survey<float>&,
                                    const Plan&, OrderMemory&, Ordered<float, double>&);
template std::optional<Error> order(const Means&, const Source<double>&, const Survey<double>&,
                                    const Plan&, OrderMemory&, Ordered<double, float>&);
template std::optional<Error> order(const Means&, const Source<double>&, const Survey<double>&,
                                    const Plan&, OrderMemory&, Ordered<double, double>&);

}  // namespace harpoon::scene
