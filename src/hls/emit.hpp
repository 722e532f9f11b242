#pragma once

// Writes a pipeline as a readable SystemVerilog module built from the floating-point cells, in the
// subset that both Verilator and stock yosys read.

#include <string>

#include "hls/pipeline.hpp"

namespace harpoon::hls {

/// What the head comment of a module says besides the schedule: the collider's source file and a
/// sentence on what the module computes.
struct Description {
  std::string module;
  std::string source;
  std::string purpose;
};

/// The module's text. Inputs are named <name>_i, outputs <name>_o; a value that waits until cycle c
/// is <name>_t<c>.
std::string emit_module(const Pipeline& pipeline, const Description& description);

/// fp_latency_pkg: the latencies of kCells, against which the cells check themselves.
std::string emit_latency_package();

/// "a + b" for a node, over the names of its arguments: a line of the schedule.
std::string expression(const Graph& graph, NodeId node);

}  // namespace harpoon::hls
