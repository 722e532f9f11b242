#pragma once

// A world of the drop-in's benchmark, as a program that only moves and collides: geoms with bodies
// in one space, moved by numbers that depend on the seed and the step only, so that twins stay
// alike.

#include <ode/ode.h>

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "bench/ode/program.hpp"

namespace harpoon::bench {

/// Spheres have a radius of 0.5 metres. Worlds lie in the octant of positive coordinates, where a
/// stock hash space has most geoms in a bucket; geoms lie in memory in random order.
enum class DropInKind : std::uint8_t {
  packed,  ///< jittered face-centred cubic lattice, 72 % of the volume, all geoms moved each step
  gas,     ///< uniform in a cube, 5 % of its volume, all moved
  mixed,   ///< packed; a third each of spheres, boxes and capsules over a ground of 8,192 triangles
  asleep,  ///< packed, nothing moved
  chain,   ///< in a row along x, each touching the next
  fallen,  ///< gas, of which a twentieth has fallen out of the world, far below it
  cars,    ///< groups of five geoms close together, each in a space of its own in the space
};
std::optional<DropInKind> parse_drop_in_kind(std::string_view name);
std::string_view to_string(DropInKind kind);

enum class SpaceKind : std::uint8_t { simple, hash, sap, quadtree };
inline constexpr std::size_t kSpaceKinds = 4;
std::string_view to_string(SpaceKind kind);

class DropInWorld final : public Program {
 public:
  DropInWorld(DropInKind kind, SpaceKind space, std::size_t geoms, std::uint64_t seed);
  ~DropInWorld() override;
  DropInWorld(const DropInWorld&) = delete;
  DropInWorld& operator=(const DropInWorld&) = delete;

  /// Moves every geom, unless the world is asleep, and collides.
  Work step() override;
  /// The same, and hashes all callbacks in their order and the bits of all contacts.
  Work compared_step() override;
  [[nodiscard]] std::size_t geoms() const override { return bodies_.size(); }
  /// The hash of the last compared step.
  void append_state(std::vector<dReal>& state) const override;

 private:
  void move();
  Work collide(dNearCallback* callback);
  void add(dGeomID geom, double x, double y, double z);
  void add_ground();

  const DropInKind kind_;
  const std::uint64_t seed_;
  std::uint64_t steps_ = 0;
  std::uint64_t hash_ = 0;
  double extent_ = 0;
  dWorldID world_;
  dSpaceID space_ = nullptr;
  dSpaceID home_ = nullptr;  ///< of the geoms that are added
  dTriMeshDataID mesh_ = nullptr;
  std::vector<float> vertices_;
  std::vector<dTriIndex> triangles_;
  struct Body {
    dBodyID body;
    double x, y, z;
  };
  std::vector<Body> bodies_;
};

}  // namespace harpoon::bench
