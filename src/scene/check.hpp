#pragma once

// Checks of the caller's bodies, shared by the doors of the scene.

#include <optional>

#include "harpoon/scene.hpp"

namespace harpoon::scene {

/// The error of a malformed view, if any. Throws std::bad_alloc only.
template <class Real>
std::optional<Error> check(const BodiesOf<Real>& bodies);
template <class Real>
std::optional<Error> check(const BoundsOf<Real>& boxes);

}  // namespace harpoon::scene
