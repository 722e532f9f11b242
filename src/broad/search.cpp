#include "broad/search.hpp"

#include <algorithm>
#include <limits>

#include "base/out_of_memory.hpp"

namespace harpoon::broad {
namespace {

/// Smallest list; also how many candidates may pile up beyond the limit before they are counted.
constexpr std::size_t kMinList = 4096;
/// Below this many bodies the search is not shared between threads.
constexpr std::size_t kParallelBodies = 4096;
constexpr std::size_t kTasksPerThread = 8;
/// Tests that a candidate which does not touch is worth: it was asked for exactly.
constexpr std::uint64_t kTestsOfDoubt = 16;

/// Shared by the tasks of one search.
struct Common {
  std::uint64_t limit;
  std::uint64_t limit_of_list;  ///< a list that grows beyond this is counted first
  SearchRule::Kind kind;
  std::atomic<std::uint64_t> kept{0};  ///< contacts in lists that were counted
  std::atomic<bool> over_limit{false};
  std::atomic<bool> out_of_memory{false};
  std::uint64_t most_tests = 0;
  std::atomic<std::uint64_t> tests{0};
  std::atomic<bool> gave_up{false};

  /// A search that takes too many tests does so whatever the order in which they are counted.
  void count_tests(std::uint64_t more) noexcept {
    if (tests.fetch_add(more, std::memory_order_relaxed) + more > most_tests) gave_up = true;
  }
};

/// Keeps the list of one task: only contacts where they are asked for, only pairs that count, none
/// once there are more than the limit.
template <class Real, class Cull>
class Collector : public RoomMaker {
 public:
  Collector(const Kernels<Real>& kernels, const Ordered<Real, Cull>& bodies,
            const PairFilter& filter, Common& common, TaskList& task) noexcept
      : kernels_(kernels), bodies_(bodies), filter_(filter), common_(common), task_(task) {
    make_room = [](RoomMaker& self, Candidates& list) { static_cast<Collector&>(self).make(list); };
  }

  [[nodiscard]] bool start() noexcept {
    task_.list.count = 0;
    if (task_.list.capacity >= kMinList) return true;
    return resize(kMinList);
  }

  /// After a block, whose candidates may be doubtful.
  void settle(Candidates& list, bool doubtful) noexcept {
    if (doubtful && common_.kind == SearchRule::Kind::touching_spheres) {
      const std::size_t candidates = list.count;
      kernels_.keep_hits(bodies_.spheres, bodies_.ids, settled_, list);
      common_.count_tests(kTestsOfDoubt * (candidates - list.count));
    }
    settled_ = list.count;
  }

  /// At the end of the task.
  void finish(Candidates& list) noexcept {
    drop_filtered(list);
    if (common_.over_limit) count_against_limit(list);
  }

 private:
  /// In the middle of a block: filters, then looks whether the limit has been passed where there
  /// are so many, then grows.
  void make(Candidates& list) noexcept {
    if (common_.gave_up) {
      list.count = settled_ = filtered_ = counted_ = 0;
      return;
    }
    settle(list, true);
    drop_filtered(list);
    if (list.count <= list.capacity / 2) return;
    if (list.count > common_.limit_of_list) count_against_limit(list);
    if (list.count <= list.capacity / 2) return;
    if (!resize(2 * list.capacity)) {
      common_.out_of_memory = true;
      list.count = settled_ = filtered_ = counted_ = 0;
    }
  }

  void drop_filtered(Candidates& list) noexcept {
    if (!filter_.active()) return;
    std::size_t kept = filtered_;
    for (std::size_t p = filtered_; p < list.count; ++p) {
      const bool counts = filter_.counts(bodies_.ids[list.i[p]], bodies_.ids[list.j[p]]);
      list.i[kept] = list.i[p];
      list.j[kept] = list.j[p];
      kept += counts ? 1 : 0;
    }
    list.count = settled_ = filtered_ = kept;
  }

  /// Once the limit is passed, contacts are only counted.
  void count_against_limit(Candidates& list) noexcept {
    const std::uint64_t kept = common_.kept += list.count - counted_;
    counted_ = list.count;
    if (kept > common_.limit) common_.over_limit = true;
    if (!common_.over_limit) return;
    task_.dropped += list.count;
    list.count = settled_ = filtered_ = counted_ = 0;
  }

  bool resize(std::size_t capacity) noexcept {
    Buffer larger;
    if (!larger.reserve(2 * (capacity + kSlack) * sizeof(std::uint32_t))) return false;
    auto* const i = larger.as<std::uint32_t>();
    auto* const j = i + capacity + kSlack;
    std::copy_n(task_.list.i, task_.list.count, i);
    std::copy_n(task_.list.j, task_.list.count, j);
    task_.list.i = i;
    task_.list.j = j;
    task_.list.capacity = capacity;
    task_.memory = std::move(larger);
    return true;
  }

  const Kernels<Real>& kernels_;
  const Ordered<Real, Cull>& bodies_;
  const PairFilter& filter_;
  Common& common_;
  TaskList& task_;
  std::size_t settled_ = 0;   ///< of the list, known to be contacts
  std::size_t filtered_ = 0;  ///< known to count
  std::size_t counted_ = 0;   ///< counted against the limit
};

/// Blocks of all levels and of the scanned bodies after them, in one row of numbers.
template <class Real, class Cull>
class Blocks {
 public:
  explicit Blocks(const Ordered<Real, Cull>& bodies) noexcept
      : levels_(bodies.levels + bodies.tree_count) {
    for (std::size_t l = 0; l < bodies.levels; ++l) {
      add(l, bodies.grids[l].begin, bodies.grids[l].end);
    }
    for (std::size_t t = 0; t < bodies.tree_count; ++t) {
      add(t, bodies.trees[t].begin, bodies.trees[t].end);
    }
    const auto scanned = static_cast<std::uint32_t>(bodies.bodies);
    add(levels_, scanned, scanned + static_cast<std::uint32_t>(bodies.scanned));
  }
  [[nodiscard]] std::size_t count() const noexcept { return count_; }

  /// Calls visit(level, begin, end) for the blocks [first, last).
  template <class Visit>
  void each(std::size_t first, std::size_t last, const Visit& visit) const {
    std::size_t level = 0;
    for (std::size_t block = first; block < last; ++block) {
      while (block >= ranges_[level].first_block + ranges_[level].blocks) ++level;
      const Range& range = ranges_[level];
      const auto offset = static_cast<std::uint32_t>((block - range.first_block) * kBlockBodies);
      const std::uint32_t begin = range.begin + offset;
      visit(level, begin, std::min(range.end, begin + static_cast<std::uint32_t>(kBlockBodies)));
    }
  }

 private:
  struct Range {
    std::uint32_t begin = 0, end = 0;  ///< sorted positions
    std::size_t first_block = 0, blocks = 0;
  };

  void add(std::size_t level, std::uint32_t begin, std::uint32_t end) noexcept {
    const std::size_t blocks = (end - begin + kBlockBodies - 1) / kBlockBodies;
    ranges_[level] = {begin, end, count_, blocks};
    count_ += blocks;
  }

  std::size_t levels_;
  std::array<Range, std::max(kRadiusClasses, kMaxTrees) + 1> ranges_ = {};
  std::size_t count_ = 0;
};

/// Of scanned spheres and those in trees: they may be anywhere, so there is none where double
/// coordinates have become float.
template <class Real, class Cull>
Cull largest_pad() noexcept {
  return sizeof(Cull) < sizeof(Real) ? std::numeric_limits<Cull>::infinity()
                                     : static_cast<Cull>(kUnderflowPad<Real, Cull>);
}

}  // namespace

template <class Real, class Cull>
std::optional<Error> search(const Means& means, const Ordered<Real, Cull>& bodies,
                            const SearchRule& rule, const PairFilter& filter, std::uint64_t limit,
                            SearchMemory& memory) {
  const Kernels<Real>& kernels = means.kernels->of<Real>();
  const Blocks<Real, Cull> blocks(bodies);
  const std::size_t tasks = means.threads() == 1 || bodies.bodies < kParallelBodies
                                ? 1
                                : std::min(blocks.count(), kTasksPerThread * means.threads());
  if (memory.lists.size() < tasks) memory.lists.resize(tasks);
  memory.used = tasks;
  Common common{limit, limit / tasks, rule.kind};
  common.most_tests = bodies.tree_count != 0 ? std::numeric_limits<std::uint64_t>::max()
                                             : kMostTests * (bodies.bodies + bodies.scanned);
  memory.tests_in_vain = 0;
  const std::uint64_t crowd = bodies.most_in_bucket;
  memory.gave_up = bodies.tree_count == 0 && crowd * crowd / 2 > common.most_tests;
  if (memory.gave_up) return std::nullopt;
  const auto scanned = static_cast<std::uint32_t>(bodies.bodies);
  const SearchJob<Cull> job{bodies.grids.data(),
                            bodies.levels,
                            bodies.cull,
                            scanned,
                            scanned + static_cast<std::uint32_t>(bodies.scanned),
                            rule.judge,
                            rule.judge_touching,
                            bodies.tree_count != 0 ? bodies.trees.data() : nullptr,
                            largest_pad<Real, Cull>()};
  const auto kernel = rule.kind == SearchRule::Kind::boxes
                          ? kernels.template cull<Cull>().search_boxes
                          : kernels.template cull<Cull>().search;
  auto error = means.run(tasks, [&](std::size_t t) {
    TaskList& task = memory.lists[t];
    task.tests = task.dropped = 0;
    Collector<Real, Cull> collector(kernels, bodies, filter, common, task);
    if (!collector.start()) {
      common.out_of_memory = true;
      return;
    }
    const auto ended = [&] {
      return common.out_of_memory.load(std::memory_order_relaxed) ||
             common.gave_up.load(std::memory_order_relaxed) ||
             (rule.kind == SearchRule::Kind::near_spheres &&
              common.over_limit.load(std::memory_order_relaxed));
    };
    const auto each = [&](std::size_t level, std::uint32_t begin, std::uint32_t end) {
      if (!ended()) {
        const SearchResult found = kernel(job, level, begin, end, task.list, collector);
        task.tests += found.tests + found.scan_tests;
        common.count_tests(found.tests);
        collector.settle(task.list, found.doubtful);
      }
    };
    blocks.each(blocks.count() * t / tasks, blocks.count() * (t + 1) / tasks, each);
    collector.finish(task.list);
  });
  if (error) return error;
  if (common.out_of_memory) return out_of_memory();
  memory.gave_up = common.gave_up;
  // How many were begun when the limit was passed depends on the threads, the limit does not.
  memory.tests_in_vain = common.most_tests;
  if (memory.gave_up) return std::nullopt;
  std::uint64_t total = 0;
  for (std::size_t t = 0; t < tasks; ++t) {
    total += memory.lists[t].list.count + memory.lists[t].dropped;
  }
  if (total <= limit) return std::nullopt;
  for (std::size_t t = 0; t < tasks; ++t) {
    TaskList& task = memory.lists[t];
    task.dropped += task.list.count;
    task.list.count = 0;
  }
  return std::nullopt;
}

template std::optional<Error> search(const Means&, const Ordered<float, float>&, const SearchRule&,
                                     const PairFilter&, std::uint64_t, SearchMemory&);
template std::optional<Error> search(const Means&, const Ordered<float, double>&, const SearchRule&,
                                     const PairFilter&, std::uint64_t, SearchMemory&);
template std::optional<Error> search(const Means&, const Ordered<double, float>&, const SearchRule&,
                                     const PairFilter&, std::uint64_t, SearchMemory&);
template std::optional<Error> search(const Means&, const Ordered<double, double>&,
                                     const SearchRule&, const PairFilter&, std::uint64_t,
                                     SearchMemory&);

}  // namespace harpoon::broad
