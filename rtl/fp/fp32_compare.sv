// a > b, or a <= b with LessOrEqual. Unordered operands (a NaN) compare false either way.
//
// Handshake: none, one result every cycle. Latency: 1 cycle (fp_latency_pkg::Compare).
// Number format: binary32, subnormals kept, -0 equals +0.
// Reset: none needed. Legal: LessOrEqual 0 or 1.
module fp32_compare #(
  parameter bit LessOrEqual = 1'b0
) (
  input  logic        clk_i,
  input  logic [31:0] a_i,
  input  logic [31:0] b_i,
  output logic        y_o
);
  localparam int unsigned Latency = 1;
  if (Latency != fp_latency_pkg::Compare) begin : gen_latency
    $error("fp32_compare: the scheduler's table has another latency");
  end

  // | a < 0 | b < 0 | a > b                  |
  // |   0   |   0   | |a| > |b|              |
  // |   0   |   1   | not both zero          |
  // |   1   |   0   | never                  |
  // |   1   |   1   | |b| > |a|              |
  logic nan, larger, smaller, both_zero, greater;
  always_comb begin
    nan       = ((&a_i[30:23]) & (|a_i[22:0])) | ((&b_i[30:23]) & (|b_i[22:0]));
    larger    = a_i[30:0] > b_i[30:0];
    smaller   = a_i[30:0] < b_i[30:0];
    both_zero = ~(|a_i[30:0]) & ~(|b_i[30:0]);
    unique case ({a_i[31], b_i[31]})
      2'b00:   greater = larger;
      2'b01:   greater = ~both_zero;
      2'b10:   greater = 1'b0;
      default: greater = smaller;
    endcase
  end
  always_ff @(posedge clk_i) y_o <= ~nan & (greater ^ LessOrEqual);
endmodule
