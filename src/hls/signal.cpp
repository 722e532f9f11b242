#include "hls/signal.hpp"

#include <stdexcept>

namespace harpoon::hls {
namespace {

NodeId record(Graph& graph, Op op, const Signal& a, const Signal& b) {
  const NodeId first = a.node_in(graph);
  const NodeId second = b.node_in(graph);
  return graph.apply(op, first, second);
}

Signal number(Op op, const Signal& a, const Signal& b) {
  Graph& graph = common_graph(a, b);
  return {graph, record(graph, op, a, b)};
}

Bit bit(Op op, const Signal& a, const Signal& b) {
  Graph& graph = common_graph(a, b);
  return {&graph, record(graph, op, a, b)};
}

}  // namespace

Graph& common_graph(const Signal& a, const Signal& b) {
  Graph* const graph = a.graph() ? a.graph() : b.graph();
  if (!graph) throw std::logic_error("an operation on two constants belongs to no graph");
  return *graph;
}

Signal operator+(const Signal& a, const Signal& b) {
  return number(Op::add, a, b);
}
Signal operator-(const Signal& a, const Signal& b) {
  return number(Op::sub, a, b);
}
Signal operator*(const Signal& a, const Signal& b) {
  return number(Op::mul, a, b);
}
Signal operator/(const Signal& a, const Signal& b) {
  Graph& graph = common_graph(a, b);
  const NodeId numerator = a.node_in(graph);
  return {graph, graph.divide(numerator, b.node_in(graph))};
}
Bit operator>(const Signal& a, const Signal& b) {
  return bit(Op::greater, a, b);
}
Bit operator<=(const Signal& a, const Signal& b) {
  return bit(Op::less_equal, a, b);
}
Bit operator<(const Signal& a, const Signal& b) {
  return b > a;
}
Bit operator>=(const Signal& a, const Signal& b) {
  return b <= a;
}
Bit operator!(const Bit& a) {
  return {a.graph, a.graph->apply(Op::logic_not, a.node)};
}
Bit operator||(const Bit& a, const Bit& b) {
  return {a.graph, a.graph->apply(Op::logic_or, a.node, b.node)};
}
Bit operator&&(const Bit& a, const Bit& b) {
  return {a.graph, a.graph->apply(Op::logic_and, a.node, b.node)};
}
Signal sqrt(const Signal& a) {
  Graph& graph = common_graph(a, a);
  return {graph, graph.apply(Op::sqrt, a.node_in(graph))};
}
Bit sqrt_greater(const Signal& a, const Signal& b) {
  return bit(Op::sqrt_greater, a, b);
}
Signal select(const Bit& mask, const Signal& if_set, const Signal& if_clear) {
  Graph& graph = *mask.graph;
  const NodeId set = if_set.node_in(graph);
  const NodeId clear = if_clear.node_in(graph);
  return {graph, graph.apply(Op::select, mask.node, set, clear)};
}

}  // namespace harpoon::hls
