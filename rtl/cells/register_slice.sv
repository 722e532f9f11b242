// One register between two ready/valid ports: cuts the paths of valid and data, not that of ready.
//
// An item leaves a cycle after it entered at the earliest; one item per cycle. `valid_o` and
// `data_o` are stable until `ready_i`. Reset (synchronous) empties it.
module register_slice #(
  parameter int unsigned Width = 8
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             valid_i,
  output logic             ready_o,
  input  logic [Width-1:0] data_i,
  output logic             valid_o,
  input  logic             ready_i,
  output logic [Width-1:0] data_o
);
  if (Width < 1)
    $error("register_slice: Width must be at least 1");

  logic             valid_q;
  logic [Width-1:0] data_q;

  assign ready_o = ~valid_q | ready_i;
  assign valid_o = valid_q;
  assign data_o  = data_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) valid_q <= 1'b0;
    else if (ready_o) valid_q <= valid_i;
    if (ready_o & valid_i) data_q <= data_i;
  end
`ifdef FORMAL
  `include "register_slice.svh"
`endif
endmodule
