#pragma once

// Random pairs that are hard for a collider, for self-tests: every flow, pairs that touch within a
// few units in the last place, very different magnitudes, and special values.

#include <cstdint>
#include <vector>

#include "harpoon/records.hpp"

namespace harpoon::bench {

/// `count` pairs, the same for the same seed. Kinds alternate, so that each eighth of the batch is
/// of one kind: two of them overlapping, one apart, one with coincident centres, one that touches
/// or misses by a few units in the last place, one of extreme magnitudes, one with radius 0, and
/// one with special values ({0, -0, smallest subnormal, 1, 1e30, max, inf, NaN} in any operand).
/// `finite` replaces the special values by overlapping pairs, for oracles that refuse them.
template <class Real>
std::vector<SpherePairOf<Real>> hard_pairs(std::uint64_t seed, std::size_t count, bool finite);

}  // namespace harpoon::bench
