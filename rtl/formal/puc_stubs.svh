// Stand-ins with arbitrary outputs for what the PUC's sequence is proven without. Used by the
// proofs only.
module collector #(parameter int unsigned CountWidth = 32) (
  input logic clk_i, rst_ni, start_i, barrier_i, drained_i, read_ready_i, data_valid_i,
  input logic source_ready_i,
  input logic [57:0] table_line_i, source_line_i,
  input logic [31:0] table_lines_i, source_lines_i, batch_lines_i,
  input logic [511:0] data_i,
  output logic read_valid_o, data_ready_o, table_valid_o, source_valid_o, done_o,
  output logic [57:0] read_line_o,
  output logic [511:0] table_data_o, source_data_o
);
  (* anyseq *) logic [62:0] any;
  assign {read_valid_o, data_ready_o, table_valid_o, source_valid_o, done_o, read_line_o} = any;
  assign table_data_o  = data_i;
  assign source_data_o = data_i;
endmodule
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
module index_lanes #(
  parameter int unsigned Lanes = 10, parameter int unsigned Spheres = 16384,
  parameter int unsigned Depth = 128
) (
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
module scpu_array #(
  parameter int unsigned NumScpu = 10, parameter int unsigned TagWidth = 31,
  parameter int unsigned Depth = 256
) (
  input logic clk_i, rst_ni, spread_i, more_i, valid_i, ready_i,
  input logic [1:0] mask_i,
  input logic [511:0] pairs_i,
  input logic [61:0] tags_i,
  output logic ready_o, valid_o, idle_o,
  output logic [1:0] mask_o,
  output logic [511:0] contacts_o,
  output logic [61:0] tags_o
);
  (* anyseq *) logic [578:0] any;
  assign {ready_o, valid_o, idle_o, mask_o, contacts_o, tags_o} = any;
endmodule
module dispatcher (
  input logic clk_i, rst_ni, start_i, flush_i, hits_only_i, valid_i, write_ready_i,
  input logic [57:0] dest_line_i,
  input logic [31:0] dest_lines_i,
  input logic [1:0] mask_i,
  input logic [511:0] contacts_i,
  input logic [61:0] numbers_i,
  output logic ready_o, write_valid_o, idle_o,
  output logic [57:0] write_line_o,
  output logic [511:0] write_data_o,
  output logic [31:0] lines_o, hits_o, pairs_o
);
  (* anyseq *) logic [604:0] any;
  (* anyconst *) logic [63:0] counts;
  assign {ready_o, write_valid_o, idle_o, write_line_o, write_data_o, lines_o} = any;
  assign {hits_o, pairs_o} = counts;
endmodule
module line_digest (
  input logic clk_i, rst_ni, clear_i, valid_i,
  input logic [511:0] line_i,
  output logic [63:0] digest_o
);
  (* anyconst *) logic [63:0] any;
  assign digest_o = any;
endmodule
module line_fold (
  input logic clk_i, valid_i, or_valid_i,
  input logic [511:0] line_i, or_line_i,
  output logic [63:0] fold_o
);
  (* anyseq *) logic [63:0] any;
  assign fold_o = any;
endmodule
