#pragma once

/// HARPOON_API marks what the shared library exports; everything else is hidden.

#if defined(_WIN32)
#define HARPOON_API
#else
#define HARPOON_API __attribute__((visibility("default")))
#endif
