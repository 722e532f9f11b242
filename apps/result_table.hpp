#pragma once

// What a set of results looks like on a terminal.

#include <string>
#include <vector>

#include "apps/table.hpp"
#include "bench/results.hpp"

#if HARPOON_WITH_ODE
#include "bench/ode/targets.hpp"
#endif

namespace harpoon::app {

/// The table, and below it copy bandwidth, clock overhead, the machine's load and notes. Of a
/// sweep, ten counts.
std::string describe_results(const Terminal& terminal, const bench::ResultSet& results);

#if HARPOON_WITH_ODE
/// The table of promised figures with verdicts, and below it the commands that measure each alone.
std::string describe_targets(const Terminal& terminal, const std::vector<bench::Target>& targets);
#endif

}  // namespace harpoon::app
