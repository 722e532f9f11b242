#include "bench/ode/drop_in_bench.hpp"

#include <fmt/format.h>

#include "bench/json.hpp"
#include "bench/ode/twin_bench.hpp"

namespace harpoon::bench {
namespace {

Result<DropInRow> measure(const DropInPlan& plan, SpaceKind space, int stock,
                          const Interrupted& interrupted) {
  const Result<TwinOutcome> outcome =
      measure_twins({.subject = WorldSubject{plan.kind, space, plan.geoms, plan.seed},
                     .seconds = plan.seconds,
                     .compares_every = false},
                    stock, interrupted);
  if (!outcome) return outcome.error();
  DropInRow row;
  row.space = space;
  row.stock_ms = summarize(outcome->stock.collision_ms);
  row.harpoon_ms = summarize(outcome->harpoon.collision_ms);
  row.speedup = row.stock_ms.median / row.harpoon_ms.median;
  row.pairs = outcome->last.pairs;
  row.contacts = outcome->last.contacts;
  row.identical = outcome->identical;
  return row;
}

}  // namespace

Result<DropInOutcome> run_drop_in(const DropInPlan& plan, int stock,
                                  const std::function<void(double)>& share,
                                  const Interrupted& interrupted) {
  DropInOutcome outcome;
  for (std::size_t k = 0; k < plan.spaces.size(); ++k) {
    const SpaceKind space = plan.spaces[k];
    if (plan.geoms > kMaxSlowSpaceGeoms &&
        (space == SpaceKind::simple || space == SpaceKind::quadtree)) {
      outcome.notes.push_back(
          fmt::format("{} takes part up to {} geoms", to_string(space), kMaxSlowSpaceGeoms));
      continue;
    }
    const Result<DropInRow> row = measure(plan, space, stock, interrupted);
    if (!row) return row.error();
    outcome.rows.push_back(*row);
    if (must_stop(interrupted)) return outcome;
    share(static_cast<double>(k + 1) / static_cast<double>(plan.spaces.size()));
  }
  return outcome;
}

std::string drop_in_json(const DropInPlan& plan, const DropInOutcome& outcome,
                         const Machine& machine, const std::string& command) {
  Json results = Json::array();
  for (const DropInRow& row : outcome.rows) {
    results.push_back({{"space", to_string(row.space)},
                       {"kind", to_string(plan.kind)},
                       {"geoms", plan.geoms},
                       {"stock_ms", row.stock_ms.median},
                       {"harpoon_ms", row.harpoon_ms.median},
                       {"speedup", row.speedup},
                       {"pairs", row.pairs},
                       {"contacts", row.contacts},
                       {"identical", row.identical},
                       {"samples", row.harpoon_ms.samples}});
  }
  Json out = head_json(machine, build_commit(), timestamp(), command);
  out["seed"] = plan.seed;
  out["notes"] = outcome.notes;
  out["results"] = std::move(results);
  return out.dump(2) + "\n";
}

}  // namespace harpoon::bench
