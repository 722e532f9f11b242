#pragma once

// What a set of results looks like on a terminal.

#include <string>

#include "apps/table.hpp"
#include "bench/results.hpp"

namespace harpoon::app {

/// The table, and below it copy bandwidth, clock overhead and notes. Of a sweep, ten counts.
std::string describe_results(const Terminal& terminal, const bench::ResultSet& results);

}  // namespace harpoon::app
