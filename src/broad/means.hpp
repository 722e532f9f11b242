#pragma once

// Threads and instruction set of a call.

#include "base/workers.hpp"
#include "broad/kernels.hpp"

namespace harpoon::broad {

struct Means : Workers {
  const KernelTable* kernels;
};

}  // namespace harpoon::broad
