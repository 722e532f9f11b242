#pragma once

// What whole programs gain: each program with stock libode and with the drop-in.

#include <functional>
#include <string>
#include <vector>

#include "bench/interrupt.hpp"
#include "bench/machine.hpp"
#include "bench/ode/program.hpp"
#include "bench/stats.hpp"
#include "harpoon/error.hpp"

namespace harpoon::bench {

struct ProgramPlan {
  std::vector<ProgramKind> programs;
  std::size_t geoms = 0;  ///< as make_program; 0 means each program's own
  double seconds = 2;     ///< of measuring for each program, at least five steps
  std::uint64_t seed = 1;
};

struct ProgramRow {
  ProgramKind program = ProgramKind::diamond10;
  std::size_t geoms = 0;
  Summary stock_step_ms, harpoon_step_ms;            ///< of a whole step
  Summary stock_collision_ms, harpoon_collision_ms;  ///< of the collision in it
  double pairs = 0, contacts = 0;                    ///< of a step, on average
  bool identical = false;  ///< the states of the twins, bit by bit, after every step

  /// Ratios of medians: collision in stock's step, the drop-in's gain in it and in the whole step,
  /// and the gain if collision took no time (Amdahl 1967).
  [[nodiscard]] double share() const;
  [[nodiscard]] double collision_speedup() const;
  [[nodiscard]] double speedup() const;
  [[nodiscard]] double limit() const { return 1 / (1 - share()); }
};

/// `stock` and errors: as measure_twins.
Result<std::vector<ProgramRow>> run_programs(const ProgramPlan& plan, int stock,
                                             const std::function<void(double)>& share,
                                             const Interrupted& interrupted);

/// The JSON object documented in docs/ode.md, indented, with a final newline.
std::string programs_json(const ProgramPlan& plan, const std::vector<ProgramRow>& rows,
                          const Machine& machine, const std::string& command);

}  // namespace harpoon::bench
