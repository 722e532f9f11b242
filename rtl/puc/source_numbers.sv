// Numbers the pairs of Src: how many the line that is there holds, the number of the first, and
// whether it is the last line.
//
// No latency; the lines themselves pass by: `taken_i` says that this one goes now.
// `start_i` (one cycle) begins with pair 0 of `pair_count_i`; a line holds 16 pairs if `indexed_i`,
// or 2.
module source_numbers (
  input  logic             clk_i,
  input  logic             start_i,
  input  logic [31:0]      pair_count_i,
  input  logic             indexed_i,
  input  logic             taken_i,
  output puc_pkg::source_t source_o
);
  logic [31:0] left_q, number_q, per_line;   // pairs left, number of the next

  assign per_line = indexed_i ? harpoon_contract_pkg::INDEX_PAIRS_PER_LINE
                              : harpoon_contract_pkg::PAIRS_PER_LINE;
  always_ff @(posedge clk_i) begin
    if (start_i) begin
      left_q   <= pair_count_i;
      number_q <= '0;
    end else if (taken_i) begin
      left_q   <= left_q - per_line;
      number_q <= number_q + per_line;
    end
  end

  always_comb begin
    source_o.last   = left_q <= per_line;
    source_o.count  = (left_q >= per_line) ? per_line[4:0] : left_q[4:0];
    source_o.number = number_q[30:0];
  end
`ifdef FORMAL
  `include "source_numbers.svh"
`endif
endmodule
