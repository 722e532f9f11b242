#pragma once

// The paper's way to time ODE (section IV.B, Figure 5): run the world; whenever a collision of the
// wanted type happens, execute it ten times and add the average; stop at nColMax.

#include <cstddef>
#include <span>
#include <vector>

#include "bench/interrupt.hpp"
#include "bench/ode/diamond.hpp"
#include "bench/pair_type.hpp"
#include "harpoon/error.hpp"

namespace harpoon::bench {

/// Executions of every collision, as in the paper.
inline constexpr unsigned kFigure5Executions = 10;

/// One run of Figure 5 up to the largest count. The run that stops at nColMax is the beginning of
/// every longer one, so one run gives the total at all counts.
struct Figure5Run {
  std::vector<double> total_ns;  ///< at each count asked for; the clock's own time is taken out
  double timer_overhead_ns = 0;  ///< taken out once per collision, divided by the executions
};

/// `counts` ascending. An execution is one stock `dCollide` for one contact. Ten executions that
/// took more than 50 times as long as the shortest ten so far were interrupted and are done again.
/// When interrupted, `total_ns` is shorter than `counts`.
/// Errors: invalid_argument (parameters; or no collision of the type in kMaxBarrenSteps steps,
/// as for PairType::grazing, which does not occur in the diamond).
Result<Figure5Run> time_as_figure5(const DiamondParameters& parameters, PairType type,
                                   std::span<const std::size_t> counts,
                                   const Interrupted& interrupted = {});

}  // namespace harpoon::bench
