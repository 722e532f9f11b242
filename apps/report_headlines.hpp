#pragma once

// The few numbers that a reader should leave the report with. They are made here, beside the
// claims, and not in the page, so that one figure has one definition.

#include <string>
#include <vector>

#include "apps/experiment.hpp"
#include "bench/results.hpp"

namespace harpoon::app {

struct Headline {
  std::string value;
  std::string label;
  std::string detail;
  /// Modelled numbers are never mixed into a measured one: each headline is one or the other.
  bool modelled = false;
};

/// Best speed-ups, break-even point, throughput; those for which there are results. A number that
/// is not sure is given as a range, and one of a batch that fits in the caches says so.
std::vector<Headline> headlines(const Experiment& experiment, const bench::ResultSet& results);

}  // namespace harpoon::app
