// a * b of unsigned integers, 24 x 25 bits, shaped for the multipliers that FPGAs have.
//
// Handshake: none, one result every cycle. Latency: 3 cycles: both partial products, their second
// register (in a DSP block: M, then P), their sum. Reset: none needed. No parameters.
// b is cut at bit 17 because the unsigned side of a 7-series DSP block is 17 bits wide.
module mul24 (
  input  logic        clk_i,
  input  logic [23:0] a_i,
  input  logic [24:0] b_i,
  output logic [48:0] y_o
);
  logic [40:0] low_q, low2_q;
  logic [31:0] high_q, high2_q;
  always_ff @(posedge clk_i) begin
    logic [31:0] upper;
    upper = high2_q + {8'd0, low2_q[40:17]};
    low_q   <= a_i * b_i[16:0];
    high_q  <= a_i * b_i[24:17];
    low2_q  <= low_q;
    high2_q <= high_q;
    y_o     <= {upper, low2_q[16:0]};
  end
endmodule
