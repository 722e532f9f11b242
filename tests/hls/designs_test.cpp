#include "hls/designs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

namespace harpoon::hls {
namespace {

using Names = std::set<std::string>;

NodeId find(const Graph& graph, const std::string& name) {
  for (NodeId id = 0; id < graph.nodes().size(); ++id) {
    if (graph.nodes()[id].name == name) return id;
  }
  ADD_FAILURE() << "no value is called " << name;
  return 0;
}

/// The node and all that it is computed from.
std::set<NodeId> cone(const Graph& graph, NodeId top) {
  std::set<NodeId> nodes{top};
  for (const NodeId argument : graph.arguments(top)) nodes.merge(cone(graph, argument));
  return nodes;
}

/// The parallel stages of sphere_sphere by the names of their values, counted from 1, when every
/// operation takes one step and the whole distance one too. The multiplexers that choose between
/// the flows take no step: Algorithm 2 leaves them out.
std::map<int, Names> stages(const Graph& graph) {
  const NodeId distance = find(graph, "d");
  const std::set<NodeId> inside = cone(graph, distance);
  const auto step = [&](NodeId id) {
    const Op op = graph.nodes()[id].op;
    if (op == Op::input || op == Op::constant || op == Op::select || op == Op::logic_not) return 0;
    return id == distance || !inside.contains(id) ? 1 : 0;
  };
  const Schedule schedule = schedule_asap(graph, step);
  std::map<int, Names> out;
  for (NodeId id = 0; id < graph.nodes().size(); ++id) {
    if (step(id) == 0 && !inside.contains(id)) continue;
    if (graph.nodes()[id].op == Op::input) continue;
    out[schedule.start[id] + 1].insert(graph.nodes()[id].name);
  }
  return out;
}

// The paper's Algorithm 2, with two readings. The distance is one step, so the subtraction and the
// squares inside it belong to Stage 1, where the paper also lists psub by itself. And the test of
// Flow 2, d <= 0, is in Stage 2 beside d > rsum: the paper's list does without Flow 2.
TEST(SphereSphere, HasTheStagesOfAlgorithm2) {
  const Pipeline pipeline = make_pipeline(design_sphere_sphere().graph);
  const std::map<int, Names> algorithm2{
      {1,
       {"d", "psub2_x", "psub2_y", "psub2_z", "d2_xy", "d2", "rsum", "psub_x", "psub_y", "psub_z",
        "rsub"}},
      {2, {"d1", "miss", "rsub_d", "rsum_d", "grazing"}},
      {3, {"cnormal_x", "cnormal_y", "cnormal_z", "k"}},
      {4, {"cnk_x", "cnk_y", "cnk_z"}},
      {5, {"cpos_x", "cpos_y", "cpos_z"}},
  };
  EXPECT_EQ(stages(pipeline.graph), algorithm2);
}

TEST(SphereSphere, StagesFollowEachOtherWithoutAWaitOnTheLongestPath) {
  const Pipeline pipeline = make_pipeline(design_sphere_sphere().graph);
  const auto start = [&](const char* name) {
    return pipeline.schedule.start[find(pipeline.graph, name)];
  };
  const auto ready = [&](const char* name) {
    return pipeline.schedule.ready[find(pipeline.graph, name)];
  };
  for (const char* name : {"psub_x", "rsum", "rsub"}) EXPECT_EQ(start(name), 0) << name;
  for (const char* name : {"d1", "miss", "grazing", "rsub_d", "rsum_d"}) {
    EXPECT_EQ(start(name), ready("d")) << name;
  }
  EXPECT_EQ(start("cnormal_y"), ready("d1"));
  EXPECT_EQ(start("k"), ready("rsub_d"));
  EXPECT_LE(ready("k"), start("cnk_y"));
  EXPECT_EQ(start("cnk_y"), ready("cnormal_y"));
  EXPECT_EQ(start("cpos_y"), ready("cnk_y"));
}

TEST(Designs, EveryOperationHasANameOfItsSource) {
  for (const auto& make :
       {design_sphere_sphere, design_sphere_miss, design_sphere_plane, design_aabb_overlap}) {
    const Graph graph = make().graph.canonical();
    for (const Node& node : graph.nodes()) {
      EXPECT_TRUE(node.op == Op::constant || !node.name.empty()) << cell_of(node.op).name;
    }
  }
}

TEST(Designs, MissTestNeedsNoRootAndNoDivision) {
  const Graph graph = design_sphere_miss().graph.canonical();
  const auto count = [&](Op op) {
    return std::count_if(graph.nodes().begin(), graph.nodes().end(),
                         [&](const Node& node) { return node.op == op; });
  };
  EXPECT_EQ(count(Op::sqrt) + count(Op::recip), 0);
  EXPECT_EQ(count(Op::add) + count(Op::sub), 6);
  EXPECT_EQ(count(Op::mul), 3);
  EXPECT_EQ(count(Op::sqrt_greater), 1);
}

TEST(Designs, GeneratedFilesAreOneModuleOrPackageEach) {
  Names names;
  for (const GeneratedFile& file : generated_files()) {
    EXPECT_TRUE(names.insert(file.name).second) << file.name;
    const std::string unit = file.name.substr(0, file.name.find('.'));
    EXPECT_TRUE(file.text.find("\nmodule " + unit + " (") != std::string::npos ||
                file.text.find("\npackage " + unit + ";") != std::string::npos)
        << file.name;
  }
  EXPECT_EQ(names.size(), 6U);
}

}  // namespace
}  // namespace harpoon::hls
