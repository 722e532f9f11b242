#pragma once

/// Harpoon: which bodies touch, and where. Includes the whole public interface.

#include "harpoon/device.hpp"
#include "harpoon/error.hpp"
#include "harpoon/export.hpp"
#include "harpoon/records.hpp"
#include "harpoon/scene.hpp"
#include "harpoon/version.hpp"
