#pragma once

// The paper's world as a program, with the paper's parameters.

#include "bench/ode/diamond.hpp"
#include "bench/ode/program.hpp"

namespace harpoon::bench {

class DiamondProgram final : public Program {
 public:
  explicit DiamondProgram(unsigned h_max);

  Work step() override;
  [[nodiscard]] std::size_t geoms() const override { return world_->size(); }
  void append_state(std::vector<dReal>& state) const override;

 private:
  std::unique_ptr<DiamondWorld> world_;
};

}  // namespace harpoon::bench
