// SPL2: address translation between the AFU and the memory, and everything that guards it.
//
// Life: off -> (enable) read SPL2_CNTXT -> read the page table -> on -> (reset) drain -> off. While
// on, the PUC's workspace addresses are translated by pages of 2 MB. No access leaves the mapped
// pages: what SPL2 itself touches besides is its context, the page table, and the two DSM pages,
// all named by registers.
//
// A fault (invalid context or entry, address outside the workspace, error response, stray response)
// is terminal until reset: nothing more is issued but the report in line 1 of the SPL2 DSM. Reset
// waits until every outstanding request has been answered; then an enable that came with it, or
// meanwhile, starts anew. An enable while on waits for `puc_done_i` and then implies a reset.
module spl2 #(
  parameter int unsigned MaxInFlight = 64,
  parameter int unsigned MaxPages    = harpoon_contract_pkg::MAX_PAGES
) (
  input  logic                           clk_i,
  input  logic                           rst_ni,

  // registers
  input  logic                           reset_req_i,
  input  logic                           enable_req_i,
  input  logic                           spl_dsm_commit_i,
  input  logic [51:0]                    spl_dsm_page_i,  // 4 KB page
  input  logic [57:0]                    context_line_i,
  input  logic [57:0]                    afu_dsm_line_i,
  input  logic [$clog2(MaxInFlight):0]   limit_i,
  output logic                           fault_valid_o,
  output harpoon_contract_pkg::fault_e   fault_code_o,
  output harpoon_contract_pkg::request_e fault_request_o,
  output logic [57:0]                    fault_line_o,
  output logic [3:0]                     state_o,
  output logic [$clog2(MaxInFlight):0]   reads_outstanding_o,
  output logic [$clog2(MaxInFlight):0]   writes_outstanding_o,

  // PUC
  output logic                           on_o,
  output logic                           draining_o,
  input  logic                           puc_done_i,
  input  logic                           read_valid_i,
  output logic                           read_ready_o,
  input  logic [57:0]                    read_line_i,
  output logic                           data_valid_o,
  input  logic                           data_ready_i,
  output logic [511:0]                   data_o,
  input  logic                           write_valid_i,
  output logic                           write_ready_o,
  input  logic                           write_dsm_i,   // address is a line of the AFU DSM
  input  logic [57:0]                    write_line_i,
  input  logic [511:0]                   write_data_i,
  output logic                           write_idle_o,  // every write so far is acknowledged

  // AXI4 master, line addresses
  output logic                           axi_arvalid_o,
  input  logic                           axi_arready_i,
  output logic [$clog2(MaxInFlight)-1:0] axi_arid_o,
  output logic [57:0]                    axi_arline_o,
  input  logic                           axi_rvalid_i,
  input  logic [$clog2(MaxInFlight)-1:0] axi_rid_i,
  input  logic [511:0]                   axi_rdata_i,
  input  logic [1:0]                     axi_rresp_i,
  output logic                           axi_awvalid_o,
  input  logic                           axi_awready_i,
  output logic [$clog2(MaxInFlight)-1:0] axi_awid_o,
  output logic [57:0]                    axi_awline_o,
  output logic                           axi_wvalid_o,
  input  logic                           axi_wready_i,
  output logic [511:0]                   axi_wdata_o,
  input  logic                           axi_bvalid_i,
  input  logic [$clog2(MaxInFlight)-1:0] axi_bid_i,
  input  logic [1:0]                     axi_bresp_i
);
  if (MaxInFlight < 2 || MaxInFlight > 128 || 1 << $clog2(MaxInFlight) != MaxInFlight)
    $error("spl2: MaxInFlight must be a power of two, 2 to 128");
  if (MaxPages < 2 || MaxPages > 1024 || 1 << $clog2(MaxPages) != MaxPages)
    $error("spl2: MaxPages must be a power of two, 2 to 1024");

  localparam int unsigned IDX = $clog2(MaxPages);

  typedef enum logic [3:0] {
    Off, ContextRequest, ContextWait, ContextCheck, Entries, On, Fault, Drain
  } state_e;
  state_e state_q;

  // ---- what the context said ----
  logic [57:0]  table_line_q;
  logic [42:0]  base_page_q;
  logic [IDX:0] page_count_q, asked_q, stored_q;
  logic         context_good_q, enable_pending_q, stop;

  // ---- reader ----
  logic        reader_req_valid, reader_req_ready, reader_rsp_valid, reader_rsp_ready;
  logic [57:0] reader_req_line;
  logic        read_lookup, read_ok, reader_fault, clear;
  logic [57:0] read_translated, reader_fault_line;
  harpoon_contract_pkg::fault_e reader_fault_code;

  // ---- writer ----
  logic         writer_req_valid, writer_req_ready, writer_idle, puc_write_allowed;
  logic [57:0]  writer_req_line;
  logic [511:0] writer_req_data;
  logic         write_lookup, write_ok, writer_fault, writer_req_own;
  logic [57:0]  write_translated, writer_fault_line;
  harpoon_contract_pkg::fault_e writer_fault_code;

  // ---- lines that SPL2 writes itself: its ID, a fault report ----
  typedef enum logic [1:0] {OwnIdle, OwnFold, OwnSend} own_e;
  own_e         own_q;
  logic         own_report_q, id_pending_q, report_pending_q, spl_dsm_known_q;
  harpoon_contract_pkg::checked_line_t own_line;
  logic [63:0]  fold;

  assign stop         = (state_q == Fault) | (state_q == Drain);
  assign on_o         = state_q == On;
  assign draining_o   = state_q == Drain;
  assign state_o      = state_q;
  assign write_idle_o = writer_idle;

  spl2_page_table #(.MaxPages(MaxPages)) u_page_table (
    .clk_i,
    .base_page_i      (base_page_q),
    .page_count_i     (page_count_q),
    .store_i          (entry_good),
    .store_index_i    (stored_q[IDX-1:0]),
    .store_valid_i    (entry_mapped_q),
    .store_page_i     (entry_page_q),
    .read_enable_i    (read_lookup),
    .read_physical_i  (state_q != On),
    .read_line_i      (reader_req_line),
    .read_ok_o        (read_ok),
    .read_line_o      (read_translated),
    .write_enable_i   (write_lookup),
    .write_physical_i (writer_req_own | write_dsm_i),
    .write_line_i     (writer_req_line),
    .write_ok_o       (write_ok),
    .write_line_o     (write_translated)
  );

  // ---- read side: the loader until on, then the PUC ----
  assign reader_req_valid = (state_q == On) ? read_valid_i
                          : (state_q == ContextRequest)
                          | ((state_q == Entries) & (asked_q != page_count_q));
  assign reader_req_line  = (state_q == On) ? read_line_i
                          : (state_q == ContextRequest) ? context_line_i
                          : table_line_q + 58'(asked_q);
  assign read_ready_o     = (state_q == On) & reader_req_ready;
  assign reader_rsp_ready = (state_q == On) ? data_ready_i : 1'b1;
  assign data_valid_o     = (state_q == On) & reader_rsp_valid;

  spl2_reader #(.MaxInFlight(MaxInFlight)) u_reader (
    .clk_i, .rst_ni,
    .clear_i         (clear),
    .stop_i          (stop),
    .limit_i         (limit_i),
    .req_valid_i     (reader_req_valid),
    .req_ready_o     (reader_req_ready),
    .req_line_i      (reader_req_line),
    .rsp_valid_o     (reader_rsp_valid),
    .rsp_ready_i     (reader_rsp_ready),
    .rsp_data_o      (data_o),
    .lookup_enable_o (read_lookup),
    .lookup_ok_i     (read_ok),
    .lookup_line_i   (read_translated),
    .outstanding_o   (reads_outstanding_o),
    .fault_o         (reader_fault),
    .fault_code_o    (reader_fault_code),
    .fault_line_o    (reader_fault_line),
    .axi_arvalid_o, .axi_arready_i, .axi_arid_o, .axi_arline_o,
    .axi_rvalid_i, .axi_rid_i, .axi_rdata_i, .axi_rresp_i
  );

  // ---- write side: SPL2's own lines first, then the PUC ----
  assign writer_req_own    = own_q == OwnSend;
  assign puc_write_allowed = ~stop & ((state_q == On) | write_dsm_i);
  assign writer_req_valid  = writer_req_own | (write_valid_i & puc_write_allowed);
  assign writer_req_line   = writer_req_own
                           ? {spl_dsm_page_i, own_report_q
                              ? harpoon_contract_pkg::SPL_DSM_FAULT_LINE
                              : harpoon_contract_pkg::SPL_DSM_ID_LINE}
                           : write_dsm_i ? {afu_dsm_line_i[57:6], write_line_i[5:0]} : write_line_i;
  assign writer_req_data   = writer_req_own
                           ? {harpoon_contract_pkg::CHECK_SEED ^ fold, own_line.body}
                           : write_data_i;
  assign write_ready_o     = ~writer_req_own & puc_write_allowed & writer_req_ready;

  spl2_writer #(.MaxInFlight(MaxInFlight)) u_writer (
    .clk_i, .rst_ni,
    .stop_i          (stop),
    .limit_i         (limit_i),
    .req_valid_i     (writer_req_valid),
    .req_ready_o     (writer_req_ready),
    .req_own_i       (writer_req_own),
    .req_line_i      (writer_req_line),
    .req_data_i      (writer_req_data),
    .lookup_enable_o (write_lookup),
    .lookup_ok_i     (write_ok),
    .lookup_line_i   (write_translated),
    .outstanding_o   (writes_outstanding_o),
    .idle_o          (writer_idle),
    .fault_o         (writer_fault),
    .fault_code_o    (writer_fault_code),
    .fault_line_o    (writer_fault_line),
    .axi_awvalid_o, .axi_awready_i, .axi_awid_o, .axi_awline_o,
    .axi_wvalid_o, .axi_wready_i, .axi_wdata_o,
    .axi_bvalid_i, .axi_bid_i, .axi_bresp_i
  );

  // ---- loader: SPL2_CNTXT and the page table ----
  logic        loading, load_line, context_bad, entry_bad, entry_good, entry_valid_q, check_good;
  logic [63:0] check_q;
  logic [42:0] entry_page_q;
  logic        entry_mapped_q;
  logic [31:0] entry_index_q;
  harpoon_contract_pkg::checked_line_t data_view;
  harpoon_contract_pkg::spl2_cntxt_t   context_view;
  harpoon_contract_pkg::pte_t          pte_view;
  assign data_view    = data_o;
  assign context_view = data_o;
  assign pte_view     = data_o;

  assign loading    = (state_q == ContextWait) | (state_q == Entries);
  assign load_line  = loading & reader_rsp_valid;
  assign check_good = check_q == (harpoon_contract_pkg::CHECK_SEED ^ fold);
  assign entry_good = (state_q == Entries) & entry_valid_q & check_good
                    & (entry_index_q == 32'(stored_q));
  assign entry_bad  = (state_q == Entries) & entry_valid_q & ~entry_good;
  assign context_bad = (state_q == ContextCheck) & ~(check_good & context_good_q);

  line_fold u_fold (
    .clk_i,
    .valid_i    (load_line),
    .line_i     ({64'd0, data_view.body}),
    .or_valid_i (own_q == OwnFold),
    .or_line_i  (own_line),
    .fold_o     (fold)
  );

  always_ff @(posedge clk_i) begin
    if (!rst_ni) entry_valid_q <= 1'b0;
    else         entry_valid_q <= (state_q == Entries) & reader_rsp_valid;
    if (load_line) begin
      check_q        <= data_view.check;
      entry_mapped_q <= pte_view.entry.valid;
      entry_page_q   <= pte_view.entry.page;
      entry_index_q  <= pte_view.index;
    end
    if ((state_q == ContextWait) & reader_rsp_valid) begin
      table_line_q   <= context_view.page_table.line;
      base_page_q    <= context_view.afu_context.page;
      context_good_q <= (context_view.page_table.offset == '0)
                      & (context_view.afu_context.offset == '0)
                      & context_view.page_size.two_mb
                      & context_view.control.is_virtual
                      & (context_view.page_count != '0) & (context_view.page_count <= MaxPages)
                      & (context_view.afu_dsm == {afu_dsm_line_i, 6'd0});
    end
  end

  // ---- faults ----
  logic        fault;
  logic [57:0] fault_line;
  harpoon_contract_pkg::fault_e   fault_code;
  harpoon_contract_pkg::request_e fault_request;

  always_comb begin
    fault         = 1'b1;
    fault_code    = harpoon_contract_pkg::FAULT_PTE_LOAD;
    fault_request = harpoon_contract_pkg::REQUEST_READ;
    fault_line    = context_line_i;
    if (reader_fault) begin
      fault_line = reader_fault_line;
      if ((state_q == On) | (reader_fault_code == harpoon_contract_pkg::FAULT_UNEXPECTED))
        fault_code = reader_fault_code;
    end else if (writer_fault) begin
      fault_code    = writer_fault_code;
      fault_request = harpoon_contract_pkg::REQUEST_WRITE;
      fault_line    = writer_fault_line;
    end else if (entry_bad) begin
      fault_line = table_line_q + 58'(stored_q);
    end else begin
      fault = context_bad;
    end
  end

  // ---- life ----
  assign clear = (state_q == Drain) & (reads_outstanding_o == '0) & writer_idle
               & (own_q == OwnIdle);

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      state_q          <= Off;
      page_count_q     <= '0;
      asked_q          <= '0;
      stored_q         <= '0;
      enable_pending_q <= 1'b0;
      fault_valid_o    <= 1'b0;
      fault_code_o     <= harpoon_contract_pkg::FAULT_NONE;
      fault_request_o  <= harpoon_contract_pkg::REQUEST_NONE;
      fault_line_o     <= '0;
    end else begin
      unique case (state_q)
        Off: if (enable_pending_q) begin
          enable_pending_q <= 1'b0;
          state_q          <= ContextRequest;
        end
        ContextRequest: if (reader_req_ready) state_q <= ContextWait;
        ContextWait: if (reader_rsp_valid) begin
          page_count_q <= context_view.page_count[IDX:0];
          asked_q      <= '0;
          stored_q     <= '0;
          state_q      <= ContextCheck;
        end
        ContextCheck: state_q <= Entries;
        Entries: begin
          if (reader_req_valid & reader_req_ready) asked_q <= asked_q + (IDX+1)'(1);
          if (entry_good) begin
            stored_q <= stored_q + (IDX+1)'(1);
            if (stored_q + (IDX+1)'(1) == page_count_q) state_q <= On;
          end
        end
        Drain: if (clear) state_q <= Off;
        default: ;
      endcase
      if (fault & ~stop) begin
        state_q         <= Fault;
        fault_valid_o   <= 1'b1;
        fault_code_o    <= fault_code;
        fault_request_o <= fault_request;
        fault_line_o    <= fault_line;
      end
      if (enable_req_i) enable_pending_q <= 1'b1;
      if (reset_req_i | (enable_pending_q & (state_q == On) & puc_done_i)) begin
        state_q       <= Drain;
        fault_valid_o <= 1'b0;
        page_count_q  <= '0;
      end
    end
  end

  // ---- own lines ----
  harpoon_contract_pkg::spl_fault_t report;
  always_comb begin
    report              = '0;
    report.valid        = 8'd1;
    report.error        = 8'd1;
    report.status.code  = fault_code_o;
    report.request.code = fault_request_o;
    report.address.line = fault_line_o;
    own_line            = '0;
    if (own_report_q) own_line = report;
    else              own_line.body = {416'd0, harpoon_contract_pkg::SPL_ID};
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      own_q            <= OwnIdle;
      own_report_q     <= 1'b0;
      id_pending_q     <= 1'b0;
      report_pending_q <= 1'b0;
      spl_dsm_known_q  <= 1'b0;
    end else begin
      unique case (own_q)
        OwnIdle: if (~loading & (state_q != Drain)) begin
          own_report_q <= report_pending_q;
          if (report_pending_q) begin
            report_pending_q <= 1'b0;
            own_q            <= OwnFold;
          end else if (id_pending_q & (state_q != Fault)) begin
            id_pending_q <= 1'b0;
            own_q        <= OwnFold;
          end
        end
        OwnFold: if (~load_line) own_q <= OwnSend;
        OwnSend: if (writer_req_ready) own_q <= OwnIdle;
        default: own_q <= OwnIdle;
      endcase
      if (spl_dsm_commit_i) begin
        id_pending_q    <= 1'b1;
        spl_dsm_known_q <= 1'b1;
      end
      if (fault & ~stop & spl_dsm_known_q) report_pending_q <= 1'b1;
      if (reset_req_i) report_pending_q <= 1'b0;
    end
  end
`ifdef FORMAL
  `include "spl2.svh"
`endif
endmodule
