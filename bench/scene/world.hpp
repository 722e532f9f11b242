#pragma once

// Moving worlds of spheres for the scene benchmark. A world is a function of its kind, number of
// bodies and seed; every body moves by 2 % of its radius per frame in a direction of its own.

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "harpoon/records.hpp"

namespace harpoon::bench {

/// Radii are 0.5 metres unless said; bodies lie in memory in random order.
enum class WorldKind : std::uint8_t {
  gas,           ///< uniform in a cube, 5 % of its volume
  packed,        ///< jittered cubic lattice, 55 % of the volume
  polydisperse,  ///< radii 1:20 with uniform logarithm, uniform in a cube, 20 % of its volume
  bed,           ///< jittered face-centred cubic lattice, 72 % of the volume: a settled bed
  diamond,       ///< the paper's |i| + |j| + |k| <= h lattice of touching spheres, cut to size
  clusters,      ///< two packed clusters 10^6 metres apart
};

std::optional<WorldKind> parse_world_kind(std::string_view name);
std::string_view to_string(WorldKind kind);

class MovingWorld {
 public:
  MovingWorld(WorldKind kind, std::size_t bodies, std::uint64_t seed);

  [[nodiscard]] std::size_t size() const { return start_.size(); }
  [[nodiscard]] const std::vector<SphereF64>& start() const { return start_; }
  /// The bodies at a frame, as float: what every engine gets.
  void at(unsigned frame, std::vector<Sphere>& out) const;

 private:
  struct Step {
    double x, y, z;
  };
  std::vector<SphereF64> start_;
  std::vector<Step> step_;
};

}  // namespace harpoon::bench
