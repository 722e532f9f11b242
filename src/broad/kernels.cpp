// One source for every instruction set: Highway compiles this file once per target. Bodies lie
// sorted by bucket, so the neighbours of a body are a few contiguous runs; each run is tested a
// vector at a time and the hits are compressed into a list of candidates. Culling may use any
// arithmetic because its radii are inflated; what decides is src/collide/sphere_sphere.inl alone.

#include "broad/kernels.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "broad/kernels.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

#include "base/instruction_set.hpp"
#include "collide/copy_sphere.inl"
#include "collide/simd.inl"

HWY_BEFORE_NAMESPACE();
namespace harpoon::broad::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
namespace simd = colliders::HWY_NAMESPACE;

template <class T>
using Tag = hn::ScalableTag<T>;
template <class T>
using Vector = hn::Vec<Tag<T>>;
using Index = Tag<std::uint32_t>;
/// Lanes of the vectors that test long runs of neighbours, and short ones: most of those are
/// shorter than eight, wider vectors would carry nothing but work.
template <class T>
constexpr std::size_t kLongRunLanes = HWY_LANES(T);
template <class T>
constexpr std::size_t kShortRunLanes = std::min<std::size_t>(HWY_LANES(T), 8);

constexpr std::size_t kMaxLanes = HWY_MAX_BYTES / sizeof(float);
static_assert(kMaxLanes <= kSlack);
static_assert(std::endian::native == std::endian::little);

// In the order of a frame; each uses those before it.
// clang-format off
#include "broad/bodies.inl"
#include "broad/survey.inl"
#include "broad/cells.inl"
#include "broad/cull.inl"
#include "broad/candidates.inl"
#include "broad/node_boxes.inl"
#include "broad/shapes.inl"
#include "broad/grid_search.inl"
#include "broad/leaves.inl"
#include "broad/scan.inl"
#include "broad/tree_search.inl"
#include "broad/contacts.inl"
// clang-format on

template <template <class, std::size_t> class Shape, class Cull>
SearchResult search(const SearchJob<Cull>& job, std::size_t level, std::uint32_t begin,
                    std::uint32_t end, Candidates& list, RoomMaker& room) {
  using ForLong = Shape<Cull, kLongRunLanes<Cull>>;
  using ForShort = Shape<Cull, kShortRunLanes<Cull>>;
  if (job.trees != nullptr) return search_trees<ForLong>(job, level, begin, end, list, room);
  if (level == job.levels) return scan_scanned<ForLong>(job, begin, end, list, room);
  const Grid<Cull>& own = job.grids[level];
  SearchResult all = own.short_runs ? search_own_level<ForShort>(job, own, begin, end, list, room)
                                    : search_own_level<ForLong>(job, own, begin, end, list, room);
  for (std::size_t coarser = 0; coarser < level; ++coarser) {
    const Grid<Cull>& grid = job.grids[coarser];
    all += grid.short_runs ? search_coarser_level<ForShort>(job, grid, begin, end, list, room)
                           : search_coarser_level<ForLong>(job, grid, begin, end, list, room);
  }
  if (job.scanned_end != job.scanned_begin) all += scan<ForLong>(job, begin, end, list, room);
  return all;
}

template <class Real>
constexpr Kernels<Real> kKernels = {
    extremes<Real>,
    largest_move<Real>,
    keep_hits<Real>,
    contacts<Real>,
    {buckets_float<Real>, cull_arrays_float<Real>, search<SphereShape, float>,
     search<BoxShape, float>, fill_tree<SphereShape, float>, fill_tree<BoxShape, float>},
    {buckets_double<Real>, cull_arrays_double<Real>, search<SphereShape, double>,
     search<BoxShape, double>, fill_tree<SphereShape, double>, fill_tree<BoxShape, double>},
};

const KernelTable* get_kernels() {
  static constexpr KernelTable kTable = {kKernels<float>, kKernels<double>};
  return &kTable;
}

}  // namespace
}  // namespace harpoon::broad::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace harpoon::broad {
namespace {

HWY_EXPORT(get_kernels);

}  // namespace

const KernelTable* find_kernels(std::string_view instruction_set) noexcept {
  const std::int64_t target = find_target(instruction_set);
  return target == 0 ? nullptr : call_for_target(HWY_DISPATCH_TABLE(get_kernels), target);
}

}  // namespace harpoon::broad
#endif
