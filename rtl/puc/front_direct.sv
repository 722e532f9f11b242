// The front end of the direct formats: a line of Src is a beat of two pairs, or one. No latency.
//
// `open_i`: the last beat of the job is still to come. `lines_done_i`: no line will come; then a
// job without pairs ends with an empty beat.
module front_direct (
  input  logic             open_i,
  input  logic             lines_done_i,
  input  logic             valid_i,
  output logic             ready_o,
  input  puc_pkg::source_t source_i,
  input  logic [511:0]     line_i,
  output logic             valid_o,
  input  logic             ready_i,
  output puc_pkg::beat_t   beat_o,
  output harpoon_contract_pkg::pair_line_t pairs_o
);
  logic closing;

  assign closing = open_i & lines_done_i & ~valid_i;
  assign valid_o = valid_i | closing;
  assign ready_o = ready_i;
  assign beat_o.last        = source_i.last | closing;
  assign beat_o.mask        = {valid_i & source_i.count[1], valid_i};
  assign beat_o.tags.first  = source_i.number;
  assign beat_o.tags.second = source_i.number | 31'd1;
  assign pairs_o            = line_i;
`ifdef FORMAL
  `include "front_direct.svh"
`endif
endmodule
