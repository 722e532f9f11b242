#pragma once

// The paper's claims beside our figures, with a verdict that follows from the numbers.

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

/// The smallest count from which on `device` is never slower than `other`; nothing when the last
/// count is lost. Counts that only one of them has are left out.
std::optional<std::size_t> break_even(const bench::Series& device, const bench::Series& other);

/// What a reader of the paper must know: its misprints, and what our figures are.
std::vector<std::string> report_notes(const Experiment& experiment);

}  // namespace harpoon::app
