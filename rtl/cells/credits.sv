// Credits for a pipeline that cannot stall: one credit per free place behind it.
//
// `take_i` reserves a place when an item enters the pipeline, `give_i` returns it when the item
// leaves the queue behind it. Taking without `available_o` or giving more than was taken is an
// error of the surrounding logic. Reset (synchronous) returns all credits.
module credits #(
  parameter int unsigned Count = 16
) (
  input  logic clk_i,
  input  logic rst_ni,
  input  logic take_i,
  input  logic give_i,
  output logic available_o,
  output logic all_home_o
);
  if (Count < 1)
    $error("credits: Count must be at least 1");

  localparam int unsigned W = (Count > 0) ? $clog2(Count + 1) : 1;

  logic [W-1:0] left_q;

  assign available_o = left_q != '0;
  assign all_home_o  = left_q == W'(Count);

  always_ff @(posedge clk_i) begin
    if (!rst_ni) left_q <= W'(Count);
    else         left_q <= left_q - W'(take_i) + W'(give_i);
  end
`ifdef FORMAL
  `include "credits.svh"
`endif
endmodule
