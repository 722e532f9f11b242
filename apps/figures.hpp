#pragma once

// The paper's figures as data: which counts, which reference values.

#include <cstddef>
#include <vector>

#include "bench/json.hpp"
#include "bench/round_robin.hpp"

namespace harpoon::app {

/// Section VI: time of a real collision on ODE and on the AFU.
inline constexpr double kPaperOdeNs = 102;
inline constexpr double kPaperAfuNs = 86;
/// Above so many collisions the paper's AFU wins.
inline constexpr std::size_t kPaperBreakEven = 250;

/// 10 to 1000 step 10.
std::vector<std::size_t> figure6_counts();
/// 1000 to 90000 step 1000.
std::vector<std::size_t> figure7_counts();

/// A legend's text: "cpu f32, 1 thread".
std::string series_label(const bench::Label& label);

/// A figure of the report: its series and the paper's values as reference lines.
bench::Json figure_json(const std::string& id, const std::string& title,
                        const std::vector<bench::Series>& series);

/// Rows of a figure's CSV, header included: label, device, precision, threads, modelled, count,
/// total_us, total_us_low, total_us_high.
std::string figure_csv(const std::vector<bench::Series>& series);

}  // namespace harpoon::app
