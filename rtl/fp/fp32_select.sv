// mask ? a : b, bits untouched.
//
// Handshake: none, one result every cycle. Latency: 1 cycle (fp_latency_pkg::Select).
// Reset: none needed. No parameters.
module fp32_select (
  input  logic        clk_i,
  input  logic        mask_i,
  input  logic [31:0] a_i,
  input  logic [31:0] b_i,
  output logic [31:0] y_o
);
  localparam int unsigned Latency = 1;
  if (Latency != fp_latency_pkg::Select) begin : gen_latency
    $error("fp32_select: the scheduler's table has another latency");
  end
  always_ff @(posedge clk_i) y_o <= mask_i ? a_i : b_i;
endmodule
