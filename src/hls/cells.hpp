#pragma once

// The hardware cells that a dataflow graph may use, and their latencies: the one table from which
// pipelines are scheduled and the package fp_latency_pkg is written. A cell refuses to elaborate if
// its own latency is another.

#include <array>
#include <cstdint>
#include <string_view>

namespace harpoon::hls {

/// What a node of the graph does. All arithmetic is binary32, round to nearest even.
enum class Op : std::uint8_t {
  input,
  constant,
  add,           ///< a + b
  sub,           ///< a - b
  mul,           ///< a * b
  recip,         ///< 1 / a
  sqrt,          ///< sqrt(a)
  select,        ///< mask ? a : b
  greater,       ///< a > b
  less_equal,    ///< a <= b
  sqrt_greater,  ///< sqrt(a) > b
  logic_or,      ///< one flip-flop after the gate
  logic_and,     ///< one flip-flop after the gate
  logic_not,     ///< a wire
};

/// One row of the table. `latency` in cycles; `constant` is its name in fp_latency_pkg (empty: the
/// operation is not a cell); `gives_bit`: the result is one bit, not a number.
struct Cell {
  Op op;
  std::string_view name;
  std::string_view module;
  std::string_view parameters;
  std::string_view constant;
  int latency;
  int arguments;
  bool gives_bit;
};

inline constexpr std::array<Cell, 14> kCells{{
    {Op::input, "input", "", "", "", 0, 0, false},
    {Op::constant, "constant", "", "", "", 0, 0, false},
    {Op::add, "add", "fp32_add", "", "Add", 7, 2, false},
    {Op::sub, "sub", "fp32_add", ".Subtract(1'b1)", "Add", 7, 2, false},
    {Op::mul, "mul", "fp32_mul", "", "Mul", 8, 2, false},
    {Op::recip, "recip", "fp32_recip", "", "Recip", 28, 1, false},
    {Op::sqrt, "sqrt", "fp32_sqrt", "", "Sqrt", 27, 1, false},
    {Op::select, "select", "fp32_select", "", "Select", 1, 3, false},
    {Op::greater, "greater", "fp32_compare", "", "Compare", 1, 2, true},
    {Op::less_equal, "less_equal", "fp32_compare", ".LessOrEqual(1'b1)", "Compare", 1, 2, true},
    {Op::sqrt_greater, "sqrt_greater", "fp32_sqrt_greater", "", "SqrtGreater", 6, 2, true},
    {Op::logic_or, "or", "", "", "", 1, 2, true},
    {Op::logic_and, "and", "", "", "", 1, 2, true},
    {Op::logic_not, "not", "", "", "", 0, 1, true},
}};

constexpr const Cell& cell_of(Op op) {
  return kCells[static_cast<std::size_t>(op)];
}

constexpr bool cells_in_order() {
  for (std::size_t i = 0; i < kCells.size(); ++i) {
    if (static_cast<std::size_t>(kCells[i].op) != i) return false;
  }
  return true;
}
static_assert(cells_in_order(), "kCells is indexed by Op");

}  // namespace harpoon::hls
