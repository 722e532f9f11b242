#pragma once

// A recorded collision once more in stock ODE.

#include <vector>

#include "ode/frame_file.hpp"

namespace harpoon::app {

/// The pairs that stock ODE reports for the frame's geoms in a new space, in its order. Throws
/// CommandError where stock would abort.
std::vector<IndexPair> collide_in_stock(const ode::CollisionFrame& frame);

}  // namespace harpoon::app
