// Stand-ins with arbitrary outputs for what spl2 is proven without: any reader, writer, table and
// fold. Used by the proofs only.
module spl2_reader #(parameter int unsigned MaxInFlight = 4) (
  input logic clk_i, rst_ni, clear_i, stop_i, req_valid_i, rsp_ready_i, lookup_ok_i,
  input logic axi_arready_i, axi_rvalid_i,
  input logic [$clog2(MaxInFlight):0] limit_i,
  input logic [57:0] req_line_i, lookup_line_i,
  input logic [$clog2(MaxInFlight)-1:0] axi_rid_i,
  input logic [511:0] axi_rdata_i,
  input logic [1:0] axi_rresp_i,
  output logic req_ready_o, rsp_valid_o, lookup_enable_o, fault_o, axi_arvalid_o,
  output logic [511:0] rsp_data_o,
  output logic [$clog2(MaxInFlight):0] outstanding_o,
  output logic [3:0] fault_code_o,
  output logic [57:0] fault_line_o, axi_arline_o,
  output logic [$clog2(MaxInFlight)-1:0] axi_arid_o
);
  (* anyseq *) logic [767:0] any;
  assign {req_ready_o, rsp_valid_o, lookup_enable_o, fault_o, axi_arvalid_o, rsp_data_o,
          outstanding_o, fault_code_o, fault_line_o, axi_arline_o, axi_arid_o} = any;
endmodule
module spl2_writer #(parameter int unsigned MaxInFlight = 4) (
  input logic clk_i, rst_ni, stop_i, req_valid_i, req_own_i, lookup_ok_i,
  input logic axi_awready_i, axi_wready_i, axi_bvalid_i,
  input logic [$clog2(MaxInFlight):0] limit_i,
  input logic [57:0] req_line_i, lookup_line_i,
  input logic [511:0] req_data_i,
  input logic [$clog2(MaxInFlight)-1:0] axi_bid_i,
  input logic [1:0] axi_bresp_i,
  output logic req_ready_o, lookup_enable_o, idle_o, fault_o, axi_awvalid_o, axi_wvalid_o,
  output logic [$clog2(MaxInFlight):0] outstanding_o,
  output logic [3:0] fault_code_o,
  output logic [57:0] fault_line_o, axi_awline_o,
  output logic [$clog2(MaxInFlight)-1:0] axi_awid_o,
  output logic [511:0] axi_wdata_o
);
  (* anyseq *) logic [767:0] any;
  assign {req_ready_o, lookup_enable_o, idle_o, fault_o, axi_awvalid_o, axi_wvalid_o,
          outstanding_o, fault_code_o, fault_line_o, axi_awline_o, axi_awid_o, axi_wdata_o} = any;
endmodule
module spl2_page_table #(parameter int unsigned MaxPages = 4) (
  input logic clk_i, store_i, store_valid_i, read_enable_i, read_physical_i, write_enable_i,
  input logic write_physical_i,
  input logic [42:0] base_page_i, store_page_i,
  input logic [$clog2(MaxPages):0] page_count_i,
  input logic [$clog2(MaxPages)-1:0] store_index_i,
  input logic [57:0] read_line_i, write_line_i,
  output logic read_ok_o, write_ok_o,
  output logic [57:0] read_line_o, write_line_o
);
  (* anyseq *) logic [117:0] any;
  assign {read_ok_o, write_ok_o, read_line_o, write_line_o} = any;
endmodule
module line_fold (
  input logic clk_i, valid_i, or_valid_i,
  input logic [511:0] line_i, or_line_i,
  output logic [63:0] fold_o
);
  (* anyseq *) logic [63:0] any;
  assign fold_o = any;
endmodule
