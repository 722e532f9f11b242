#pragma once

// A geom's bounds as libode has them.

namespace harpoon::ode {

template <class Real>
struct BoundsBox {
  Real v[6];  ///< min x, max x, min y, max y, min z, max z
};

}  // namespace harpoon::ode
