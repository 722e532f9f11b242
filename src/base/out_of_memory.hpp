#pragma once

// The one error that every room has.

#include "harpoon/error.hpp"

namespace harpoon {

inline Error out_of_memory() {
  return {Errc::out_of_memory, "out of memory"};
}

}  // namespace harpoon
