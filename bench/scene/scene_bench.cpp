#include "bench/scene/scene_bench.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "bench/json.hpp"
#include "bench/scene/engine.hpp"
#if HARPOON_WITH_ODE
#include "bench/ode/runtime.hpp"
#endif

namespace harpoon::bench {
namespace {

constexpr unsigned kWarmFrames = 3;

using Engines = std::vector<std::unique_ptr<SceneEngine>>;

void add_peer(const std::string& name, std::span<const Sphere> spheres, Engines& engines,
              std::vector<std::string>& notes) {
  (void)spheres;
  (void)notes;
#if HARPOON_WITH_EMBREE
  if (name == "embree") engines.push_back(make_embree_engine(spheres));
#endif
#if HARPOON_WITH_BULLET
  if (name == "bullet") engines.push_back(make_bullet_engine(spheres));
#endif
#if HARPOON_WITH_FCL
  if (name == "fcl") engines.push_back(make_fcl_engine(spheres));
#endif
#if HARPOON_WITH_ODE
  if (name == "ode") {
    if (spheres.size() > kMaxOdeBodies) {
      notes.push_back(fmt::format("ode takes part up to {} bodies", kMaxOdeBodies));
      return;
    }
    for (const char* space : {"sap", "hash", "quadtree"}) {
      engines.push_back(make_ode_engine(spheres, space));
    }
  }
#endif
}

Engines make_engines(const ScenePlan& plan, std::span<const Sphere> spheres,
                     std::vector<std::string>& notes) {
  Engines engines;
  for (const HarpoonMode mode : kHarpoonModes) {
    engines.push_back(make_harpoon_engine(mode, plan.f64, plan.threads));
  }
  for (const std::string& name : plan.against) add_peer(name, spheres, engines, notes);
  return engines;
}

/// What one engine did so far.
struct Record {
  std::vector<double> total, update, broad, narrow;
  std::vector<double> survey, order;
  EngineFrame last;

  void add(const EngineFrame& f) {
    total.push_back(f.total_ms());
    update.push_back(f.update_ms);
    broad.push_back(f.broad_ms);
    narrow.push_back(f.narrow_ms);
    survey.push_back(f.stages.survey);
    order.push_back(f.stages.order);
  }
};

SceneRow to_row(const SceneEngine& engine, const Record& record, std::size_t bodies) {
  SceneRow row;
  row.engine = engine.name();
  row.precision = engine.precision();
  row.threads = engine.threads();
  row.ms = summarize(record.total);
  row.update_ms = summarize(record.update).median;
  row.broad_ms = summarize(record.broad).median;
  row.narrow_ms = summarize(record.narrow).median;
  if (record.last.stages.order > 0) {
    row.stages = {summarize(record.survey).median, summarize(record.order).median, row.broad_ms,
                  row.narrow_ms};
  }
  row.pairs = record.last.pairs;
  row.contacts = record.last.contacts;
  row.bytes_floor = engine.floor_bytes(bodies, row.contacts);
  return row;
}

}  // namespace

std::vector<std::string> scene_peers() {
  std::vector<std::string> names;
#if HARPOON_WITH_ODE
  names.emplace_back("ode");
#endif
#if HARPOON_WITH_BULLET
  names.emplace_back("bullet");
#endif
#if HARPOON_WITH_FCL
  names.emplace_back("fcl");
#endif
#if HARPOON_WITH_EMBREE
  names.emplace_back("embree");
#endif
  return names;
}

Result<SceneOutcome> run_scene(const ScenePlan& plan, const std::function<void(double)>& share,
                               const Interrupted& interrupted) {
#if HARPOON_WITH_ODE
  const OdeRuntime ode;
#endif
  const MovingWorld world(plan.kind, plan.bodies, plan.seed);
  std::vector<Sphere> spheres;
  world.at(0, spheres);
  SceneOutcome outcome;
  const Engines engines = make_engines(plan, spheres, outcome.notes);
  std::vector<Record> records(engines.size());
  const unsigned frames = kWarmFrames + plan.frames;
  for (unsigned frame = 0; frame < frames; ++frame) {
    world.at(frame, spheres);
    for (std::size_t e = 0; e < engines.size(); ++e) {
      if (must_stop(interrupted)) return outcome;
      auto done = engines[e]->frame(spheres);
      if (!done) return done.error();
      records[e].last = *done;
      if (frame >= kWarmFrames) records[e].add(*done);
      if (engines[e]->counts_contacts() && done->contacts != records[0].last.contacts) {
        outcome.counts_agree = false;
        outcome.notes.push_back(fmt::format("frame {}: {} finds {} contacts, harpoon {}", frame,
                                            engines[e]->name(), done->contacts,
                                            records[0].last.contacts));
      }
    }
    share(static_cast<double>(frame + 1) / frames);
  }
  for (std::size_t e = 0; e < engines.size(); ++e) {
    outcome.rows.push_back(to_row(*engines[e], records[e], plan.bodies));
    outcome.rows.back().speedup = outcome.rows.back().ms.median / outcome.rows[0].ms.median;
  }
  return outcome;
}

Json scene_results(const ScenePlan& plan, const SceneOutcome& outcome) {
  Json results = Json::array();
  for (const SceneRow& row : outcome.rows) {
    results.push_back({{"engine", row.engine},
                       {"kind", to_string(plan.kind)},
                       {"bodies", plan.bodies},
                       {"threads", row.threads},
                       {"precision", row.precision},
                       {"ms_per_frame", row.ms.median},
                       {"ms_min", row.ms.min},
                       {"ms_p90", row.ms.high},
                       {"update_ms", row.update_ms},
                       {"broad_ms", row.broad_ms},
                       {"narrow_ms", row.narrow_ms},
                       {"pairs", row.pairs},
                       {"contacts", row.contacts},
                       {"bytes_floor", row.bytes_floor}});
    if (row.stages.order > 0) {
      results.back()["stages_ms"] = {{"survey", row.stages.survey},
                                     {"order", row.stages.order},
                                     {"search", row.stages.search},
                                     {"contacts", row.stages.contacts}};
    }
  }
  return results;
}

std::string scene_document(const SceneSummary& summary, Json results, const Machine& machine,
                           const std::string& command) {
  Json out = head_json(machine, build_commit(), timestamp(), command);
  out["frames"] = summary.frames;
  out["seed"] = summary.seed;
  out["counts_agree"] = summary.counts_agree;
  out["notes"] = summary.notes;
  out["results"] = std::move(results);
  return out.dump(2) + "\n";
}

std::string scene_json(const ScenePlan& plan, const SceneOutcome& outcome, const Machine& machine,
                       const std::string& command) {
  return scene_document({plan.frames, plan.seed, outcome.counts_agree, outcome.notes},
                        scene_results(plan, outcome), machine, command);
}

}  // namespace harpoon::bench
