#pragma once

// Indexed pairs on the cpu: find the pairs that touch, give each block its place in the output by
// a prefix sum, then write the contacts. Scratch memory is bounded, whatever the batch.

#include "base/executor.hpp"
#include "device/cpu/kernels.hpp"
#include "harpoon/device.hpp"

namespace harpoon::cpu {

/// Runs a batch whose buffers are valid (`validate`). Errors: invalid_index (output untouched),
/// capacity (the first contacts.size() hits are written), out_of_memory, executor_failed.
template <class Real>
Result<Outcome> run_indexed(const Kernels& kernels, Executor& executor,
                            const IndexedBatch<Real>& batch);

}  // namespace harpoon::cpu
