// Stand-ins with arbitrary outputs for what front_indexed is proven without; for proofs only.
module clock_gate (input logic clk_i, enable_i, output logic clk_o);
  assign clk_o = enable_i;
endmodule
module register_slice #(parameter int unsigned Width = 8) (
  input logic clk_i, rst_ni, valid_i, ready_i,
  input logic [Width-1:0] data_i,
  output logic ready_o, valid_o,
  output logic [Width-1:0] data_o
);
  (* anyseq *) logic [Width+1:0] any;
  assign {ready_o, valid_o, data_o} = any;
endmodule
module index_lanes #(parameter int unsigned Lanes = 10, parameter int unsigned Spheres = 64) (
  input logic clk_i, clk_free_i, rst_ni, start_i, table_clear_i, table_valid_i, valid_i, ready_i,
  input logic [31:0] sphere_count_i,
  input logic [511:0] table_data_i, line_i,
  input logic [30:0] number_i,
  input logic [4:0] count_i,
  input logic last_i, more_i,
  output logic ready_o, valid_o, index_error_o, idle_o,
  output logic [1:0] mask_o,
  output logic [511:0] pairs_o,
  output logic [61:0] numbers_o
);
  (* anyseq *) logic [579:0] any;
  assign {ready_o, valid_o, index_error_o, idle_o, mask_o, pairs_o, numbers_o} = any;
endmodule
