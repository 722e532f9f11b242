#pragma once

// How far two runs of the same world part: distances between the same spheres at the same steps.

#include <string>
#include <string_view>
#include <vector>

#include "bench/lattice.hpp"
#include "harpoon/error.hpp"

namespace harpoon::bench {

/// The first line of a file of positions, without its end.
inline constexpr std::string_view kPositionsHeader = "step,sphere,x,y,z";

/// A line of a file of positions, with its end; metres, digits enough for every bit.
std::string position_line(unsigned step, std::size_t sphere, const Point& position);

/// Distances over all spheres at one step, metres.
struct Divergence {
  unsigned step = 0;
  double median = 0, largest = 0;
};

/// Compares two files of positions given as text, step by step in their order.
/// Errors: invalid_argument with the line: text that is no such file, or another step or sphere on
/// the same line of both. O(n log n) in the spheres, memory for those of one step.
Result<std::vector<Divergence>> compare_positions(std::string_view first, std::string_view second);

/// Both distances over the steps, on a logarithmic axis; distances of 0 are left out.
std::string divergence_svg(const std::vector<Divergence>& divergence, const std::string& caption);

}  // namespace harpoon::bench
