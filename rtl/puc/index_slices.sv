// Cuts lines of 16 index pairs into slices of Lanes pairs.
//
// What is left of a line that is too short for a slice waits for the next line, so that every slice
// is full but the last. `last_i`: nothing of this line is to wait; a line that is not the last has
// 16 pairs. Ready/valid on both sides, no latency; a slice a cycle. `present_o` has a bit for each
// pair that is there, from the lowest; `number_o` is that of the first. `empty_o`: nothing waits.
// `start_i` forgets what waits. Lanes is 1 to 16.
module index_slices #(
  parameter int unsigned Lanes = 10
) (
  input  logic                clk_i,
  input  logic                rst_ni,
  input  logic                start_i,
  input  logic                valid_i,
  output logic                ready_o,
  input  logic [511:0]        line_i,
  input  logic [30:0]         number_i,   // of the first pair in the line
  input  logic [4:0]          count_i,    // pairs in the line, 1 to 16
  input  logic                last_i,
  output logic                valid_o,
  input  logic                ready_i,
  output logic [32*Lanes-1:0] slice_o,
  output logic [Lanes-1:0]    present_o,
  output logic [30:0]         number_o,
  output logic                empty_o
);
  if (Lanes < 1 || Lanes > 16)
    $error("index_slices: Lanes must be 1 to 16");

  localparam int unsigned PER_LINE = harpoon_contract_pkg::INDEX_PAIRS_PER_LINE;
  localparam int unsigned IDX      = (Lanes > 0) ? 32*Lanes : 32;
  localparam int unsigned KEEP     = (Lanes > 1) ? Lanes - 1 : 1;
  localparam int unsigned PLACE    = $clog2(KEEP + PER_LINE);
  localparam int unsigned SELECT   = $clog2(32*KEEP + 512 + IDX);

  // The slice is the next Lanes pairs of a window, which is what was kept and then the line.
  logic [PLACE-1:0]         place_q;    // of the slice's first pair; KEEP: nothing is kept
  logic [32*KEEP-1:0]       kept_q;
  logic                     issue, used_up;
  logic [5:0]               left;
  logic [32*KEEP+511+IDX:0] window;

  assign left     = 6'(KEEP) + {1'b0, count_i} - 6'(place_q);
  assign used_up  = (left <= 6'(Lanes)) | (~last_i & (left < 6'(2*Lanes)));
  assign valid_o  = valid_i;
  assign issue    = valid_i & ready_i;
  assign ready_o  = ready_i & used_up;
  assign window   = {{IDX{1'b0}}, line_i, kept_q};
  assign slice_o  = window[SELECT'({place_q, 5'd0}) +: IDX];
  assign number_o = number_i + 31'(place_q) - 31'(KEEP);
  assign empty_o  = place_q == PLACE'(KEEP);
  for (genvar g = 0; g < Lanes; g++) begin : gen_present
    assign present_o[g] = 6'(g) < left;
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni || start_i) begin
      place_q <= PLACE'(KEEP);
    end else if (issue) begin
      if (~used_up) place_q <= place_q + PLACE'(Lanes);
      else if (left <= 6'(Lanes)) place_q <= PLACE'(KEEP);
      else place_q <= PLACE'(6'(KEEP + Lanes) - left);
    end
    if (issue & used_up) kept_q <= line_i[511 -: 32*KEEP];
  end
`ifdef FORMAL
  `include "index_slices.svh"
`endif
endmodule
