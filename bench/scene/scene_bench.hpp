#pragma once

// Harpoon and its peers on the same moving world, frame by frame in turn: a disturbance of the
// machine falls on all of them alike.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bench/interrupt.hpp"
#include "bench/json.hpp"
#include "bench/machine.hpp"
#include "bench/scene/engine.hpp"
#include "bench/scene/world.hpp"
#include "bench/stats.hpp"
#include "harpoon/error.hpp"

namespace harpoon::bench {

/// Above this many bodies ODE is left out: its spaces take seconds to minutes a frame.
inline constexpr std::size_t kMaxOdeBodies = 20000;

struct ScenePlan {
  WorldKind kind = WorldKind::gas;
  std::size_t bodies = 100000;
  unsigned frames = 12;  ///< measured, after kWarmFrames
  unsigned threads = 1;  ///< of Harpoon; the peers have one
  bool f64 = false;
  std::uint64_t seed = 1;
  std::vector<std::string> against;  ///< of scene_peers()
};

/// Peers that this build holds.
std::vector<std::string> scene_peers();

struct SceneRow {
  std::string engine, precision;
  unsigned threads = 1;
  Summary ms;                                         ///< of a frame
  double update_ms = 0, broad_ms = 0, narrow_ms = 0;  ///< medians
  std::uint64_t pairs = 0, contacts = 0;              ///< of the last frame
  /// Bytes that must be moved at least; see SceneEngine::floor_bytes.
  std::uint64_t bytes_floor = 0;
  StageMs stages;      ///< medians; all zero but for Harpoon's stateless calls
  double speedup = 0;  ///< of Harpoon's stateless call over this row: ratio of medians
};

struct SceneOutcome {
  std::vector<SceneRow> rows;
  bool counts_agree = true;
  std::vector<std::string> notes;
};

/// Errors: the first one of an engine.
Result<SceneOutcome> run_scene(const ScenePlan& plan, const std::function<void(double)>& share,
                               const Interrupted& interrupted);

/// The elements of `results` for a plan's outcome.
Json scene_results(const ScenePlan& plan, const SceneOutcome& outcome);

/// What a document of results says beside them.
struct SceneSummary {
  unsigned frames = 0;
  std::uint64_t seed = 0;
  bool counts_agree = true;
  std::vector<std::string> notes;
};

/// The JSON object documented in docs/scene.md, indented, with a final newline.
std::string scene_document(const SceneSummary& summary, Json results, const Machine& machine,
                           const std::string& command);

/// The document of one run.
std::string scene_json(const ScenePlan& plan, const SceneOutcome& outcome, const Machine& machine,
                       const std::string& command);

}  // namespace harpoon::bench
