#pragma once

// Brings bodies into the order of the search: level by level, bucket by bucket, by id within a
// bucket. The result depends on the set of bodies only.

#include <array>
#include <cstdint>
#include <optional>

#include "base/buffer.hpp"
#include "broad/kernels.hpp"
#include "broad/means.hpp"
#include "broad/plan.hpp"
#include "broad/survey.hpp"
#include "harpoon/error.hpp"

namespace harpoon::broad {

/// What an ordering needs and leaves behind. Kept between calls for its memory alone.
struct OrderMemory {
  Buffer staged, staged_ids;                  ///< bodies by level
  Buffer parted, parted_ids, parted_buckets;  ///< bodies by part of a level
  Buffer buckets, tables, counts;
  Buffer sorted, ids, cull;

  [[nodiscard]] std::size_t bytes() const noexcept {
    return bytes_of(staged, staged_ids, parted, parted_ids, parted_buckets, buckets, tables, counts,
                    sorted, ids, cull);
  }
};

/// Most trees: each but the coarsest has at least as many bodies as those that are coarser.
inline constexpr std::size_t kMaxTrees = 33;

/// Bodies in search order: those in grids, then those that are in none and are tested against all.
/// Or all of them in trees.
template <class Real, class Cull>
struct Ordered {
  std::array<Grid<Cull>, kRadiusClasses> grids;  ///< coarsest level first
  std::size_t levels = 0;
  std::size_t bodies = 0;            ///< in grids
  std::size_t scanned = 0;           ///< in none; set before ordering, which makes room for them
  std::uint32_t most_in_bucket = 0;  ///< bodies; at least all pairs of them are tested
  const SphereOf<Real>* spheres = nullptr;
  std::uint32_t* ids = nullptr;
  CullArrays<Cull> cull = {};
  std::array<Tree<Cull>, kMaxTrees> trees;  ///< coarsest first
  std::size_t tree_count = 0;
};

/// Memory for so many sorted bodies, and `out` pointing to it. False when there is none.
template <class Real, class Cull>
bool reserve_sorted(OrderMemory& memory, std::size_t bodies, Ordered<Real, Cull>& out) noexcept;

/// Orders the valid bodies. The survey's giants are left out; places for `out.scanned` bodies in no
/// grid are left for the caller to fill.
template <class Real, class Cull>
std::optional<Error> order(const Means& means, const Source<Real>& source,
                           const Survey<Real>& survey, const Plan& plan, OrderMemory& memory,
                           Ordered<Real, Cull>& out);

/// Fills the places of scanned bodies with the survey's giants.
template <class Real, class Cull>
void place_giants(const Means& means, const Source<Real>& source, const Survey<Real>& survey,
                  const Plan& plan, OrderMemory& memory, Ordered<Real, Cull>& out) noexcept;

}  // namespace harpoon::broad
