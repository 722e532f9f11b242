#include "hls/graph.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace harpoon::hls {
namespace {

std::uint32_t bits(float number) {
  return std::bit_cast<std::uint32_t>(number);
}

TEST(Graph, SharesEqualExpressions) {
  Graph graph;
  const NodeId a = graph.input("a");
  const NodeId b = graph.input("b");
  EXPECT_EQ(graph.apply(Op::sub, a, b), graph.apply(Op::sub, a, b));
  EXPECT_NE(graph.apply(Op::sub, a, b), graph.apply(Op::sub, b, a));
  EXPECT_NE(graph.apply(Op::sub, a, b), graph.apply(Op::add, a, b));
  EXPECT_EQ(graph.constant(0.5F), graph.constant(0.5F));
  EXPECT_NE(graph.constant(0.0F), graph.constant(-0.0F));
}

TEST(Graph, SharesWhereOperandsMayBeSwapped) {
  Graph graph;
  const NodeId a = graph.input("a");
  const NodeId b = graph.input("b");
  EXPECT_EQ(graph.apply(Op::add, a, b), graph.apply(Op::add, b, a));
  EXPECT_EQ(graph.apply(Op::mul, a, b), graph.apply(Op::mul, b, a));
  EXPECT_NE(graph.apply(Op::greater, a, b), graph.apply(Op::greater, b, a));
}

TEST(Graph, FoldsOnlyWhatChangesNoBits) {
  Graph graph;
  const NodeId a = graph.input("a");
  const NodeId one = graph.constant(1);
  const NodeId zero = graph.constant(0);
  EXPECT_EQ(graph.apply(Op::mul, one, a), a);
  EXPECT_EQ(graph.apply(Op::mul, a, one), a);
  EXPECT_EQ(graph.apply(Op::add, graph.constant(0.1F), graph.constant(0.2F)),
            graph.constant(0.1F + 0.2F));
  const NodeId mask = graph.apply(Op::greater, a, zero);
  EXPECT_EQ(graph.apply(Op::select, mask, a, a), a);
  EXPECT_EQ(graph.apply(Op::logic_not, graph.apply(Op::logic_not, mask)), mask);
  EXPECT_NE(graph.apply(Op::add, a, zero), a) << "-0 + 0 is +0";
  EXPECT_NE(graph.apply(Op::sub, a, a), zero) << "infinity - infinity is NaN";
  EXPECT_NE(graph.apply(Op::mul, a, zero), zero) << "infinity * 0 is NaN";
}

TEST(Graph, DividesOnlyOne) {
  Graph graph;
  const NodeId a = graph.input("a");
  const NodeId reciprocal = graph.divide(graph.constant(1), a);
  EXPECT_EQ(graph.nodes()[reciprocal].op, Op::recip);
  EXPECT_THROW(graph.divide(graph.constant(2), a), std::logic_error);
  EXPECT_THROW(graph.divide(a, a), std::logic_error);
}

TEST(Graph, RefusesToNameWhatIsNotComputed) {
  Graph graph;
  const NodeId a = graph.input("a");
  const NodeId sum = graph.apply(Op::add, a, a);
  graph.freeze();
  EXPECT_EQ(graph.apply(Op::add, a, a), sum);
  EXPECT_THROW(graph.apply(Op::mul, a, a), std::logic_error);
}

TEST(Graph, GivesEveryNodeAUniqueName) {
  Graph graph;
  const NodeId x = graph.input("p.x");
  const NodeId y = graph.input("p.y");
  const NodeId sum = graph.apply(Op::add, x, y);
  const NodeId square = graph.apply(Op::mul, sum, sum);
  graph.name(square, "square");
  graph.name(square, "another");
  graph.output("out", graph.apply(Op::sqrt, square));
  graph.finish_names();
  EXPECT_EQ(graph.nodes()[x].name, "p_x");
  EXPECT_EQ(graph.nodes()[sum].name, "add_p_x_p_y");
  EXPECT_EQ(graph.nodes()[square].name, "square");
  graph.name(graph.apply(Op::sqrt, sum), "square");
  EXPECT_THROW(graph.finish_names(), std::logic_error);
}

TEST(Graph, CanonicalFormForgetsTheOrderOfRecordingAndWhatIsDead) {
  const auto record = [](bool swapped) {
    Graph graph;
    const NodeId a = graph.input("a");
    const NodeId b = graph.input("b");
    NodeId left = 0;
    NodeId right = 0;
    if (swapped) {
      right = graph.apply(Op::mul, b, b);
      left = graph.apply(Op::mul, a, a);
    } else {
      left = graph.apply(Op::mul, a, a);
      right = graph.apply(Op::mul, b, b);
    }
    graph.apply(Op::sqrt, left);
    graph.output("sum", graph.apply(Op::sub, left, right));
    return graph.canonical();
  };
  const Graph first = record(false);
  const Graph second = record(true);
  ASSERT_EQ(first.nodes().size(), 5U);
  ASSERT_EQ(second.nodes().size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_EQ(first.nodes()[i].op, second.nodes()[i].op);
    EXPECT_EQ(first.nodes()[i].arguments, second.nodes()[i].arguments);
  }
}

TEST(ApplyCell, IsIeeeArithmeticWithOneNan) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  constexpr float kTiny = std::numeric_limits<float>::denorm_min();
  EXPECT_EQ(apply_cell(Op::add, bits(0.1F), bits(0.2F), 0), bits(0.1F + 0.2F));
  EXPECT_EQ(apply_cell(Op::sub, bits(kTiny), bits(kTiny), 0), bits(0.0F));
  EXPECT_EQ(apply_cell(Op::mul, bits(kTiny), bits(0.5F), 0), bits(0.0F));
  EXPECT_EQ(apply_cell(Op::mul, bits(kTiny), bits(0.75F), 0), bits(kTiny));
  EXPECT_EQ(apply_cell(Op::recip, bits(-0.0F), 0, 0), bits(-kInfinity));
  EXPECT_EQ(apply_cell(Op::sqrt, bits(-0.0F), 0, 0), bits(-0.0F));
  EXPECT_EQ(apply_cell(Op::sqrt, bits(-1.0F), 0, 0), 0x7fc00000U);
  EXPECT_EQ(apply_cell(Op::sub, bits(kInfinity), bits(kInfinity), 0), 0x7fc00000U);
  EXPECT_EQ(apply_cell(Op::greater, 0x7fc00000U, bits(0.0F), 0), 0U);
  EXPECT_EQ(apply_cell(Op::less_equal, 0x7fc00000U, bits(0.0F), 0), 0U);
  EXPECT_EQ(apply_cell(Op::less_equal, bits(-0.0F), bits(0.0F), 0), 1U);
  EXPECT_EQ(apply_cell(Op::sqrt_greater, bits(4.0F), bits(2.0F), 0), 0U);
  EXPECT_EQ(apply_cell(Op::select, 1, 7, 9), 7U);
  EXPECT_EQ(apply_cell(Op::logic_and, 1, 0, 0), 0U);
  EXPECT_EQ(apply_cell(Op::logic_or, 1, 0, 0), 1U);
  EXPECT_EQ(apply_cell(Op::logic_not, 1, 0, 0), 0U);
  EXPECT_THROW(apply_cell(Op::input, 0, 0, 0), std::logic_error);
}

TEST(Evaluate, FollowsInputsAndOutputsInOrder) {
  Graph graph;
  const NodeId a = graph.input("a");
  const NodeId b = graph.input("b");
  graph.output("difference", graph.apply(Op::sub, a, b));
  graph.output("b", b);
  graph.output("half", graph.constant(0.5F));
  const std::array<std::uint32_t, 2> in{bits(3.0F), bits(5.0F)};
  EXPECT_EQ(evaluate(graph, in), (std::vector<std::uint32_t>{bits(-2.0F), bits(5.0F), bits(0.5F)}));
}

}  // namespace
}  // namespace harpoon::hls
