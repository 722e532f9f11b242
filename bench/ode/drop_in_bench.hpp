#pragma once

// dSpaceCollide with dCollide in the callback: stock libode and the drop-in on twin worlds, step by
// step in turn. It needs a process in which the drop-in is interposed; it makes none itself.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/interrupt.hpp"
#include "bench/machine.hpp"
#include "bench/stats.hpp"
#include "harpoon/error.hpp"

namespace harpoon::bench {

/// Spheres have a radius of 0.5 metres. Worlds lie in the octant of positive coordinates, where a
/// stock hash space has most geoms in a bucket; geoms lie in memory in random order.
enum class DropInKind : std::uint8_t {
  packed,  ///< jittered face-centred cubic lattice, 72 % of the volume, all geoms moved each step
  gas,     ///< uniform in a cube, 5 % of its volume, all moved
  mixed,   ///< packed; a third each of spheres, boxes and capsules over a ground of 8,192 triangles
  asleep,  ///< packed, nothing moved
};
std::optional<DropInKind> parse_drop_in_kind(std::string_view name);
std::string_view to_string(DropInKind kind);

/// Stock simple and quadtree spaces take minutes a step beyond this many geoms.
inline constexpr std::size_t kMaxSlowSpaceGeoms = 20000;

struct DropInPlan {
  DropInKind kind = DropInKind::packed;
  std::size_t geoms = 10000;
  std::vector<std::string> spaces;  ///< of simple, hash, sap, quadtree
  double seconds = 2;               ///< of measuring for each space
  std::uint64_t seed = 1;
};

struct DropInRow {
  std::string space;
  Summary stock_ms, harpoon_ms;  ///< of a step
  double speedup = 0;            ///< ratio of the medians
  std::uint64_t pairs = 0, contacts = 0;
  bool identical = false;  ///< callbacks, their order and all contacts, in every step compared
};

struct DropInOutcome {
  std::vector<DropInRow> rows;
  std::vector<std::string> notes;
};

/// Errors: device_unavailable when the drop-in is not in front of libode.
Result<DropInOutcome> run_drop_in(const DropInPlan& plan, const std::function<void(double)>& share,
                                  const Interrupted& interrupted);

/// The JSON object documented in docs/ode.md, indented, with a final newline.
std::string drop_in_json(const DropInPlan& plan, const DropInOutcome& outcome,
                         const Machine& machine, const std::string& command);

}  // namespace harpoon::bench
