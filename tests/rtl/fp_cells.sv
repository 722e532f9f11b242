// All floating-point cells on shared operands, for the tests: each output is one cell's.
// No handshake; every output has its cell's own latency (fp_latency_pkg).
module fp_cells (
  input  logic        clk_i,
  input  logic [31:0] a_i,
  input  logic [31:0] b_i,
  output logic [31:0] add_o,
  output logic [31:0] sub_o,
  output logic [31:0] mul_o,
  output logic [31:0] recip_o,
  output logic [31:0] sqrt_o,
  output logic [31:0] select_o,
  output logic        greater_o,
  output logic        less_equal_o,
  output logic        sqrt_greater_o
);
  fp32_add #(.Subtract(1'b0)) u_add (.clk_i, .a_i, .b_i, .y_o(add_o));
  fp32_add #(.Subtract(1'b1)) u_sub (.clk_i, .a_i, .b_i, .y_o(sub_o));
  fp32_mul u_mul (.clk_i, .a_i, .b_i, .y_o(mul_o));
  fp32_recip u_recip (.clk_i, .a_i, .y_o(recip_o));
  fp32_sqrt u_sqrt (.clk_i, .a_i, .y_o(sqrt_o));
  fp32_select u_select (.clk_i, .mask_i(a_i[0]), .a_i, .b_i, .y_o(select_o));
  fp32_compare #(.LessOrEqual(1'b0)) u_greater (.clk_i, .a_i, .b_i, .y_o(greater_o));
  fp32_compare #(.LessOrEqual(1'b1)) u_less_equal (.clk_i, .a_i, .b_i, .y_o(less_equal_o));
  fp32_sqrt_greater u_sqrt_greater (.clk_i, .a_i, .b_i, .y_o(sqrt_greater_o));
endmodule
