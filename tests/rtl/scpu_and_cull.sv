// An scpu and its miss test on the same pairs, for the tests: one model instead of two.
module scpu_and_cull (
  input  logic         clk_i,
  input  logic         rst_ni,
  input  logic         valid_i,
  input  logic [255:0] pair_i,
  output logic         valid_o,
  output logic [255:0] contact_o,
  output logic         cull_valid_o,
  output logic         miss_o
);
  scpu u_scpu (.clk_i, .rst_ni, .valid_i, .pair_i, .valid_o, .contact_o);
  scpu_cull u_scpu_cull (.clk_i, .rst_ni, .valid_i, .pair_i, .valid_o(cull_valid_o), .miss_o);
endmodule
