#pragma once

// hls::Signal: a number type that records. A collider called with Signals computes nothing; it
// leaves its dataflow in a Graph. The colliders' own templates are included here, over this type,
// just as scalar.hpp includes them over float.

#include <optional>

#include "hls/graph.hpp"

namespace harpoon::hls {

/// A binary32 number in a graph, or a constant that has not met one yet.
class Signal {
 public:
  explicit Signal(double number) : number_(static_cast<float>(number)) {}
  Signal(Graph& graph, NodeId node) : graph_(&graph), node_(node) {}

  [[nodiscard]] Graph* graph() const { return graph_; }
  [[nodiscard]] NodeId node_in(Graph& graph) const {
    return graph_ ? node_ : graph.constant(number_);
  }

 private:
  Graph* graph_ = nullptr;
  NodeId node_ = 0;
  float number_ = 0;
};

/// A truth value in a graph: the Mask of Signal.
struct Bit {
  Graph* graph;
  NodeId node;
};

/// The graph that either belongs to; two bare constants have none and cannot be combined.
Graph& common_graph(const Signal& a, const Signal& b);

Signal operator+(const Signal& a, const Signal& b);
Signal operator-(const Signal& a, const Signal& b);
Signal operator*(const Signal& a, const Signal& b);
Signal operator/(const Signal& a, const Signal& b);
Bit operator>(const Signal& a, const Signal& b);
Bit operator<=(const Signal& a, const Signal& b);
Bit operator<(const Signal& a, const Signal& b);
Bit operator>=(const Signal& a, const Signal& b);
Bit operator!(const Bit& a);
Bit operator||(const Bit& a, const Bit& b);  // both sides are always computed
Bit operator&&(const Bit& a, const Bit& b);
Signal sqrt(const Signal& a);
Bit sqrt_greater(const Signal& a, const Signal& b);
Signal select(const Bit& mask, const Signal& if_set, const Signal& if_clear);

#include "collide/vec3.inl"

#include "collide/aabb_overlap.inl"
#include "collide/sphere_plane.inl"
#include "collide/sphere_sphere.inl"

#include "collide/sphere_miss.inl"

}  // namespace harpoon::hls
