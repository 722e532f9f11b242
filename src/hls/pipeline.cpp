#include "hls/pipeline.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

namespace harpoon::hls {
namespace {

bool is_operation(const Node& node) {
  return node.op != Op::input && node.op != Op::constant;
}

/// By node: the cycles at which someone reads it.
std::vector<std::set<int>> read_cycles(const Graph& graph, const Schedule& schedule) {
  std::vector<std::set<int>> cycles(graph.nodes().size());
  for (NodeId id = 0; id < graph.nodes().size(); ++id) {
    for (const NodeId argument : graph.arguments(id)) cycles[argument].insert(schedule.start[id]);
  }
  for (const Port& port : graph.outputs()) cycles[port.node].insert(schedule.latency);
  return cycles;
}

std::vector<Delay> balance(const Graph& graph, const Schedule& schedule) {
  const std::vector<std::set<int>> cycles = read_cycles(graph, schedule);
  std::map<std::pair<int, int>, std::vector<NodeId>> lines;
  for (NodeId id = 0; id < graph.nodes().size(); ++id) {
    if (graph.nodes()[id].op == Op::constant) continue;
    int from = schedule.ready[id];
    for (const int to : cycles[id]) {
      if (to > from) lines[{from, to}].push_back(id);
      from = to;
    }
  }
  std::vector<Delay> delays;
  for (auto& [span, nodes] : lines) delays.push_back({span.first, span.second, std::move(nodes)});
  return delays;
}

}  // namespace

Schedule schedule_asap(const Graph& graph, const std::function<int(NodeId)>& latency_of) {
  const std::size_t count = graph.nodes().size();
  Schedule out{std::vector<int>(count, 0), std::vector<int>(count, 0), 0};
  for (NodeId id = 0; id < count; ++id) {
    int start = 0;
    for (const NodeId argument : graph.arguments(id)) start = std::max(start, out.ready[argument]);
    out.start[id] = start;
    out.ready[id] = start + latency_of(id);
    out.latency = std::max(out.latency, out.ready[id]);
  }
  return out;
}

Schedule schedule_asap(const Graph& graph) {
  return schedule_asap(graph, [&](NodeId id) { return cell_of(graph.nodes()[id].op).latency; });
}

Pipeline make_pipeline(const Graph& graph) {
  Pipeline pipeline{graph.canonical(), {}, {}, {}};
  pipeline.graph.finish_names();
  pipeline.schedule = schedule_asap(pipeline.graph);
  const std::vector<Node>& nodes = pipeline.graph.nodes();
  for (NodeId id = 0; id < nodes.size(); ++id) {
    if (is_operation(nodes[id])) pipeline.operations.push_back(id);
  }
  std::stable_sort(pipeline.operations.begin(), pipeline.operations.end(), [&](NodeId a, NodeId b) {
    return pipeline.schedule.start[a] < pipeline.schedule.start[b];
  });
  pipeline.delays = balance(pipeline.graph, pipeline.schedule);
  return pipeline;
}

PipelineModel::PipelineModel(const Pipeline& pipeline)
    : pipeline_(pipeline),
      value_(pipeline.graph.nodes().size()),
      delayed_(pipeline.graph.nodes().size()) {
  for (const NodeId id : pipeline.operations) {
    const int latency = cell_of(pipeline.graph.nodes()[id].op).latency;
    operation_registers_.emplace_back(static_cast<std::size_t>(latency), 0);
  }
  for (const Delay& delay : pipeline.delays) {
    delay_registers_.emplace_back(delay.nodes.size(),
                                  Register(static_cast<std::size_t>(delay.to - delay.from), 0));
  }
}

std::uint32_t PipelineModel::value_at(NodeId node, int cycle) const {
  if (pipeline_.graph.nodes()[node].op == Op::constant) return pipeline_.graph.nodes()[node].bits;
  if (cycle == pipeline_.schedule.ready[node]) return value_[node];
  for (const auto& [at, value] : delayed_[node]) {
    if (at == cycle) return value;
  }
  throw std::logic_error("the pipeline is not balanced");
}

std::vector<std::uint32_t> PipelineModel::step(std::span<const std::uint32_t> inputs) {
  const Graph& graph = pipeline_.graph;
  const auto compute = [&](NodeId id) {
    std::array<std::uint32_t, 3> a{};
    std::size_t i = 0;
    for (const NodeId argument : graph.arguments(id)) {
      a[i++] = value_at(argument, pipeline_.schedule.start[id]);
    }
    return apply_cell(graph.nodes()[id].op, a[0], a[1], a[2]);
  };

  // What the registers hold.
  for (std::size_t i = 0; i < inputs.size(); ++i) value_[graph.inputs()[i]] = inputs[i];
  for (std::vector<std::pair<int, std::uint32_t>>& taps : delayed_) taps.clear();
  for (std::size_t i = 0; i < pipeline_.delays.size(); ++i) {
    const Delay& delay = pipeline_.delays[i];
    for (std::size_t k = 0; k < delay.nodes.size(); ++k) {
      delayed_[delay.nodes[k]].emplace_back(delay.to, delay_registers_[i][k].front());
    }
  }
  for (std::size_t i = 0; i < pipeline_.operations.size(); ++i) {
    const NodeId id = pipeline_.operations[i];
    value_[id] = operation_registers_[i].empty() ? compute(id) : operation_registers_[i].front();
  }
  std::vector<std::uint32_t> out;
  for (const Port& port : graph.outputs()) {
    out.push_back(value_at(port.node, pipeline_.schedule.latency));
  }

  // The clock edge.
  for (std::size_t i = 0; i < pipeline_.operations.size(); ++i) {
    Register& line = operation_registers_[i];
    if (line.empty()) continue;
    line.push_back(compute(pipeline_.operations[i]));
    line.pop_front();
  }
  for (std::size_t i = 0; i < pipeline_.delays.size(); ++i) {
    const Delay& delay = pipeline_.delays[i];
    for (std::size_t k = 0; k < delay.nodes.size(); ++k) {
      delay_registers_[i][k].push_back(value_at(delay.nodes[k], delay.from));
      delay_registers_[i][k].pop_front();
    }
  }
  return out;
}

}  // namespace harpoon::hls
