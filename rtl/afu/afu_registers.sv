// The AXI4-Lite slave: ap_ctrl at 0x00, information registers, and the CSRs of HARP at their own
// offsets (register map: harpoon_contract_pkg). Commands leave as one-cycle pulses.
//
// One write and one read at a time; a write needs address and data together and takes one cycle;
// byte strobes are ignored (registers are written whole). Unknown offsets read 0 and ignore writes.
module afu_registers #(
  parameter int unsigned MaxInFlight = 64,
  parameter int unsigned Spheres     = 16384,
  parameter bit          BatchBarrier = 1'b0
) (
  input  logic        clk_i,
  input  logic        rst_ni,

  input  logic        awvalid_i,
  output logic        awready_o,
  input  logic [15:0] awaddr_i,
  input  logic        wvalid_i,
  output logic        wready_o,
  input  logic [31:0] wdata_i,
  output logic        bvalid_o,
  input  logic        bready_i,
  input  logic        arvalid_i,
  output logic        arready_o,
  input  logic [15:0] araddr_i,
  output logic        rvalid_o,
  input  logic        rready_i,
  output logic [31:0] rdata_o,

  output logic        enable_o,          // pulses
  output logic        reset_o,
  output logic        spl_dsm_commit_o,
  output logic        afu_dsm_commit_o,
  output logic [51:0] spl_dsm_page_o,    // 4 KB page
  output logic [57:0] spl2_context_line_o,
  output logic [57:0] afu_dsm_line_o,
  output logic [57:0] afu_context_line_o,
  output logic [$clog2(MaxInFlight):0] limit_o,
  output logic        barrier_o,

  input  logic        done_i,
  input  logic        idle_i,
  input  harpoon_contract_pkg::config_t  config_i,
  input  logic        fault_valid_i,
  input  harpoon_contract_pkg::fault_e   fault_code_i,
  input  harpoon_contract_pkg::request_e fault_request_i,
  input  logic [57:0] fault_line_i,
  input  harpoon_contract_pkg::error_e   error_i,
  input  harpoon_contract_pkg::state_t   state_i
);
  if (MaxInFlight < 2 || MaxInFlight > 128 || 1 << $clog2(MaxInFlight) != MaxInFlight)
    $error("afu_registers: MaxInFlight must be a power of two, 2 to 128");
  if (Spheres < 8 || Spheres > 65536 || 1 << $clog2(Spheres) != Spheres)
    $error("afu_registers: Spheres must be a power of two, 8 to 65536");

  localparam int unsigned ID = $clog2(MaxInFlight);

  logic        write, read, done_q, ap_done_q;
  logic [31:0] high_q, read_value;   // the high half of a 64-bit CSR waits for its low half

  // ---- what is written, as each register sees it ----
  harpoon_contract_pkg::ap_ctrl_t      ap_ctrl_view;
  harpoon_contract_pkg::puc_mode_t     puc_mode_view;
  harpoon_contract_pkg::spl2_ch_ctrl_t ch_ctrl_view;
  harpoon_contract_pkg::line_address_t address_view;
  assign ap_ctrl_view  = wdata_i;
  assign puc_mode_view = wdata_i;
  assign ch_ctrl_view  = wdata_i;
  assign address_view  = {high_q, wdata_i};

  assign write     = awvalid_i & wvalid_i & ~bvalid_o;
  assign awready_o = write;
  assign wready_o  = write;
  assign read      = arvalid_i & ~rvalid_o;
  assign arready_o = ~rvalid_o;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      bvalid_o            <= 1'b0;
      enable_o            <= 1'b0;
      reset_o             <= 1'b0;
      spl_dsm_commit_o    <= 1'b0;
      afu_dsm_commit_o    <= 1'b0;
      spl_dsm_page_o      <= '0;
      spl2_context_line_o <= '0;
      afu_dsm_line_o      <= '0;
      afu_context_line_o  <= '0;
      high_q              <= '0;
      limit_o             <= (ID+1)'(MaxInFlight);
      barrier_o           <= BatchBarrier;
    end else begin
      enable_o         <= 1'b0;
      reset_o          <= 1'b0;
      spl_dsm_commit_o <= 1'b0;
      afu_dsm_commit_o <= 1'b0;
      if (bready_i) bvalid_o <= 1'b0;
      if (write) begin
        bvalid_o <= 1'b1;
        unique case (awaddr_i)
          harpoon_contract_pkg::REG_AP_CTRL: enable_o <= ap_ctrl_view.start;
          harpoon_contract_pkg::REG_IN_FLIGHT:
            limit_o <= (wdata_i == '0 || wdata_i > MaxInFlight) ? (ID+1)'(MaxInFlight)
                                                                : wdata_i[ID:0];
          harpoon_contract_pkg::REG_PUC_MODE: barrier_o <= puc_mode_view.batch_barrier;
          harpoon_contract_pkg::REG_SPL2_CH_CTRL: begin
            reset_o  <= ch_ctrl_view.reset;
            enable_o <= ch_ctrl_view.enable;
          end
          harpoon_contract_pkg::REG_SPL_DSM_BASE: begin
            spl_dsm_page_o   <= address_view.line[57:6];
            spl_dsm_commit_o <= 1'b1;
          end
          harpoon_contract_pkg::REG_AFU_DSM_BASE: begin
            afu_dsm_line_o   <= address_view.line;
            afu_dsm_commit_o <= 1'b1;
          end
          harpoon_contract_pkg::REG_SPL2_CNTXT_BASE: spl2_context_line_o <= address_view.line;
          harpoon_contract_pkg::REG_AFU_CNTXT_BASE:  afu_context_line_o <= address_view.line;
          (harpoon_contract_pkg::REG_SPL_DSM_BASE + 16'd4),
          (harpoon_contract_pkg::REG_AFU_DSM_BASE + 16'd4),
          (harpoon_contract_pkg::REG_SPL2_CNTXT_BASE + 16'd4),
          (harpoon_contract_pkg::REG_AFU_CNTXT_BASE + 16'd4): high_q <= wdata_i;
          default: ;
        endcase
      end
    end
  end

  // ---- what is read ----
  harpoon_contract_pkg::ap_ctrl_t      ap_ctrl;
  harpoon_contract_pkg::puc_mode_t     puc_mode;
  harpoon_contract_pkg::spl2_fault_t   spl2_fault;
  harpoon_contract_pkg::line_address_t fault_address;
  harpoon_contract_pkg::error_word_t   afu_error;
  always_comb begin
    ap_ctrl                = '0;
    ap_ctrl.start          = ~idle_i;
    ap_ctrl.done           = ap_done_q;
    ap_ctrl.idle           = idle_i;
    ap_ctrl.ready          = ap_done_q;
    puc_mode               = '0;
    puc_mode.batch_barrier = barrier_o;
    spl2_fault             = '0;
    spl2_fault.valid       = fault_valid_i;
    spl2_fault.code        = fault_code_i;
    spl2_fault.request     = fault_request_i;
    fault_address          = '0;
    fault_address.line     = fault_line_i;
    afu_error              = '0;
    afu_error.code         = error_i;
  end

  always_comb begin
    unique case (araddr_i)
      harpoon_contract_pkg::REG_AP_CTRL:    read_value = ap_ctrl;
      harpoon_contract_pkg::REG_AFU_ID_0:   read_value = harpoon_contract_pkg::AFU_ID_LOW[31:0];
      harpoon_contract_pkg::REG_AFU_ID_1:   read_value = harpoon_contract_pkg::AFU_ID_LOW[63:32];
      harpoon_contract_pkg::REG_AFU_ID_2:   read_value = harpoon_contract_pkg::AFU_ID_HIGH[31:0];
      harpoon_contract_pkg::REG_AFU_ID_3:   read_value = harpoon_contract_pkg::AFU_ID_HIGH[63:32];
      harpoon_contract_pkg::REG_CONFIG:     read_value = config_i;
      harpoon_contract_pkg::REG_TABLE_SPHERES: read_value = Spheres;
      harpoon_contract_pkg::REG_IN_FLIGHT:  read_value = 32'(limit_o);
      harpoon_contract_pkg::REG_PUC_MODE:   read_value = puc_mode;
      harpoon_contract_pkg::REG_SPL2_FAULT: read_value = spl2_fault;
      harpoon_contract_pkg::REG_FAULT_ADDRESS_LO: read_value = fault_address[31:0];
      harpoon_contract_pkg::REG_FAULT_ADDRESS_HI: read_value = fault_address[63:32];
      harpoon_contract_pkg::REG_AFU_ERROR:  read_value = afu_error;
      harpoon_contract_pkg::REG_STATE:      read_value = state_i;
      default:                              read_value = '0;
    endcase
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      rvalid_o  <= 1'b0;
      done_q    <= 1'b0;
      ap_done_q <= 1'b0;
    end else begin
      done_q <= done_i;
      if (read) rvalid_o <= 1'b1;
      else if (rready_i) rvalid_o <= 1'b0;
      if (done_i & ~done_q) ap_done_q <= 1'b1;
      else if (read & (araddr_i == harpoon_contract_pkg::REG_AP_CTRL)) ap_done_q <= 1'b0;
    end
    if (read) rdata_o <= read_value;
  end
`ifdef FORMAL
  `include "afu_registers.svh"
`endif
endmodule
