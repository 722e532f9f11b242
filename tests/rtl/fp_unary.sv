// The cells of one operand alone, for the exhaustive test. No handshake; each output has its cell's
// latency (fp_latency_pkg).
module fp_unary(input logic clk_i, input logic [31 : 0] a_i, output logic [31 : 0] recip_o,
                output logic [31 : 0] sqrt_o);
fp32_recip u_recip(.clk_i, .a_i, .y_o(recip_o));
fp32_sqrt u_sqrt(.clk_i, .a_i, .y_o(sqrt_o));
endmodule
