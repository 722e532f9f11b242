#include "bench/ode/program_bench.hpp"

#include "bench/json.hpp"
#include "bench/ode/twin_bench.hpp"

namespace harpoon::bench {
namespace {

Result<ProgramRow> measure(const ProgramPlan& plan, ProgramKind kind, int stock,
                           const Interrupted& interrupted) {
  const Result<TwinOutcome> outcome = measure_twins(
      {.subject = ProgramSubject{kind, plan.geoms, plan.seed}, .seconds = plan.seconds}, stock,
      interrupted);
  if (!outcome) return outcome.error();
  ProgramRow row;
  row.program = kind;
  row.geoms = outcome->geoms;
  row.stock_step_ms = summarize(outcome->stock.step_ms);
  row.harpoon_step_ms = summarize(outcome->harpoon.step_ms);
  row.stock_collision_ms = summarize(outcome->stock.collision_ms);
  row.harpoon_collision_ms = summarize(outcome->harpoon.collision_ms);
  row.pairs = outcome->pairs;
  row.contacts = outcome->contacts;
  row.identical = outcome->identical;
  return row;
}

Json to_json(const ProgramRow& row) {
  return {{"program", to_string(row.program)},
          {"geoms", row.geoms},
          {"stock_step_ms", row.stock_step_ms.median},
          {"harpoon_step_ms", row.harpoon_step_ms.median},
          {"stock_collision_ms", row.stock_collision_ms.median},
          {"harpoon_collision_ms", row.harpoon_collision_ms.median},
          {"collision_share", row.share()},
          {"collision_speedup", row.collision_speedup()},
          {"speedup", row.speedup()},
          {"limit", row.limit()},
          {"pairs", row.pairs},
          {"contacts", row.contacts},
          {"identical", row.identical},
          {"samples", row.harpoon_step_ms.samples}};
}

}  // namespace

double ProgramRow::share() const {
  return stock_collision_ms.median / stock_step_ms.median;
}
double ProgramRow::collision_speedup() const {
  return stock_collision_ms.median / harpoon_collision_ms.median;
}
double ProgramRow::speedup() const {
  return stock_step_ms.median / harpoon_step_ms.median;
}

Result<std::vector<ProgramRow>> run_programs(const ProgramPlan& plan, int stock,
                                             const std::function<void(double)>& share,
                                             const Interrupted& interrupted) {
  std::vector<ProgramRow> rows;
  for (const ProgramKind kind : plan.programs) {
    const Result<ProgramRow> row = measure(plan, kind, stock, interrupted);
    if (!row) return row.error();
    rows.push_back(*row);
    if (must_stop(interrupted)) return rows;
    share(static_cast<double>(rows.size()) / static_cast<double>(plan.programs.size()));
  }
  return rows;
}

std::string programs_json(const ProgramPlan& plan, const std::vector<ProgramRow>& rows,
                          const Machine& machine, const std::string& command) {
  Json results = Json::array();
  for (const ProgramRow& row : rows) results.push_back(to_json(row));
  const Json out = {{"machine", machine_json(machine)},
                    {"commit", build_commit()},
                    {"date", timestamp()},
                    {"command", command},
                    {"seed", plan.seed},
                    {"results", results}};
  return out.dump(2) + "\n";
}

}  // namespace harpoon::bench
