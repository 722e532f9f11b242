#pragma once

// Places a graph's operations in time and balances its paths: a fully pipelined circuit that takes
// new inputs every cycle and never stalls. It can be run in C++, cycle by cycle; emit.hpp writes it
// as SystemVerilog.

#include <deque>
#include <functional>
#include <span>
#include <vector>

#include "hls/graph.hpp"

namespace harpoon::hls {

/// By node, in cycles after the inputs: when its operands enter and when its value is ready.
/// Constants are ready at 0 and never wait. Every node counts: give it a canonical graph.
struct Schedule {
  std::vector<int> start;
  std::vector<int> ready;
  int latency = 0;
};

/// Every operation as early as its operands allow, given the latency of each node.
Schedule schedule_asap(const Graph& graph, const std::function<int(NodeId)>& latency_of);

/// The same with the latencies of the cells.
Schedule schedule_asap(const Graph& graph);

/// Values that wait together from one cycle to another: one delay line as wide as all of them.
struct Delay {
  int from;
  int to;
  std::vector<NodeId> nodes;
};

/// A scheduled graph with the delays that make all operands of an operation, and all outputs, meet.
/// A value needed at several cycles passes through a chain of delays that all its readers share.
struct Pipeline {
  Graph graph;
  Schedule schedule;
  std::vector<NodeId> operations;  // in order of start
  std::vector<Delay> delays;       // in order of from, to
};

/// Of the graph's canonical form, with names for all nodes.
Pipeline make_pipeline(const Graph& graph);

/// Runs a pipeline. One call of `step` is one clock cycle. Single-threaded.
class PipelineModel {
 public:
  explicit PipelineModel(const Pipeline& pipeline);

  /// Takes one set of inputs, returns the outputs of the set taken `schedule.latency` steps ago (of
  /// zeros before that).
  std::vector<std::uint32_t> step(std::span<const std::uint32_t> inputs);

 private:
  using Register = std::deque<std::uint32_t>;

  [[nodiscard]] std::uint32_t value_at(NodeId node, int cycle) const;

  const Pipeline& pipeline_;
  std::vector<Register> operation_registers_;                        // by operation
  std::vector<std::vector<Register>> delay_registers_;               // by delay and node
  std::vector<std::uint32_t> value_;                                 // by node, at its ready cycle
  std::vector<std::vector<std::pair<int, std::uint32_t>>> delayed_;  // by node: cycle, value
};

}  // namespace harpoon::hls
