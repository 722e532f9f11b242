#include "hls/graph.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

namespace harpoon::hls {
namespace {

constexpr std::uint32_t kQuietNan = 0x7fc00000;
constexpr std::size_t kLongestDerivedName = 24;

float number(std::uint32_t bits) {
  return std::bit_cast<float>(bits);
}

std::uint32_t result(float value) {
  return std::isnan(value) ? kQuietNan : std::bit_cast<std::uint32_t>(value);
}

}  // namespace

std::uint32_t apply_cell(Op op, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  switch (op) {
    case Op::add:
      return result(number(a) + number(b));
    case Op::sub:
      return result(number(a) - number(b));
    case Op::mul:
      return result(number(a) * number(b));
    case Op::recip:
      return result(1.0F / number(a));
    case Op::sqrt:
      return result(std::sqrt(number(a)));
    case Op::select:
      return a ? b : c;
    case Op::greater:
      return number(a) > number(b);
    case Op::less_equal:
      return number(a) <= number(b);
    case Op::sqrt_greater:
      return std::sqrt(number(a)) > number(b);
    case Op::logic_or:
      return a | b;
    case Op::logic_and:
      return a & b;
    case Op::logic_not:
      return a ^ 1U;
    case Op::input:
    case Op::constant:
      break;
  }
  throw std::logic_error("inputs and constants are not computed");
}

std::span<const NodeId> Graph::arguments(NodeId node) const {
  const Node& n = nodes_[node];
  return {n.arguments.data(), static_cast<std::size_t>(cell_of(n.op).arguments)};
}

NodeId Graph::insert(Op op, std::array<NodeId, 3> arguments, std::uint32_t bits) {
  Key key{op, arguments, bits};
  // a + b is b + a, bit for bit when a NaN is a NaN; likewise * || &&
  if (op == Op::add || op == Op::mul || op == Op::logic_or || op == Op::logic_and) {
    std::array<NodeId, 3>& key_arguments = std::get<1>(key);
    if (key_arguments[1] < key_arguments[0]) std::swap(key_arguments[0], key_arguments[1]);
  }
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  if (frozen_ && op != Op::constant) {
    throw std::logic_error("named an expression that the collider does not compute");
  }
  nodes_.push_back({op, arguments, bits, {}});
  const auto id = static_cast<NodeId>(nodes_.size() - 1);
  known_.emplace(key, id);
  return id;
}

bool Graph::is_constant(NodeId node, float value) const {
  return nodes_[node].op == Op::constant &&
         nodes_[node].bits == std::bit_cast<std::uint32_t>(value);
}

NodeId Graph::input(const std::string& name) {
  const NodeId id = insert(Op::input, {}, static_cast<std::uint32_t>(inputs_.size()));
  nodes_[id].name = identifier(name);
  inputs_.push_back(id);
  return id;
}

NodeId Graph::constant(float value) {
  return insert(Op::constant, {}, result(value));
}

NodeId Graph::apply(Op op, NodeId a, NodeId b, NodeId c) {
  if (op == Op::mul && is_constant(a, 1)) return b;
  if (op == Op::mul && is_constant(b, 1)) return a;
  if (op == Op::select && b == c) return b;
  if (op == Op::logic_not && nodes_[a].op == Op::logic_not) return nodes_[a].arguments[0];
  const std::array<NodeId, 3> arguments{a, b, c};
  const Cell& cell = cell_of(op);
  const auto used = std::span(arguments).first(static_cast<std::size_t>(cell.arguments));
  const bool all_constant = std::all_of(
      used.begin(), used.end(), [this](NodeId node) { return nodes_[node].op == Op::constant; });
  if (all_constant && !cell.gives_bit) {
    return constant(number(apply_cell(op, nodes_[a].bits, nodes_[b].bits, nodes_[c].bits)));
  }
  return insert(op, arguments, 0);
}

NodeId Graph::divide(NodeId a, NodeId b) {
  if (!is_constant(a, 1)) throw std::logic_error("there is a cell for 1 / b, none for a / b");
  return apply(Op::recip, b);
}

void Graph::output(const std::string& name, NodeId node) {
  outputs_.push_back({identifier(name), node});
}

void Graph::name(NodeId node, const std::string& name) {
  if (nodes_[node].name.empty()) nodes_[node].name = identifier(name);
}

void Graph::finish_names() {
  std::set<std::string> taken;
  const auto take = [&](const std::string& name) {
    if (!taken.insert(name).second) throw std::logic_error("two nodes are called " + name);
  };
  for (const Node& node : nodes_) {
    if (!node.name.empty()) take(node.name);
  }
  for (NodeId id = 0; id < nodes_.size(); ++id) {
    Node& node = nodes_[id];
    if (!node.name.empty()) continue;
    std::string derived{cell_of(node.op).name};
    for (const NodeId argument : arguments(id)) derived.append("_").append(nodes_[argument].name);
    if (derived.size() > kLongestDerivedName || taken.contains(derived)) {
      derived = std::string(cell_of(node.op).name) + "_" + std::to_string(id);
    }
    take(derived);
    node.name = derived;
  }
}

NodeId Graph::copy_into(Graph& to, NodeId node, std::map<NodeId, NodeId>& copies) const {
  if (const auto found = copies.find(node); found != copies.end()) return found->second;
  const Node& copy = nodes_[node];
  std::array<NodeId, 3> copied_arguments{};  // those that the operation does not use stay 0
  std::size_t i = 0;
  for (const NodeId argument : arguments(node)) {
    copied_arguments[i++] = copy_into(to, argument, copies);
  }
  const NodeId id = to.insert(copy.op, copied_arguments, copy.bits);
  to.nodes_[id].name = copy.name;
  copies.emplace(node, id);
  return id;
}

Graph Graph::canonical() const {
  Graph out;
  std::map<NodeId, NodeId> copies;
  for (const NodeId id : inputs_) out.inputs_.push_back(copy_into(out, id, copies));
  for (const Port& port : outputs_) {
    out.outputs_.push_back({port.name, copy_into(out, port.node, copies)});
  }
  return out;
}

std::vector<std::uint32_t> evaluate(const Graph& graph, std::span<const std::uint32_t> inputs) {
  const std::vector<Node>& nodes = graph.nodes();
  std::vector<std::uint32_t> value(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Node& node = nodes[i];
    if (node.op == Op::input) {
      value[i] = inputs[node.bits];
    } else if (node.op == Op::constant) {
      value[i] = node.bits;
    } else {
      const auto& [a, b, c] = node.arguments;
      value[i] = apply_cell(node.op, value[a], value[b], value[c]);
    }
  }
  std::vector<std::uint32_t> out;
  for (const Port& port : graph.outputs()) out.push_back(value[port.node]);
  return out;
}

std::string identifier(std::string name) {
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

}  // namespace harpoon::hls
