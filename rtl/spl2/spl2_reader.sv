// The read port of SPL2: line requests in, lines out in the same order, whatever the order in which
// the memory answers.
//
// Each request takes the next slot of a ring of MaxInFlight lines; the slot's number is its AXI ID,
// so an ID is never outstanding twice (the rule of AWS F2). A slot is free again once its line has
// left. One line per cycle. At most `limit_i` slots are taken. The AXI master sends single beats of
// 64 bytes, so no burst crosses 4 KB; AR is stable until it is accepted; R is always accepted.
//
// `stop_i` drops what has not reached the bus yet and accepts nothing more. `clear_i` empties the
// ring; it is legal only while stopped with `outstanding_o` = 0.
// A fault (`fault_o`, one cycle) is a failed translation, an error response or a response that
// belongs to no request; `fault_line_o` is the address that was asked for.
module spl2_reader #(
  parameter int unsigned MaxInFlight = 64
) (
  input  logic                           clk_i,
  input  logic                           rst_ni,
  input  logic                           clear_i,
  input  logic                           stop_i,
  input  logic [$clog2(MaxInFlight):0]   limit_i,

  input  logic                           req_valid_i,
  output logic                           req_ready_o,
  input  logic [57:0]                    req_line_i,

  output logic                           rsp_valid_o,
  input  logic                           rsp_ready_i,
  output logic [511:0]                   rsp_data_o,

  output logic                           lookup_enable_o,  // to the page table
  input  logic                           lookup_ok_i,
  input  logic [57:0]                    lookup_line_i,

  output logic [$clog2(MaxInFlight):0]   outstanding_o,
  output logic                           fault_o,
  output harpoon_contract_pkg::fault_e   fault_code_o,
  output logic [57:0]                    fault_line_o,

  output logic                           axi_arvalid_o,
  input  logic                           axi_arready_i,
  output logic [$clog2(MaxInFlight)-1:0] axi_arid_o,
  output logic [57:0]                    axi_arline_o,
  input  logic                           axi_rvalid_i,
  input  logic [$clog2(MaxInFlight)-1:0] axi_rid_i,
  input  logic [511:0]                   axi_rdata_i,
  input  logic [1:0]                     axi_rresp_i
);
  if (MaxInFlight < 2 || MaxInFlight > 128 || 1 << $clog2(MaxInFlight) != MaxInFlight)
    $error("spl2_reader: MaxInFlight must be a power of two, 2 to 128");

  localparam int unsigned ID = $clog2(MaxInFlight);

  logic [511:0]           mem_q   [0:MaxInFlight-1];
  logic [57:0]            asked_q [0:MaxInFlight-1];
  logic [MaxInFlight-1:0] awaiting_q, filled_q;
  logic [ID:0]            tail_q, head_q, outstanding_q;
  logic                   out_valid_q;
  logic [511:0]           out_q;

  // request -> lookup -> AR
  logic          look_valid_q, ar_valid_q, accept, go, miss;
  logic [ID-1:0] look_id_q, ar_id_q;
  logic [57:0]   look_line_q, ar_line_q;

  assign go              = look_valid_q & lookup_ok_i & ~stop_i & (~ar_valid_q | axi_arready_i);
  assign miss            = look_valid_q & ~lookup_ok_i & ~stop_i;
  assign lookup_enable_o = ~look_valid_q | go | stop_i;
  assign req_ready_o     = ~stop_i & lookup_enable_o & ((tail_q - head_q) < limit_i);
  assign accept          = req_valid_i & req_ready_o;
  assign axi_arvalid_o   = ar_valid_q;
  assign axi_arid_o      = ar_id_q;
  assign axi_arline_o    = ar_line_q;
  assign outstanding_o   = outstanding_q;

  // responses
  logic expected, pop;
  assign expected    = axi_rvalid_i & awaiting_q[axi_rid_i];
  assign pop         = filled_q[head_q[ID-1:0]] & (~out_valid_q | rsp_ready_i);
  assign rsp_valid_o = out_valid_q;
  assign rsp_data_o  = out_q;

  // | event               | code                                |
  // | stray response      | unexpected_response (address 0)     |
  // | error response      | bus_error                           |
  // | failed translation  | access_violation                    |
  always_comb begin
    fault_o      = 1'b1;
    fault_code_o = harpoon_contract_pkg::FAULT_ACCESS;
    fault_line_o = look_line_q;
    if (axi_rvalid_i & ~expected) begin
      fault_code_o = harpoon_contract_pkg::FAULT_UNEXPECTED;
      fault_line_o = '0;
    end else if (expected & (axi_rresp_i != 2'b00)) begin
      fault_code_o = harpoon_contract_pkg::FAULT_BUS;
      fault_line_o = asked_q[axi_rid_i];
    end else begin
      fault_o = miss;
    end
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      look_valid_q  <= 1'b0;
      ar_valid_q    <= 1'b0;
      awaiting_q    <= '0;
      filled_q      <= '0;
      tail_q        <= '0;
      head_q        <= '0;
      outstanding_q <= '0;
      out_valid_q   <= 1'b0;
    end else begin
      if (lookup_enable_o) look_valid_q <= accept;
      if (accept) begin
        tail_q <= tail_q + (ID+1)'(1);
      end
      if (go) begin
        ar_valid_q            <= 1'b1;
        awaiting_q[look_id_q] <= 1'b1;
      end else if (axi_arready_i) begin
        ar_valid_q <= 1'b0;
      end
      if (expected) begin
        awaiting_q[axi_rid_i] <= 1'b0;
        filled_q[axi_rid_i]   <= 1'b1;
      end
      outstanding_q <= outstanding_q + (ID+1)'(go) - (ID+1)'(expected);
      if (pop) begin
        filled_q[head_q[ID-1:0]] <= 1'b0;
        head_q                   <= head_q + (ID+1)'(1);
        out_valid_q              <= 1'b1;
      end else if (rsp_ready_i) begin
        out_valid_q <= 1'b0;
      end
      if (clear_i) begin
        look_valid_q <= 1'b0;
        filled_q     <= '0;
        tail_q       <= '0;
        head_q       <= '0;
        out_valid_q  <= 1'b0;
      end
    end
    if (accept) begin
      look_id_q                <= tail_q[ID-1:0];
      look_line_q              <= req_line_i;
      asked_q[tail_q[ID-1:0]]  <= req_line_i;
    end
    if (go) begin
      ar_id_q   <= look_id_q;
      ar_line_q <= lookup_line_i;
    end
    if (expected) mem_q[axi_rid_i] <= axi_rdata_i;
    if (pop) out_q <= mem_q[head_q[ID-1:0]];
  end
`ifdef FORMAL
  `include "spl2_reader.svh"
`endif
endmodule
