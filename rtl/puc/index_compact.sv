// Compacts a slice of Lanes index pairs to those that were not ruled out, two a cycle, in order.
//
// The slice is held until `done_o`; one without survivors is done at once. Out go beats, of which
// `mask_o` says how many pairs there are (01 or 11); `valid_o` only while `ready_i`. No latency.
// Reset (synchronous) forgets what was sent of a slice. Lanes is 1 to 16.
module index_compact #(
  parameter int unsigned Lanes = 10
) (
  input  logic                clk_i,
  input  logic                rst_ni,
  input  logic                valid_i,
  output logic                done_o,
  input  logic [32*Lanes-1:0] slice_i,
  input  logic [Lanes-1:0]    present_i,
  input  logic [Lanes-1:0]    miss_i,
  input  logic [30:0]         number_i,   // of the first pair
  output logic                valid_o,
  input  logic                ready_i,
  output logic [1:0]          mask_o,
  output harpoon_contract_pkg::index_pair_t first_o,
  output harpoon_contract_pkg::index_pair_t second_o,
  output logic [30:0]         first_number_o,
  output logic [30:0]         second_number_o
);
  if (Lanes < 1 || Lanes > 16)
    $error("index_compact: Lanes must be 1 to 16");

  logic [Lanes-1:0] sent_q, survivors, rest, first_hot, second_hot;

  assign survivors  = present_i & ~miss_i & ~sent_q;
  assign first_hot  = survivors & (~survivors + Lanes'(1));
  assign rest       = survivors & ~first_hot;
  assign second_hot = rest & (~rest + Lanes'(1));
  assign mask_o     = {|rest, |survivors};
  assign done_o     = valid_i & ((rest & ~second_hot) == '0) & (ready_i | ~mask_o[0]);
  assign valid_o    = valid_i & mask_o[0] & ready_i;
  always_comb begin
    first_o         = '0;
    second_o        = '0;
    first_number_o  = number_i;
    second_number_o = number_i;
    for (int unsigned i = 0; i < Lanes; i++) begin
      if (first_hot[i]) begin
        first_o        = slice_i[32*i +: 32];
        first_number_o = number_i + 31'(i);
      end
      if (second_hot[i]) begin
        second_o        = slice_i[32*i +: 32];
        second_number_o = number_i + 31'(i);
      end
    end
  end
  always_ff @(posedge clk_i) begin
    if (!rst_ni || done_o) sent_q <= '0;
    else if (valid_o) sent_q <= sent_q | first_hot | second_hot;
  end
`ifdef FORMAL
  `include "index_compact.svh"
`endif
endmodule
