#include "hls/pipeline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <map>
#include <random>
#include <stdexcept>

#include "hls/designs.hpp"

namespace harpoon::hls {
namespace {

constexpr unsigned kSeed = 20260310;

/// A graph of random operations over random earlier nodes.
Graph random_graph(std::mt19937& random) {
  Graph graph;
  std::vector<NodeId> numbers;
  std::vector<NodeId> masks;
  const auto pick = [&](const std::vector<NodeId>& from) { return from[random() % from.size()]; };
  for (const char* name : {"a", "b", "c", "d"}) numbers.push_back(graph.input(name));
  numbers.push_back(graph.constant(0.75F));
  masks.push_back(graph.apply(Op::greater, numbers[0], numbers[1]));
  constexpr std::array kNumberOps{Op::add, Op::sub, Op::mul, Op::recip, Op::sqrt, Op::select};
  constexpr std::array kBitOps{Op::greater, Op::less_equal, Op::sqrt_greater};
  constexpr std::array kLogicOps{Op::logic_and, Op::logic_or, Op::logic_not};
  for (int i = 0; i < 20; ++i) {
    switch (random() % 4) {
      case 0:
        masks.push_back(graph.apply(kBitOps[random() % 3], pick(numbers), pick(numbers)));
        break;
      case 1:
        masks.push_back(graph.apply(kLogicOps[random() % 3], pick(masks), pick(masks)));
        break;
      default: {
        const Op op = kNumberOps[random() % kNumberOps.size()];
        const NodeId first = op == Op::select ? pick(masks) : pick(numbers);
        numbers.push_back(graph.apply(op, first, pick(numbers), pick(numbers)));
      }
    }
  }
  graph.output("number", numbers.back());
  graph.output("other", pick(numbers));
  graph.output("mask", masks.back());
  return graph;
}

std::vector<std::uint32_t> random_inputs(std::mt19937& random, std::size_t count) {
  std::vector<std::uint32_t> in(count);
  for (std::uint32_t& word : in) word = static_cast<std::uint32_t>(random());
  return in;
}

/// The cycles at which a value can be had: when it is ready, and at the end of each of its delays.
std::map<NodeId, std::vector<int>> available(const Pipeline& pipeline) {
  std::map<NodeId, std::vector<int>> cycles;
  for (NodeId id = 0; id < pipeline.graph.nodes().size(); ++id) {
    cycles[id] = {pipeline.schedule.ready[id]};
  }
  for (const Delay& delay : pipeline.delays) {
    for (const NodeId id : delay.nodes) {
      EXPECT_EQ(cycles[id].back(), delay.from) << "delays of one value form one chain";
      cycles[id].push_back(delay.to);
    }
  }
  return cycles;
}

void expect_balanced(const Pipeline& pipeline) {
  const std::map<NodeId, std::vector<int>> cycles = available(pipeline);
  const auto expect_at = [&](NodeId id, int cycle) {
    if (pipeline.graph.nodes()[id].op == Op::constant) return;
    EXPECT_EQ(std::count(cycles.at(id).begin(), cycles.at(id).end(), cycle), 1);
  };
  for (const NodeId id : pipeline.operations) {
    int earliest = 0;
    for (const NodeId argument : pipeline.graph.arguments(id)) {
      expect_at(argument, pipeline.schedule.start[id]);
      earliest = std::max(earliest, pipeline.schedule.ready[argument]);
    }
    EXPECT_EQ(pipeline.schedule.start[id], earliest) << "as soon as possible";
  }
  for (const Port& port : pipeline.graph.outputs()) {
    expect_at(port.node, pipeline.schedule.latency);
  }
}

TEST(Pipeline, IsBalancedAndAsSoonAsPossible) {
  std::mt19937 random(kSeed);
  for (int i = 0; i < 200; ++i) expect_balanced(make_pipeline(random_graph(random)));
  expect_balanced(make_pipeline(design_sphere_sphere().graph));
  expect_balanced(make_pipeline(design_aabb_overlap().graph));
}

TEST(Pipeline, SharesOneChainOfDelays) {
  Graph graph;
  const NodeId a = graph.input("a");
  const NodeId root = graph.apply(Op::sqrt, a);
  const NodeId early = graph.apply(Op::mul, a, a);
  graph.output("late", graph.apply(Op::add, root, a));
  graph.output("middle", graph.apply(Op::add, early, a));
  const Pipeline pipeline = make_pipeline(graph);
  const int mul = cell_of(Op::mul).latency;
  const int sqrt = cell_of(Op::sqrt).latency;
  int cycles_of_a = 0;
  for (const Delay& delay : pipeline.delays) {
    const bool has_a = std::count(delay.nodes.begin(), delay.nodes.end(), NodeId{0}) > 0;
    if (has_a) cycles_of_a += delay.to - delay.from;
  }
  EXPECT_EQ(pipeline.graph.nodes()[0].name, "a");
  EXPECT_LT(mul, sqrt);
  EXPECT_EQ(cycles_of_a, sqrt) << "the delay for the early reader is part of that for the late one";
}

TEST(Pipeline, RunsCycleByCycleAsItsGraphEvaluates) {
  std::printf("seed %u\n", kSeed);
  std::mt19937 random(kSeed);
  int compared = 0;
  for (int i = 0; i < 100; ++i) {
    const Pipeline pipeline = make_pipeline(random_graph(random));
    PipelineModel model(pipeline);
    std::deque<std::vector<std::uint32_t>> expected;
    for (int cycle = 0; cycle < 300; ++cycle) {
      const std::vector<std::uint32_t> in = random_inputs(random, 4);
      expected.push_back(evaluate(pipeline.graph, in));
      const std::vector<std::uint32_t> out = model.step(in);
      if (cycle < pipeline.schedule.latency) continue;
      ASSERT_EQ(out, expected.front());
      expected.pop_front();
      ++compared;
    }
  }
  EXPECT_GT(compared, 10'000);
}

TEST(Pipeline, ModelRefusesAnUnbalancedPipeline) {
  Pipeline pipeline = make_pipeline(design_sphere_sphere().graph);
  pipeline.delays.pop_back();
  PipelineModel model(pipeline);
  const std::vector<std::uint32_t> in(8, 0);
  EXPECT_THROW(model.step(in), std::logic_error);
}

}  // namespace
}  // namespace harpoon::hls
