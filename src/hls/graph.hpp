#pragma once

// The dataflow graph that a collider call records: nodes in topological order, equal expressions
// shared. It knows nothing of cycles (pipeline.hpp) or of SystemVerilog (emit.hpp).

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "hls/cells.hpp"

namespace harpoon::hls {

using NodeId = std::uint32_t;

/// A node. Arguments come before it in the graph. `bits` is a constant's binary32 pattern. `name`
/// is a SystemVerilog identifier, empty until given.
struct Node {
  Op op;
  std::array<NodeId, 3> arguments;
  std::uint32_t bits;
  std::string name;
};

/// An output of the graph, or an input, by name.
struct Port {
  std::string name;
  NodeId node;
};

/// Grows by recording; after `freeze` only expressions that were recorded before can be looked up.
/// Throws std::logic_error on misuse: it serves a tool and its tests, not the library.
class Graph {
 public:
  NodeId input(const std::string& name);
  NodeId constant(float number);

  /// The node that applies `op`; an existing one if the same was recorded before. Folds what is
  /// exact and changes no bits: operations on constants, 1 * a, !!a, select(m, a, a).
  NodeId apply(Op op, NodeId a, NodeId b = 0, NodeId c = 0);

  /// a / b, of which hardware has only 1 / b.
  NodeId divide(NodeId a, NodeId b);

  void output(const std::string& name, NodeId node);

  void freeze() { frozen_ = true; }

  /// Gives a node the name its value has in the source. A node keeps its first name.
  void name(NodeId node, const std::string& name);

  /// Names the nodes that have none after their operation and arguments. Names are unique then.
  void finish_names();

  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<NodeId>& inputs() const { return inputs_; }
  [[nodiscard]] const std::vector<Port>& outputs() const { return outputs_; }
  [[nodiscard]] std::span<const NodeId> arguments(NodeId node) const;

  /// The same graph without what no output needs, in an order that depends on the expressions only:
  /// C++ leaves open which operand of a + b is recorded first. Inputs stay, also unused ones.
  [[nodiscard]] Graph canonical() const;

 private:
  using Key = std::tuple<Op, std::array<NodeId, 3>, std::uint32_t>;

  NodeId copy_into(Graph& to, NodeId node, std::map<NodeId, NodeId>& copies) const;
  NodeId insert(Op op, std::array<NodeId, 3> arguments, std::uint32_t bits);
  [[nodiscard]] bool is_constant(NodeId node, float number) const;

  std::vector<Node> nodes_;
  std::vector<NodeId> inputs_;
  std::vector<Port> outputs_;
  std::map<Key, NodeId> known_;
  bool frozen_ = false;
};

/// What the cell of `op` computes from the bits of its arguments (a bit is 0 or 1). Arithmetic
/// gives 0x7fc00000 for every NaN, as the cells do.
std::uint32_t apply_cell(Op op, std::uint32_t a, std::uint32_t b, std::uint32_t c);

/// The outputs of the graph for the given inputs, in the order of outputs() and inputs().
std::vector<std::uint32_t> evaluate(const Graph& graph, std::span<const std::uint32_t> inputs);

/// "p1.x" as a SystemVerilog identifier.
std::string identifier(std::string name);

}  // namespace harpoon::hls
