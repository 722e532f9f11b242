#pragma once

// The AFU of the device catalogue. Which of afu_simulated.cpp and afu_absent.cpp defines it is
// decided at configure time: the simulation needs Verilator.

#include "apps/device_catalog.hpp"

namespace harpoon::app {

/// The AFU behind the harp profile, or why there is none.
CatalogEntry afu_entry();

}  // namespace harpoon::app
