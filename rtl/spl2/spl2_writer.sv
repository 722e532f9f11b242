// The write port of SPL2: lines in, AXI writes out, acknowledged in any order.
//
// Single beats of 64 bytes; every outstanding write has an ID of its own; AW and W are stable until
// accepted; B is always accepted. One line per cycle, at most `limit_i` outstanding. `idle_o` means
// that everything accepted so far has been acknowledged: the commit point.
//
// `stop_i` drops what has not reached the bus yet and accepts nothing more, except requests marked
// `req_own_i` (SPL2's own fault report). A fault (`fault_o`, one cycle) is a failed translation, an
// error response or a response that belongs to no request.
module spl2_writer #(
  parameter int unsigned MaxInFlight = 64
) (
  input  logic                           clk_i,
  input  logic                           rst_ni,
  input  logic                           stop_i,
  input  logic [$clog2(MaxInFlight):0]   limit_i,

  input  logic                           req_valid_i,
  output logic                           req_ready_o,
  input  logic                           req_own_i,
  input  logic [57:0]                    req_line_i,
  input  logic [511:0]                   req_data_i,

  output logic                           lookup_enable_o,  // to the page table
  input  logic                           lookup_ok_i,
  input  logic [57:0]                    lookup_line_i,

  output logic [$clog2(MaxInFlight):0]   outstanding_o,
  output logic                           idle_o,
  output logic                           fault_o,
  output harpoon_contract_pkg::fault_e   fault_code_o,
  output logic [57:0]                    fault_line_o,

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
    $error("spl2_writer: MaxInFlight must be a power of two, 2 to 128");

  localparam int unsigned ID = $clog2(MaxInFlight);

  logic [57:0]            asked_q [0:MaxInFlight-1];
  logic [MaxInFlight-1:0] awaiting_q;
  logic [ID:0]            outstanding_q;
  logic [ID-1:0]          next_q, aw_id_q;
  logic                   look_valid_q, look_own_q, aw_valid_q, w_valid_q;
  logic [57:0]            look_line_q, aw_line_q;
  logic [511:0]           look_data_q, w_data_q;
  logic                   accept, allowed, bus_free, go, miss, expected;

  assign allowed  = look_valid_q & (~stop_i | look_own_q);
  assign bus_free = (~aw_valid_q | axi_awready_i) & (~w_valid_q | axi_wready_i)
                  & ~awaiting_q[next_q] & (outstanding_q < limit_i);
  assign go       = allowed & lookup_ok_i & bus_free;
  assign miss     = allowed & ~lookup_ok_i;

  assign lookup_enable_o = ~allowed | go;
  assign req_ready_o     = lookup_enable_o & (~stop_i | req_own_i);
  assign accept          = req_valid_i & req_ready_o;
  assign expected        = axi_bvalid_i & awaiting_q[axi_bid_i];
  assign outstanding_o   = outstanding_q;
  assign idle_o          = ~look_valid_q & (outstanding_q == '0);

  assign axi_awvalid_o = aw_valid_q;
  assign axi_awid_o    = aw_id_q;
  assign axi_awline_o  = aw_line_q;
  assign axi_wvalid_o  = w_valid_q;
  assign axi_wdata_o   = w_data_q;

  // | event               | code                                |
  // | stray response      | unexpected_response (address 0)     |
  // | error response      | bus_error                           |
  // | failed translation  | access_violation                    |
  always_comb begin
    fault_o      = 1'b1;
    fault_code_o = harpoon_contract_pkg::FAULT_ACCESS;
    fault_line_o = look_line_q;
    if (axi_bvalid_i & ~expected) begin
      fault_code_o = harpoon_contract_pkg::FAULT_UNEXPECTED;
      fault_line_o = '0;
    end else if (expected & (axi_bresp_i != 2'b00)) begin
      fault_code_o = harpoon_contract_pkg::FAULT_BUS;
      fault_line_o = asked_q[axi_bid_i];
    end else begin
      fault_o = miss;
    end
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      look_valid_q  <= 1'b0;
      look_own_q    <= 1'b0;
      aw_valid_q    <= 1'b0;
      w_valid_q     <= 1'b0;
      awaiting_q    <= '0;
      outstanding_q <= '0;
      next_q        <= '0;
    end else begin
      if (lookup_enable_o) begin
        look_valid_q <= accept;
        look_own_q   <= req_own_i;
      end
      if (axi_awready_i) aw_valid_q <= 1'b0;
      if (axi_wready_i) w_valid_q <= 1'b0;
      if (expected) awaiting_q[axi_bid_i] <= 1'b0;
      if (go) begin
        aw_valid_q         <= 1'b1;
        w_valid_q          <= 1'b1;
        awaiting_q[next_q] <= 1'b1;
        next_q             <= next_q + ID'(1);
      end
      outstanding_q <= outstanding_q + (ID+1)'(go) - (ID+1)'(expected);
    end
    if (accept) begin
      look_line_q <= req_line_i;
      look_data_q <= req_data_i;
    end
    if (go) begin
      aw_id_q         <= next_q;
      aw_line_q       <= lookup_line_i;
      w_data_q        <= look_data_q;
      asked_q[next_q] <= look_line_q;
    end
  end
`ifdef FORMAL
  `include "spl2_writer.svh"
`endif
endmodule
