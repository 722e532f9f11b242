#pragma once

// Algorithm 1 of the paper written out plainly, with its branches and its inner functions. It
// judges the devices, so it shares no code with the library's collider.

#include "harpoon/records.hpp"

namespace harpoon::bench {

/// Flow 1 gives a record of zeros with Flow::fake. Thread-safe.
Contact algorithm1(const SpherePair& pair);
ContactF64 algorithm1(const SpherePairF64& pair);

}  // namespace harpoon::bench
