#pragma once

// Checks that every device makes before it touches a batch's buffers. Index values are not checked
// here: that costs a pass over the pairs and each device has its own way.

#include <optional>

#include "harpoon/device.hpp"

namespace harpoon {

/// The first thing wrong with a batch: null, misaligned or overlapping buffers, too many pairs, too
/// few contacts. Empty when the batch can be run.
std::optional<Error> validate(const Batch& batch);

/// The error for a pair whose index is not below `spheres`.
Error index_error(std::uint64_t pair, const IndexPair& indices, std::uint64_t spheres);

/// The error for a full output, with the number of contacts that it needs.
Error contacts_capacity_error(std::uint64_t capacity, std::uint64_t needed);

}  // namespace harpoon
