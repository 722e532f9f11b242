#pragma once

// The scene's figures for the documentation: tables in Markdown and a plot in SVG, from a run of
// the scaling benchmark. Nothing here measures.

#include <string>
#include <vector>

#include "bench/machine.hpp"
#include "bench/scene/scaling.hpp"

namespace harpoon::bench {

/// Bytes that a stage of Harpoon's stateless call on spheres must move at least, every input read
/// once and every output written once.
struct StageBytes {
  std::uint64_t survey = 0, order = 0, search = 0, contacts = 0;
};
StageBytes stage_floor(std::uint64_t bodies, std::uint64_t contacts, bool f64);

/// Time by size, and by stage at the largest size, of every kind. `plot` is the name of the SVG.
std::string scaling_markdown(const std::vector<ScalingPoint>& points, const Machine& machine,
                             const std::string& command, const std::string& plot);

/// Nanoseconds a body over bodies, both logarithmic, a line for each kind.
std::string scaling_svg(const std::vector<ScalingPoint>& points);

}  // namespace harpoon::bench
