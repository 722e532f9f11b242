#pragma once

// What the user asks of the drop-in: one value, read from the environment by the preload or filled
// in by a caller.

#include <string>

#include "harpoon/error.hpp"

namespace harpoon::ode {

/// What happens where stock libode fails (docs/ode.md).
enum class Policy {
  compat,  ///< stock behaviour where stock works; the process lives where stock aborts
  fixed,   ///< as compat, and the pairs that a stock hash space misses are reported
  strict,  ///< as compat, but calls that stock aborts on are left to stock
};

struct Options {
  Policy policy = Policy::compat;
  /// Every callback sequence and every contact is compared with stock.
  bool verify = false;
  bool statistics = false;
  std::string device = "cpu";
  /// Contacts of spheres in binary32 on the device; otherwise they have stock's bits.
  bool single_precision_contacts = false;
  /// Whether every change of a geom is reported to the engine; otherwise each call reads all geoms.
  bool changes_are_reported = true;
  /// Callbacks may change what is being collided, and are to see what libode makes of that.
  bool callbacks_may_change = true;
  /// Spaces with fewer geoms are left to libode. By measurement (`harpoon bench ode`).
  int min_geoms_simple = 160;
  int min_geoms_hash = 8;
  int min_geoms_sap = 65;
  int min_geoms_quadtree = 64;
  int min_geoms_scan = 64;  ///< dSpaceCollide2 on this space
};

/// Options by a function that gives the value of an environment variable or null: HARPOON_ODE
/// (compat, fixed, strict), HARPOON_VERIFY and HARPOON_STATS (1 or 0), HARPOON_DEVICE (a device's
/// name), HARPOON_PRECISION (exact, f32), HARPOON_MIN_GEOMS (one number for all kinds). Errors:
/// invalid_argument (any other value).
Result<Options> read_options(const char* (*variable)(const char* name));

}  // namespace harpoon::ode
