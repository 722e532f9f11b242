#pragma once

/// The version of these headers; `version()` gives that of the library that was loaded.

#include <string_view>

#include "harpoon/export.hpp"

#define HARPOON_VERSION_MAJOR 0
#define HARPOON_VERSION_MINOR 1
#define HARPOON_VERSION_PATCH 0

namespace harpoon {

/// "major.minor.patch" of the loaded library. Static storage.
HARPOON_API std::string_view version() noexcept;

}  // namespace harpoon
