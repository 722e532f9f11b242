#pragma once

// Records pairs of one type from the running diamond world, or says that none occur.

#include <cstddef>

#include "bench/interrupt.hpp"
#include "bench/ode/diamond.hpp"
#include "bench/recording.hpp"
#include "harpoon/error.hpp"

namespace harpoon::bench {

/// Steps in a row without a pair of the wanted type after which a search gives up.
inline constexpr std::uint64_t kMaxBarrenSteps = 2000;

/// Runs the world from its start until `count` pairs of the type have occurred.
///
/// Grazing pairs (coincident centres) do not occur in the diamond, so they are made: at every step
/// each odd sphere 2i+1 is placed on the centre of sphere 2i, and those couples are the pairs. Such
/// a recording says `constructed`; its census is that of the world as it ran.
///
/// Errors: invalid_argument: bad parameters, or no pair of the type in kMaxBarrenSteps steps.
Result<Recording> record(const DiamondParameters& parameters, PairType type, std::size_t count,
                         const Interrupted& interrupted = {});

}  // namespace harpoon::bench
