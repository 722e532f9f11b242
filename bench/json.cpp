#include "bench/json.hpp"

namespace harpoon::bench {

Json machine_json(const Machine& machine) {
  return {{"cpu", machine.cpu},
          {"cores", machine.cores},
          {"memory_gb", machine.memory_gb},
          {"cache_mb", machine.cache_mb},
          {"os", machine.os},
          {"kernel", machine.kernel},
          {"compiler", machine.compiler},
          {"instruction_set", machine.instruction_set},
          {"ode", machine.ode},
          {"harpoon", machine.harpoon}};
}

Json head_json(const Machine& machine, const std::string& commit, const std::string& date,
               const std::string& command) {
  return {
      {"machine", machine_json(machine)}, {"commit", commit}, {"date", date}, {"command", command}};
}

Json load_json(const MachineLoad& load) {
  const auto known = [](double average) { return average < 0 ? Json(nullptr) : Json(average); };
  return {{"before", known(load.before)},
          {"after", known(load.after)},
          {"waiting", load.waiting ? Json(*load.waiting) : Json(nullptr)},
          {"busy", load.busy()}};
}

Json row_json(const ResultRow& row) {
  const Measurement& m = row.measured;
  const auto pairs = static_cast<double>(m.count);
  return {{"device", row.label.device},
          {"precision", row.label.precision},
          {"threads", row.label.threads},
          {"count", m.count},
          {"type", to_string(row.type)},
          {"format", row.label.format},
          {"ns_per_pair", row.ns_per_pair()},
          {"ns_per_pair_min", m.ns.min / pairs},
          {"ns_per_pair_low", m.ns.low / pairs},
          {"ns_per_pair_high", m.ns.high / pairs},
          {"modelled", row.label.modelled},
          {"speedup_vs_ode", row.speedup_vs_ode},
          {"speedup_low", row.speedup_range.low},
          {"speedup_high", row.speedup_range.high},
          {"gb_per_s", row.gb_per_s()},
          {"megabytes", row.megabytes()},
          {"runs", m.runs}};
}

}  // namespace harpoon::bench
