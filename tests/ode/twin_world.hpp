#pragma once

// Two copies of one ODE world, changed by one script: one is collided by stock libode, the other by
// the drop-in. Every callback and every contact goes into a trace, by the numbers of geoms, so that
// traces of the two are the same when and only when the drop-in does what stock does.

#include <ode/ode.h>

#include <cstdint>
#include <vector>

#include "support/random.hpp"

namespace harpoon::test {

/// libode's own entry points, past whatever is interposed.
struct StockOde {
  void (*space_collide)(dSpaceID, void*, dNearCallback*);
  void (*space_collide2)(dGeomID, dGeomID, void*, dNearCallback*);
  int (*collide)(dGeomID, dGeomID, int, dContactGeom*, int);
  void (*geom_enable)(dGeomID);
  void (*geom_disable)(dGeomID);
};

/// Those of the library libode.so.8 itself.
const StockOde& stock_ode();
/// Those that this program is linked to: the drop-in's.
const StockOde& linked_ode();

enum class SpaceKind { simple, hash, sap, quadtree };

/// What is in a world and what may happen to it.
struct WorldPlan {
  SpaceKind kind = SpaceKind::simple;
  std::uint32_t geoms = 40;
  double extent = 4;     ///< geoms are within +- this
  bool lattice = false;  ///< coordinates are multiples of 1/4: ties and touching bounds
  bool spheres_only = false;
  bool toggles_in_callbacks = false;
  bool nested_calls = false;
  /// Callbacks change filters, bodies, poses, sizes and the members of spaces: only on a libode
  /// that does not check its locks.
  bool changes_in_callbacks = false;
  bool user_class = false;
  bool keeps_geoms = false;   ///< none is made, destroyed or moved between bodies after the start
  std::uint32_t others = 4;   ///< geoms in a second space to collide against the first; 0: none
  bool hash_others = false;   ///< the second is a hash space, else a simple one
  bool few_movers = false;    ///< mostly nothing but a few geoms change, the same ones for a while
  bool all_enabled = false;   ///< nothing is disabled or of size zero
  bool space_within = false;  ///< some of the geoms are in a space that is a geom of the space
};

class World {
 public:
  World(const StockOde& ode, const WorldPlan& plan, std::uint64_t seed);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// Changes things as the script says: the same for every world of the same plan and seed.
  void change();
  /// One dSpaceCollide with what the plan wants in callbacks.
  void collide();
  /// dSpaceCollide2 of the second space's geoms against the space, and of the two spaces.
  void collide_with_others();

  /// What callbacks saw since the last call: numbers of geoms and bits of contacts.
  std::vector<std::uint64_t> take_trace();

  // What happened, for tests that must not be vacuous.
  std::uint64_t callbacks = 0, contacts = 0, toggled = 0, added = 0, removed = 0, nested = 0,
                between_spaces = 0, moved_between = 0, changed_in_callbacks = 0;

 private:
  struct Slot {
    dGeomID geom = nullptr;
    dBodyID body = nullptr;
  };
  static void near(void* world, dGeomID o1, dGeomID o2);
  static void near_nested(void* world, dGeomID o1, dGeomID o2);
  void on_near(dGeomID o1, dGeomID o2);
  void note_contacts(dGeomID o1, dGeomID o2, int flags);
  void note(std::uint64_t value) { trace_.push_back(value); }
  dGeomID make_shape();
  void fill(std::uint32_t number);
  void place(std::uint32_t number);
  void change_one();
  void move_few();
  void collide_spaces();
  void move_other(dGeomID o1, dGeomID o2, std::uint64_t choice);
  void change_within(dGeomID o1, dGeomID o2, Random& choice);
  [[nodiscard]] std::size_t first_other() const { return slots_.size() - plan_.others; }
  double coordinate();
  double size();
  double size_of(Random& random) const;
  [[nodiscard]] std::uint64_t number_of(dGeomID geom) const;

  const StockOde& ode_;
  const WorldPlan plan_;
  Random random_;
  std::uint64_t in_call_ = 0;  ///< counts callbacks of a call, for choices within it
  std::uint64_t calls_ = 0;
  dWorldID world_;
  dSpaceID space_;
  dSpaceID others_;
  dSpaceID within_ = nullptr;
  std::vector<std::uint32_t> movers_;
  bool moves_others_ = false;  ///< callbacks may: the two spaces are being collided
  dTriMeshDataID mesh_;
  int user_class_ = -1;
  std::vector<Slot> slots_;
  std::vector<std::uint64_t> trace_;
};

}  // namespace harpoon::test
