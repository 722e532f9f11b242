#pragma once

// Bodies of three shapes dropped into a pen, where they come to lie on each other.

#include "bench/ode/body_world.hpp"

namespace harpoon::bench {

class PileProgram final : public BodyWorld {
 public:
  PileProgram(std::size_t bodies, std::uint64_t seed);

  /// 1.2 seconds: most bodies lie on others.
  [[nodiscard]] unsigned settling_steps() const override { return 120; }
};

}  // namespace harpoon::bench
