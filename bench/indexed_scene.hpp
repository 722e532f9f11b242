#pragma once

// Many distinct spheres and random pairs of them: what a scene larger than the caches asks for.
// Made, not recorded: positions are uniform in a cube whose side decides how many pairs overlap.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bench/pair_type.hpp"
#include "harpoon/records.hpp"

namespace harpoon::bench {

struct IndexedScene {
  PairType type = PairType::mixed;
  std::uint64_t seed = 0;
  std::vector<SphereF64> spheres;  ///< radius 0.1
  std::vector<IndexPair> pairs;    ///< two different spheres each, independent and uniform
  double hit_share = 0;            ///< share of the pairs that overlap, counted
};

/// Every pair is of the type: `real` overlaps, `fake` is apart, `grazing` has all spheres on one
/// point, `mixed` overlaps in about half the pairs. `sphere_count` >= 2.
IndexedScene make_indexed_scene(PairType type, std::size_t sphere_count, std::size_t pair_count,
                                std::uint64_t seed);

/// The spheres with every number rounded to Real.
template <class Real>
std::vector<SphereOf<Real>> convert(const std::vector<SphereF64>& spheres);

}  // namespace harpoon::bench
