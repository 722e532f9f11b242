#pragma once

// Tells the process with the drop-in from the one with stock libode.

namespace harpoon::bench {

/// Whether this process has the drop-in in front of libode.
bool drop_in_is_interposed();

}  // namespace harpoon::bench
