#pragma once

// A world of the drop-in's benchmark: geoms with bodies in one space, moved by numbers that depend
// on the seed and the step only, so that twins stay alike.

#include <ode/ode.h>

#include <cstdint>
#include <string_view>
#include <vector>

#include "bench/ode/collision_calls.hpp"
#include "bench/ode/drop_in_bench.hpp"

namespace harpoon::bench {

class DropInWorld {
 public:
  DropInWorld(DropInKind kind, std::string_view space, std::size_t geoms, std::uint64_t seed);
  ~DropInWorld();
  DropInWorld(const DropInWorld&) = delete;
  DropInWorld& operator=(const DropInWorld&) = delete;

  /// Moves every geom, unless the world is asleep.
  void move(unsigned step);

  struct Step {
    std::uint64_t pairs = 0, contacts = 0;
    double ms = 0;
  };
  /// One collision step, timed.
  Step collide(const CollisionCalls& calls);
  /// The same, untimed: a hash of all callbacks in order and of the bits of all contacts.
  std::uint64_t fingerprint(const CollisionCalls& calls);

 private:
  void add(dGeomID geom, double x, double y, double z);
  void add_ground();

  const DropInKind kind_;
  const std::uint64_t seed_;
  double extent_ = 0;
  dWorldID world_;
  dSpaceID space_ = nullptr;
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
