// The AFU: registers, SPL2 and PUC behind one AXI4-Lite slave and one 512-bit AXI4 master. The port
// names are those of an XRT RTL kernel.
//
// The master obeys the strictest rules known (AWS F2): single 64-byte INCR beats, so nothing
// crosses 4 KB; no ID outstanding twice; at most IN_FLIGHT reads and as many writes outstanding. A
// write's B response is its commit point.
//
// NumScpu: 1 or even. MaxInFlight: power of two, lines in flight each way. BatchBarrier: reset
// value of PUC_MODE; with MaxInFlight = 4 it gives the published AFU's behaviour.
module harpoon_afu #(
  parameter int unsigned NumScpu      = 10,
  parameter int unsigned Lanes        = (NumScpu < 16) ? NumScpu : 16,
  parameter int unsigned MaxInFlight  = 64,
  parameter int unsigned Spheres      = 16384,
  parameter bit          BatchBarrier = 1'b0
) (
  input  logic                           ap_clk,
  input  logic                           ap_rst_n,

  input  logic                           s_axi_control_awvalid,
  output logic                           s_axi_control_awready,
  input  logic [15:0]                    s_axi_control_awaddr,
  input  logic                           s_axi_control_wvalid,
  output logic                           s_axi_control_wready,
  input  logic [31:0]                    s_axi_control_wdata,
  input  logic [3:0]                     s_axi_control_wstrb,
  output logic                           s_axi_control_bvalid,
  input  logic                           s_axi_control_bready,
  output logic [1:0]                     s_axi_control_bresp,
  input  logic                           s_axi_control_arvalid,
  output logic                           s_axi_control_arready,
  input  logic [15:0]                    s_axi_control_araddr,
  output logic                           s_axi_control_rvalid,
  input  logic                           s_axi_control_rready,
  output logic [31:0]                    s_axi_control_rdata,
  output logic [1:0]                     s_axi_control_rresp,

  output logic                           m_axi_arvalid,
  input  logic                           m_axi_arready,
  output logic [$clog2(MaxInFlight)-1:0] m_axi_arid,
  output logic [63:0]                    m_axi_araddr,
  output logic [7:0]                     m_axi_arlen,
  output logic [2:0]                     m_axi_arsize,
  output logic [1:0]                     m_axi_arburst,
  input  logic                           m_axi_rvalid,
  output logic                           m_axi_rready,
  input  logic [$clog2(MaxInFlight)-1:0] m_axi_rid,
  input  logic [511:0]                   m_axi_rdata,
  input  logic [1:0]                     m_axi_rresp,
  input  logic                           m_axi_rlast,
  output logic                           m_axi_awvalid,
  input  logic                           m_axi_awready,
  output logic [$clog2(MaxInFlight)-1:0] m_axi_awid,
  output logic [63:0]                    m_axi_awaddr,
  output logic [7:0]                     m_axi_awlen,
  output logic [2:0]                     m_axi_awsize,
  output logic [1:0]                     m_axi_awburst,
  output logic                           m_axi_wvalid,
  input  logic                           m_axi_wready,
  output logic [511:0]                   m_axi_wdata,
  output logic [63:0]                    m_axi_wstrb,
  output logic                           m_axi_wlast,
  input  logic                           m_axi_bvalid,
  output logic                           m_axi_bready,
  input  logic [$clog2(MaxInFlight)-1:0] m_axi_bid,
  input  logic [1:0]                     m_axi_bresp
);
  if (NumScpu != 1 && (NumScpu == 0 || NumScpu > 254 || NumScpu % 2 != 0))
    $error("harpoon_afu: NumScpu must be 1 or even, up to 254");
  if (Lanes < 1 || Lanes > 16)
    $error("harpoon_afu: Lanes must be 1 to 16");
  if (MaxInFlight < 2 || MaxInFlight > 128 || 1 << $clog2(MaxInFlight) != MaxInFlight)
    $error("harpoon_afu: MaxInFlight must be a power of two, 2 to 128");
  if (Spheres < 8 || Spheres > 65536 || 1 << $clog2(Spheres) != Spheres)
    $error("harpoon_afu: Spheres must be a power of two, 8 to 65536");

  localparam int unsigned ID = $clog2(MaxInFlight);

  logic         enable, reset, spl_dsm_commit, afu_dsm_commit, barrier, puc_done, puc_idle;
  logic         fault_valid, spl2_on, draining;
  logic [51:0]  spl_dsm_page;
  logic [57:0]  spl2_context_line, afu_dsm_line, afu_context_line, fault_line;
  logic [57:0]  arline, awline;
  logic [ID:0]  limit, reads_outstanding, writes_outstanding;
  logic [3:0]   puc_state, spl2_state;
  harpoon_contract_pkg::fault_e   fault_code;
  harpoon_contract_pkg::request_e fault_request;
  harpoon_contract_pkg::error_e   puc_error;
  harpoon_contract_pkg::config_t  config_word;
  harpoon_contract_pkg::state_t   state_word;
  logic         read_valid, read_ready, data_valid, data_ready;
  logic         write_valid, write_ready, write_dsm, write_idle;
  logic [57:0]  read_line, write_line;
  logic [511:0] read_data, write_data;

  always_comb begin
    config_word           = '0;
    config_word.scpus     = 8'(NumScpu);
    config_word.in_flight = 8'(MaxInFlight);
    config_word.lanes     = 8'(Lanes);
    state_word            = '0;
    state_word.puc        = puc_state;
    state_word.spl2       = spl2_state;
    state_word.reads      = 8'(reads_outstanding);
    state_word.writes     = 8'(writes_outstanding);
  end

  afu_registers #(
    .MaxInFlight(MaxInFlight), .Spheres(Spheres), .BatchBarrier(BatchBarrier)
  ) u_registers (
    .clk_i               (ap_clk),
    .rst_ni              (ap_rst_n),
    .awvalid_i           (s_axi_control_awvalid),
    .awready_o           (s_axi_control_awready),
    .awaddr_i            (s_axi_control_awaddr),
    .wvalid_i            (s_axi_control_wvalid),
    .wready_o            (s_axi_control_wready),
    .wdata_i             (s_axi_control_wdata),
    .bvalid_o            (s_axi_control_bvalid),
    .bready_i            (s_axi_control_bready),
    .arvalid_i           (s_axi_control_arvalid),
    .arready_o           (s_axi_control_arready),
    .araddr_i            (s_axi_control_araddr),
    .rvalid_o            (s_axi_control_rvalid),
    .rready_i            (s_axi_control_rready),
    .rdata_o             (s_axi_control_rdata),
    .enable_o            (enable),
    .reset_o             (reset),
    .spl_dsm_commit_o    (spl_dsm_commit),
    .afu_dsm_commit_o    (afu_dsm_commit),
    .spl_dsm_page_o      (spl_dsm_page),
    .spl2_context_line_o (spl2_context_line),
    .afu_dsm_line_o      (afu_dsm_line),
    .afu_context_line_o  (afu_context_line),
    .limit_o             (limit),
    .barrier_o           (barrier),
    .done_i              (puc_done),
    .idle_i              (puc_idle & ~draining),
    .config_i            (config_word),
    .fault_valid_i       (fault_valid),
    .fault_code_i        (fault_code),
    .fault_request_i     (fault_request),
    .fault_line_i        (fault_line),
    .error_i             (puc_error),
    .state_i             (state_word)
  );
  assign s_axi_control_bresp = 2'b00;
  assign s_axi_control_rresp = 2'b00;

  spl2 #(.MaxInFlight(MaxInFlight)) u_spl2 (
    .clk_i                (ap_clk),
    .rst_ni               (ap_rst_n),
    .reset_req_i          (reset),
    .enable_req_i         (enable),
    .spl_dsm_commit_i     (spl_dsm_commit),
    .spl_dsm_page_i       (spl_dsm_page),
    .context_line_i       (spl2_context_line),
    .afu_dsm_line_i       (afu_dsm_line),
    .limit_i              (limit),
    .fault_valid_o        (fault_valid),
    .fault_code_o         (fault_code),
    .fault_request_o      (fault_request),
    .fault_line_o         (fault_line),
    .state_o              (spl2_state),
    .reads_outstanding_o  (reads_outstanding),
    .writes_outstanding_o (writes_outstanding),
    .on_o                 (spl2_on),
    .draining_o           (draining),
    .puc_done_i           (puc_done),
    .read_valid_i         (read_valid),
    .read_ready_o         (read_ready),
    .read_line_i          (read_line),
    .data_valid_o         (data_valid),
    .data_ready_i         (data_ready),
    .data_o               (read_data),
    .write_valid_i        (write_valid),
    .write_ready_o        (write_ready),
    .write_dsm_i          (write_dsm),
    .write_line_i         (write_line),
    .write_data_i         (write_data),
    .write_idle_o         (write_idle),
    .axi_arvalid_o        (m_axi_arvalid),
    .axi_arready_i        (m_axi_arready),
    .axi_arid_o           (m_axi_arid),
    .axi_arline_o         (arline),
    .axi_rvalid_i         (m_axi_rvalid),
    .axi_rid_i            (m_axi_rid),
    .axi_rdata_i          (m_axi_rdata),
    .axi_rresp_i          (m_axi_rresp),
    .axi_awvalid_o        (m_axi_awvalid),
    .axi_awready_i        (m_axi_awready),
    .axi_awid_o           (m_axi_awid),
    .axi_awline_o         (awline),
    .axi_wvalid_o         (m_axi_wvalid),
    .axi_wready_i         (m_axi_wready),
    .axi_wdata_o          (m_axi_wdata),
    .axi_bvalid_i         (m_axi_bvalid),
    .axi_bid_i            (m_axi_bid),
    .axi_bresp_i          (m_axi_bresp)
  );
  assign m_axi_araddr  = {arline, 6'd0};
  assign m_axi_arlen   = 8'd0;
  assign m_axi_arsize  = 3'd6;
  assign m_axi_arburst = 2'b01;
  assign m_axi_rready  = 1'b1;
  assign m_axi_awaddr  = {awline, 6'd0};
  assign m_axi_awlen   = 8'd0;
  assign m_axi_awsize  = 3'd6;
  assign m_axi_awburst = 2'b01;
  assign m_axi_wstrb   = '1;
  assign m_axi_wlast   = 1'b1;
  assign m_axi_bready  = 1'b1;

  puc #(.NumScpu(NumScpu), .Lanes(Lanes), .Spheres(Spheres)) u_puc (
    .clk_i          (ap_clk),
    .rst_ni         (ap_rst_n & ~draining),
    .cold_rst_ni    (ap_rst_n),
    .spl2_on_i      (spl2_on),
    .active_i       (spl2_state != 4'd0),
    .dsm_commit_i   (afu_dsm_commit),
    .context_line_i (afu_context_line),
    .barrier_i      (barrier),
    .config_i       (config_word),
    .done_o         (puc_done),
    .idle_o         (puc_idle),
    .error_o        (puc_error),
    .state_o        (puc_state),
    .read_valid_o   (read_valid),
    .read_ready_i   (read_ready),
    .read_line_o    (read_line),
    .data_valid_i   (data_valid),
    .data_ready_o   (data_ready),
    .data_i         (read_data),
    .write_valid_o  (write_valid),
    .write_ready_i  (write_ready),
    .write_dsm_o    (write_dsm),
    .write_line_o   (write_line),
    .write_data_o   (write_data),
    .write_idle_i   (write_idle)
  );

  // the protocol has them; this slave writes whole registers and every read is a single beat
  logic unused;
  assign unused = (^s_axi_control_wstrb) ^ m_axi_rlast;
endmodule
