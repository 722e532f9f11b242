#pragma once

// What collision alone gains: dSpaceCollide with dCollide in the callback, stock libode and the
// drop-in on twin worlds.

#include <functional>
#include <string>
#include <vector>

#include "bench/interrupt.hpp"
#include "bench/machine.hpp"
#include "bench/ode/drop_in_world.hpp"
#include "bench/stats.hpp"
#include "harpoon/error.hpp"

namespace harpoon::bench {

/// Stock simple and quadtree spaces take minutes a step beyond this many geoms.
inline constexpr std::size_t kMaxSlowSpaceGeoms = 20000;

struct DropInPlan {
  DropInKind kind = DropInKind::packed;
  std::size_t geoms = 10000;
  std::vector<SpaceKind> spaces;
  double seconds = 2;  ///< of measuring for each space, at least five steps
  std::uint64_t seed = 1;
};

struct DropInRow {
  SpaceKind space = SpaceKind::hash;
  Summary stock_ms, harpoon_ms;  ///< of the collision in a step
  double speedup = 0;            ///< ratio of the medians
  std::uint64_t pairs = 0, contacts = 0;
  bool identical = false;  ///< callbacks, their order and all contacts, in the steps compared
};

struct DropInOutcome {
  std::vector<DropInRow> rows;
  std::vector<std::string> notes;
};

/// `stock` and errors: as measure_twins.
Result<DropInOutcome> run_drop_in(const DropInPlan& plan, int stock,
                                  const std::function<void(double)>& share,
                                  const Interrupted& interrupted);

/// The JSON object documented in docs/ode.md, indented, with a final newline.
std::string drop_in_json(const DropInPlan& plan, const DropInOutcome& outcome,
                         const Machine& machine, const std::string& command);

}  // namespace harpoon::bench
