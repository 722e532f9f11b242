#pragma once

// The paper's claims beside our figures, with a verdict that follows from the numbers: from fastest
// times, and only where these were seen again, so that no other program decides it.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "apps/experiment.hpp"

namespace harpoon::app {

struct Claim {
  std::string paper;
  std::string ours;
  std::string verdict;
};

/// The claims of sections III.C and VI that this experiment can judge.
std::vector<Claim> judge_claims(const Experiment& experiment);

/// Where a device comes to be ahead of another. Judged by undisturbed times (Summary); no count
/// where it stays behind.
struct BreakEven {
  std::size_t first = 0;                ///< the smallest count that both have
  std::optional<std::size_t> from;      ///< the smallest count from which on it is ahead
  std::optional<std::size_t> earliest;  ///< the same, where unsure times are read in its favour
  std::optional<std::size_t> latest;    ///< and where they are read against it
  /// Ahead and behind by turns, for sure, at more than a tenth of the counts: there is no such
  /// place. (Fewer may be counts at which all runs of one of them were disturbed.)
  bool mixed = false;
};

/// Counts that only one of them has are left out.
BreakEven break_even(const bench::Series& device, const bench::Series& other);

/// What a reader of the paper must know: its misprints, and what our figures are.
std::vector<std::string> report_notes(const Experiment& experiment);

}  // namespace harpoon::app
