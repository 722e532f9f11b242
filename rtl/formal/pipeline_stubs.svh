// What scpu_array and index_lanes are proven with: pipelines, queues, credits and table with
// arbitrary outputs, which the properties restrict to what those modules' own tests and proofs say
// of them. A gated clock is its enable here. Used by the proofs only.
package scpu_pkg;
  localparam int unsigned Latency     = 2;
  localparam int unsigned CullLatency = 2;
endpackage
module clock_gate (input logic clk_i, enable_i, output logic clk_o);
  assign clk_o = enable_i;
endmodule
module scpu (
  input logic clk_i, rst_ni, valid_i,
  input logic [255:0] pair_i,
  output logic valid_o,
  output logic [255:0] contact_o
);
  (* anyseq *) logic [256:0] any;
  assign {valid_o, contact_o} = any;
endmodule
module scpu_cull (
  input logic clk_i, rst_ni, valid_i,
  input logic [255:0] pair_i,
  output logic valid_o, miss_o
);
  (* anyseq *) logic [1:0] any;
  assign {valid_o, miss_o} = any;
endmodule
module sphere_table #(parameter int unsigned Spheres = 64, parameter int unsigned Ports = 4) (
  input logic clk_i, write_i,
  input logic [$clog2(Spheres)-3:0] write_row_i,
  input logic [511:0] write_data_i,
  input logic [Ports-1:0] enable_i,
  input logic [Ports*$clog2(Spheres)-1:0] index_i,
  output logic [Ports*128-1:0] sphere_o
);
  (* anyseq *) logic [Ports*128-1:0] any;
  assign sphere_o = any;
endmodule
module fifo #(parameter int unsigned Width = 8, parameter int unsigned Depth = 4) (
  input logic clk_i, rst_ni, valid_i, ready_i,
  input logic [Width-1:0] data_i,
  output logic ready_o, valid_o, empty_o,
  output logic [Width-1:0] data_o
);
  (* anyseq *) logic [Width+2:0] any;
  assign {ready_o, valid_o, empty_o, data_o} = any;
endmodule
module credits #(parameter int unsigned Count = 16) (
  input logic clk_i, rst_ni, take_i, give_i,
  output logic available_o, all_home_o
);
  (* anyseq *) logic [1:0] any;
  assign {available_o, all_home_o} = any;
endmodule
