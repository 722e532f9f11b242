#include "hls/signal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace harpoon::hls {
namespace {

long count(const Graph& graph, Op op) {
  return std::count_if(graph.nodes().begin(), graph.nodes().end(),
                       [&](const Node& node) { return node.op == op; });
}

TEST(Signal, RecordsEachOperatorAsItsCell) {
  Graph graph;
  const Signal a(graph, graph.input("a"));
  const Signal b(graph, graph.input("b"));
  const auto op_of = [&](const Signal& s) { return graph.nodes()[s.node_in(graph)].op; };
  EXPECT_EQ(op_of(a + b), Op::add);
  EXPECT_EQ(op_of(a - b), Op::sub);
  EXPECT_EQ(op_of(a * b), Op::mul);
  EXPECT_EQ(op_of(Signal(1) / b), Op::recip);
  EXPECT_EQ(op_of(sqrt(a)), Op::sqrt);
  EXPECT_EQ(op_of(select(a > b, a, b)), Op::select);
  EXPECT_EQ(graph.nodes()[(a > b).node].op, Op::greater);
  EXPECT_EQ((a < b).node, (b > a).node);
  EXPECT_EQ(graph.nodes()[(a <= b).node].op, Op::less_equal);
  EXPECT_EQ((a >= b).node, (b <= a).node);
  EXPECT_EQ(graph.nodes()[(a > b && b > a).node].op, Op::logic_and);
  EXPECT_EQ(graph.nodes()[(a > b || b > a).node].op, Op::logic_or);
  EXPECT_EQ(graph.nodes()[sqrt_greater(a, b).node].op, Op::sqrt_greater);
}

TEST(Signal, ConstantsJoinTheGraphOfTheOtherOperand) {
  Graph graph;
  const Signal a(graph, graph.input("a"));
  const Signal half = Signal(0.5) * a;
  const Node& node = graph.nodes()[half.node_in(graph)];
  EXPECT_EQ(graph.nodes()[node.arguments[0]].op, Op::constant);
  EXPECT_THROW(Signal(1) + Signal(2), std::logic_error);
  EXPECT_THROW(Signal(2) / a, std::logic_error);
}

// The operations of Algorithm 1, counted by hand.
TEST(Signal, SphereSphereRecordsItsOperationsOnce) {
  Graph graph;
  const auto in = [&](const char* name) { return Signal(graph, graph.input(name)); };
  const SphereArg<Signal> s1{{in("x1"), in("y1"), in("z1")}, in("r1")};
  const SphereArg<Signal> s2{{in("x2"), in("y2"), in("z2")}, in("r2")};
  sphere_sphere<Signal>(s1, s2);
  EXPECT_EQ(count(graph, Op::add), 2 + 1 + 3);      // squared length, r1 + r2, position
  EXPECT_EQ(count(graph, Op::sub), 3 + 1 + 1 + 1);  // p1 - p2, r2 - r1, both minus d
  EXPECT_EQ(count(graph, Op::mul), 3 + 3 + 1 + 3);  // squares, normal, k, normal * k
  EXPECT_EQ(count(graph, Op::sqrt), 1);
  EXPECT_EQ(count(graph, Op::recip), 1);
  sphere_sphere<Signal>(s1, s2);
  EXPECT_EQ(count(graph, Op::mul), 10) << "a second call adds nothing";
}

}  // namespace
}  // namespace harpoon::hls
