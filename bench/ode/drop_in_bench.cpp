#include "bench/ode/drop_in_bench.hpp"

#include <fmt/format.h>

#include <array>

#include "bench/json.hpp"
#include "bench/ode/collision_calls.hpp"
#include "bench/ode/drop_in_world.hpp"
#include "bench/ode/runtime.hpp"
#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

constexpr std::array<std::pair<std::string_view, DropInKind>, 4> kKinds = {{
    {"packed", DropInKind::packed},
    {"gas", DropInKind::gas},
    {"mixed", DropInKind::mixed},
    {"asleep", DropInKind::asleep},
}};
constexpr unsigned kWarmSteps = 2;
constexpr unsigned kLeastSteps = 5;
constexpr unsigned kMostSteps = 2000;
constexpr unsigned kComparedSteps = 3;

struct Sides {
  DropInWorld stock, ours;
  CollisionCalls stock_calls, our_calls;

  bool same_at(unsigned step) {
    stock.move(step);
    ours.move(step);
    return stock.fingerprint(stock_calls) == ours.fingerprint(our_calls);
  }
};

DropInRow measure(const DropInPlan& plan, const std::string& space,
                  const Interrupted& interrupted) {
  Sides sides{{plan.kind, space, plan.geoms, plan.seed},
              {plan.kind, space, plan.geoms, plan.seed},
              stock_calls(),
              linked_calls()};
  DropInRow row;
  row.space = space;
  row.identical = true;
  std::vector<double> stock_ms, our_ms;
  unsigned step = 0;
  double spent_ms = 0;
  while (step < kMostSteps && (step < kWarmSteps + kLeastSteps || spent_ms < plan.seconds * 1e3)) {
    if (interrupted()) return row;
    sides.stock.move(step);
    sides.ours.move(step);
    const DropInWorld::Step stock = sides.stock.collide(sides.stock_calls);
    const DropInWorld::Step ours = sides.ours.collide(sides.our_calls);
    spent_ms += stock.ms + ours.ms;
    row.identical = row.identical && stock.pairs == ours.pairs && stock.contacts == ours.contacts;
    row.pairs = ours.pairs;
    row.contacts = ours.contacts;
    if (step >= kWarmSteps) {
      stock_ms.push_back(stock.ms);
      our_ms.push_back(ours.ms);
    }
    ++step;
  }
  for (unsigned k = 0; k < kComparedSteps; ++k) {
    if (!sides.same_at(step + k)) row.identical = false;
  }
  row.stock_ms = summarize(stock_ms);
  row.harpoon_ms = summarize(our_ms);
  row.speedup = row.stock_ms.median / row.harpoon_ms.median;
  return row;
}

}  // namespace

std::optional<DropInKind> parse_drop_in_kind(std::string_view name) {
  for (const auto& [known, kind] : kKinds) {
    if (known == name) return kind;
  }
  return std::nullopt;
}

std::string_view to_string(DropInKind kind) {
  return kKinds[static_cast<std::size_t>(kind)].first;
}

Result<DropInOutcome> run_drop_in(const DropInPlan& plan, const std::function<void(double)>& share,
                                  const Interrupted& interrupted) {
  if (!drop_in_is_interposed()) {
    return Error{Errc::device_unavailable,
                 "libharpoon_ode is not in front of libode here. Preload it."};
  }
  const OdeRuntime ode;
  DropInOutcome outcome;
  for (std::size_t k = 0; k < plan.spaces.size(); ++k) {
    const std::string& space = plan.spaces[k];
    if (plan.geoms > kMaxSlowSpaceGeoms && (space == "simple" || space == "quadtree")) {
      outcome.notes.push_back(
          fmt::format("{} takes part up to {} geoms", space, kMaxSlowSpaceGeoms));
      continue;
    }
    outcome.rows.push_back(measure(plan, space, interrupted));
    share(static_cast<double>(k + 1) / static_cast<double>(plan.spaces.size()));
  }
  return outcome;
}

std::string drop_in_json(const DropInPlan& plan, const DropInOutcome& outcome,
                         const Machine& machine, const std::string& command) {
  Json results = Json::array();
  for (const DropInRow& row : outcome.rows) {
    results.push_back({{"space", row.space},
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
