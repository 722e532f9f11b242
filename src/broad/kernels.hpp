#pragma once

// The per-instruction-set half of the scene: everything that touches every body or every candidate.
// One table of functions per number type, chosen per call; no state.

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "broad/grid.hpp"
#include "harpoon/records.hpp"

namespace harpoon::broad {

/// The caller's bodies: four arrays of numbers, `stride_bytes` apart.
template <class Real>
struct Source {
  const Real *x, *y, *z, *r;
  std::size_t stride_bytes;
  std::size_t count;

  [[nodiscard]] bool records() const noexcept {
    return y == x + 1 && z == x + 2 && r == x + 3 && stride_bytes == 4 * sizeof(Real);
  }
  [[nodiscard]] SphereOf<Real> operator[](std::size_t i) const noexcept {
    const auto at = [&](const Real* array) {
      return *reinterpret_cast<const Real*>(reinterpret_cast<const char*>(array) +
                                            i * stride_bytes);
    };
    return {at(x), at(y), at(z), at(r)};
  }
};

/// Largest coordinate magnitude and radius: differences, their squares and sums stay finite.
template <class Real>
inline constexpr Real kLimit = std::is_same_v<Real, float> ? Real(0x1p62) : Real(0x1p510);

/// Extremes over the bodies of a range that are valid and within limits.
template <class Real>
struct Extremes {
  Real min[4];  ///< x, y, z, r
  Real max[4];
  std::size_t invalid = 0;  ///< and those beyond the limits
};

/// Which centres count.
template <class Real>
struct Limits {
  Real low[3] = {-kLimit<Real>, -kLimit<Real>, -kLimit<Real>};
  Real high[3] = {kLimit<Real>, kLimit<Real>, kLimit<Real>};
};

/// Sorted positions of two bodies each. The search appends, with up to kSlack elements of overrun.
struct Candidates {
  std::uint32_t* i = nullptr;
  std::uint32_t* j = nullptr;
  std::size_t count = 0;
  std::size_t capacity = 0;  ///< without slack
};

/// Makes room for at least one more vector of candidates, or clears the list and gives up.
struct RoomMaker {
  void (*make_room)(RoomMaker& self, Candidates& list) = nullptr;
};

/// Decides about two boxes, given by sorted position, in the caller's numbers.
struct BoxJudge {
  bool (*overlap)(const BoxJudge& self, std::uint32_t i, std::uint32_t j) = nullptr;
};

template <class Cull>
struct SearchJob {
  const Grid<Cull>* grids;  ///< coarsest level first
  std::size_t levels;
  CullArrays<Cull> bodies;
  std::uint32_t scanned_begin = 0;  ///< sorted positions of bodies that are in no grid
  std::uint32_t scanned_end = 0;
  const BoxJudge* judge = nullptr;  ///< of boxes
  /// Whether boxes in grids that touch in culling coordinates are judged, because rounding may have
  /// brought them together. Scanned ones are in any case.
  bool judge_touching = false;
  const Tree<Cull>* trees = nullptr;  ///< in place of grids; coarsest first
  /// Largest pad of the radii of scanned spheres and those in trees.
  Cull radius_pad = 0;
};

struct SearchResult {
  std::uint64_t tests = 0;       ///< pairs tested because they share or neighbour a cell, or a leaf
  bool doubtful = false;         ///< some candidates may turn out not to be contacts
  std::uint64_t scan_tests = 0;  ///< pairs of a scanned body

  SearchResult& operator+=(const SearchResult& other) noexcept {
    tests += other.tests;
    scan_tests += other.scan_tests;
    doubtful = doubtful || other.doubtful;
    return *this;
  }
};

/// Candidates of the bodies [begin, end) of one level (or tree), a block: among themselves and
/// later bodies of the level, against all coarser levels, and against the scanned bodies. Level
/// job.levels is the scanned bodies themselves.
template <class Cull>
using SearchKernel = SearchResult (*)(const SearchJob<Cull>& job, std::size_t level,
                                      std::uint32_t begin, std::uint32_t end, Candidates& list,
                                      RoomMaker& room);

template <class Real, class Cull>
struct CullKernels {
  /// Buckets of bodies [begin, end) of `source`.
  void (*buckets)(const Source<Real>& source, const CullMap& map, const Grid<Cull>& grid,
                  std::size_t begin, std::size_t end, std::uint32_t* buckets);
  /// Culling arrays from sorted bodies [begin, end).
  void (*cull_arrays)(const SphereOf<Real>* bodies, const CullMap& map, std::size_t begin,
                      std::size_t end, const CullArrays<Cull>& out);
  SearchKernel<Cull> search;
  /// Where the arrays hold boxes: candidates overlap exactly.
  SearchKernel<Cull> search_boxes;
  /// Boxes of all nodes of a tree of spheres, and of one of boxes.
  void (*tree_of_spheres)(const CullArrays<Cull>& bodies, const Tree<Cull>& tree);
  void (*tree_of_boxes)(const CullArrays<Cull>& bodies, const Tree<Cull>& tree);
};

template <class Real>
struct Kernels {
  Extremes<Real> (*extremes)(const Source<Real>& source, const Limits<Real>& limits,
                             std::size_t begin, std::size_t end);
  /// The largest squared distance between a body's places in the two arrays; infinite when a radius
  /// differs or a number is not finite.
  Real (*largest_move)(const SphereOf<Real>* from, const SphereOf<Real>* to, std::size_t count);
  /// `ids` is null where positions are ids, here and below. Keeps the candidates [begin,
  /// list.count) that touch; list.count becomes begin plus their number.
  void (*keep_hits)(const SphereOf<Real>* bodies, const std::uint32_t* ids, std::size_t begin,
                    Candidates& list);
  /// Contacts of those candidates [begin, end) that touch; returns their number. Writes nothing
  /// past it.
  std::size_t (*contacts)(const SphereOf<Real>* bodies, const std::uint32_t* ids,
                          const Candidates& list, std::size_t begin, std::size_t end,
                          BodyContactOf<Real>* out);
  CullKernels<Real, float> cull_float;
  CullKernels<Real, double> cull_double;

  template <class Cull>
  [[nodiscard]] const CullKernels<Real, Cull>& cull() const noexcept {
    if constexpr (std::is_same_v<Cull, float>) {
      return cull_float;
    } else {
      return cull_double;
    }
  }
};

struct KernelTable {
  Kernels<float> f32;
  Kernels<double> f64;

  template <class Real>
  [[nodiscard]] const Kernels<Real>& of() const noexcept {
    if constexpr (std::is_same_v<Real, float>) {
      return f32;
    } else {
      return f64;
    }
  }
};

/// The kernels of an instruction set by its public name, empty for the widest; null when this
/// build or machine has no such set.
const KernelTable* find_kernels(std::string_view instruction_set) noexcept;

}  // namespace harpoon::broad
