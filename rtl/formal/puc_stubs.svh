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
module front_indexed #(
  parameter int unsigned Lanes = 10, parameter int unsigned Spheres = 16384
) (
  input logic clk_i, rst_ni, cold_rst_ni, enable_i, start_i, forget_i, load_i, barrier_i, more_i,
  input logic open_i, lines_done_i, table_valid_i, valid_i, ready_i,
  input logic [31:0] sphere_count_i,
  input logic [511:0] table_data_i,
  input logic [511:0] line_i,
  input puc_pkg::source_t source_i,
  output logic ready_o, valid_o, index_error_o, idle_o,
  output puc_pkg::beat_t beat_o,
  output harpoon_contract_pkg::pair_line_t pairs_o,
  output logic [31:0] loaded_o
);
  (* anyseq *) logic [580:0] any;
  (* anyconst *) logic [31:0] count;
  assign {ready_o, valid_o, index_error_o, idle_o, beat_o, pairs_o} = any;
  assign loaded_o = count;
endmodule
module scpu_array #(
  parameter int unsigned NumScpu = 10, parameter int unsigned Depth = 256
) (
  input logic clk_i, rst_ni, spread_i, more_i, valid_i, ready_i,
  input puc_pkg::beat_t beat_i,
  input harpoon_contract_pkg::pair_line_t pairs_i,
  output logic ready_o, valid_o, idle_o,
  output puc_pkg::result_t result_o,
  output harpoon_contract_pkg::contact_line_t contacts_o
);
  (* anyseq *) logic [578:0] any;
  assign {ready_o, valid_o, idle_o, result_o, contacts_o} = any;
endmodule
module dispatcher (
  input logic clk_i, rst_ni, start_i, flush_i, hits_only_i, valid_i, write_ready_i,
  input logic [57:0] dest_line_i,
  input logic [31:0] dest_lines_i,
  input puc_pkg::result_t result_i,
  input harpoon_contract_pkg::contact_line_t contacts_i,
  output logic ready_o, write_valid_o, idle_o,
  output logic [57:0] write_line_o,
  output logic [511:0] write_data_o,
  output puc_pkg::results_t results_o
);
  (* anyseq *) logic [604:0] any;
  (* anyconst *) logic [63:0] counts;
  assign {ready_o, write_valid_o, idle_o, write_line_o, write_data_o, results_o.lines} = any;
  assign {results_o.hits, results_o.pairs} = counts;
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
