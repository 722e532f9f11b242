#pragma once

// Stock dCollide on random pairs of many geoms: most calls wait for memory, which is ODE as a large
// scene has it.

#include <memory>

#include "bench/contestant.hpp"
#include "bench/indexed_scene.hpp"

namespace harpoon::bench {

/// One geom with a body per sphere. `scene` must outlive the result. Counts up to the scene's.
std::unique_ptr<Contestant> make_ode_cold(const IndexedScene& scene);

}  // namespace harpoon::bench
