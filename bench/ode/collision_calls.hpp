#pragma once

// Which collision detection a world of a benchmark asks: stock libode's functions or those that
// stand in front of them.

#include <ode/ode.h>

namespace harpoon::bench {

struct CollisionCalls {
  void (*space_collide)(dSpaceID, void*, dNearCallback*) = nullptr;
  int (*collide)(dGeomID, dGeomID, int, dContactGeom*, int) = nullptr;
};

/// libode's own functions, past the drop-in; null when libode cannot be found.
CollisionCalls stock_calls();

/// What this program is linked to: the drop-in's where it is interposed.
CollisionCalls linked_calls();

/// Whether this process has the drop-in in front of libode.
bool drop_in_is_interposed();

}  // namespace harpoon::bench
