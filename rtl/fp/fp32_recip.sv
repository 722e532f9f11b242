// 1 / a.
//
// Handshake: none, one result every cycle. Latency: 28 cycles (fp_latency_pkg::Recip).
// Number format: binary32, nearest even, subnormals kept, correctly rounded; NaN as a class.
// 1/(+-0) is +-infinity and 1/(+-infinity) is +-0.
// Reset: none needed, the cell has no state beyond the pipeline. No parameters.
//
// Restoring division of 1 by the significand m in [1, 2), one quotient bit a stage: 25 bits of
// 1/m in (1/2, 1], the last of which rounds. 1/m never lies half-way between two floats unless m is
// 1, so that bit alone decides; and for m = 1 the recurrence gives 25 ones, which round up to the
// exact power of two.
module fp32_recip (
  input  logic        clk_i,
  input  logic [31:0] a_i,
  output logic [31:0] y_o
);
  localparam int unsigned Latency = 28;
  localparam int unsigned Steps   = 24;
  if (Latency != fp_latency_pkg::Recip) begin : gen_latency
    $error("fp32_recip: the scheduler's table has another latency");
  end

  // Stage 1: classify, count leading zeros.
  logic normal;
  assign normal = |a_i[30:23];
  logic        s1_sign_q, s1_nan_q, s1_inf_q, s1_zero_q;
  logic [7:0]  s1_exp_q;
  logic [4:0]  s1_zeros_q;
  logic [23:0] s1_den_q;
  always_ff @(posedge clk_i) begin
    s1_sign_q  <= a_i[31];
    s1_nan_q   <= (&a_i[30:23]) & (|a_i[22:0]);
    s1_zero_q  <= (&a_i[30:23]);
    s1_inf_q   <= ~normal & ~(|a_i[22:0]);
    s1_exp_q   <= {a_i[30:24], a_i[23] | ~normal};
    s1_den_q   <= {normal, a_i[22:0]};
  end
  leading_zeros31 u_zeros (
    .clk_i,
    .clear_i (normal),
    .x_i     ({1'b0, a_i[22:0], 7'h40}),
    .n_o     (s1_zeros_q)
  );

  // Stage 2: normalise. exp is one more than the biased exponent of the result (before it rounds up
  // to a power of two), so never negative: 0..277.
  logic        s2_sign_q, s2_nan_q, s2_inf_q, s2_zero_q;
  logic [9:0]  exp;
  logic [7:0]  s2_exp_q;
  logic [23:0] s2_den_q;
  assign exp = 10'd254 - {2'd0, s1_exp_q} + {5'd0, s1_zeros_q};
  always_ff @(posedge clk_i) begin
    s2_sign_q <= s1_sign_q;
    s2_nan_q  <= s1_nan_q;
    s2_zero_q <= s1_zero_q;
    s2_inf_q  <= s1_inf_q | (exp >= 10'd256);
    s2_exp_q  <= exp[7:0];
    s2_den_q  <= s1_den_q << s1_zeros_q;
  end

  // Stage 3: the first quotient bit is always one. Stages 4 to 27: one bit each.
  logic [11:0] side_q [Steps-1];  // sign, NaN, infinity, zero, exponent + 1
  logic [24:0] rem_q  [Steps];
  logic [23:0] den_q  [Steps];
  logic [23:0] quo_q  [Steps];
  logic        last_bit;
  always_ff @(posedge clk_i) begin
    side_q[0] <= {s2_sign_q, s2_nan_q, s2_inf_q, s2_zero_q, s2_exp_q};
    rem_q[0]  <= 25'h100_0000 - {1'b0, s2_den_q};
    den_q[0]  <= s2_den_q;
    quo_q[0]  <= 24'd1;
  end
  for (genvar g = 0; g + 2 < Steps; g++) begin : gen_side
    always_ff @(posedge clk_i) side_q[g+1] <= side_q[g];
  end
  for (genvar g = 0; g + 1 < Steps; g++) begin : gen_step
    always_ff @(posedge clk_i) begin
      logic [25:0] trial;  // negative: the bit is 0
      trial = {rem_q[g], 1'b0} - {2'b00, den_q[g]};
      rem_q[g+1] <= trial[25] ? {rem_q[g][23:0], 1'b0} : trial[24:0];
      den_q[g+1] <= den_q[g];
      quo_q[g+1] <= {quo_q[g][22:0], ~trial[25]};
    end
  end
  assign last_bit = ({rem_q[Steps-1], 1'b0} >= {2'b00, den_q[Steps-1]});

  // Stage 26 also: the exponent field, and whether the result is subnormal by one or two places.
  logic [3:0] s26_class_q;
  logic [7:0] s26_exp_q;
  logic       s26_one_q, s26_two_q;
  always_ff @(posedge clk_i) begin
    s26_class_q <= side_q[Steps-2][11:8];
    s26_exp_q   <= side_q[Steps-2][7:0] - 8'd1;
    s26_two_q   <= (side_q[Steps-2][7:0] == 8'd0);
    s26_one_q   <= (side_q[Steps-2][7:0] == 8'd1);
  end

  // Stage 27 also: denormalise; the last bit left is the one that rounds.
  logic        sign_q, nan_q, inf_q, zero_q, up_q;
  logic [30:0] cut_q;
  always_ff @(posedge clk_i) begin
    {sign_q, nan_q, inf_q, zero_q} <= s26_class_q;
    if (s26_two_q) begin
      {cut_q, up_q} <= {9'd0, quo_q[Steps-1][23:1]};
    end else if (s26_one_q) begin
      {cut_q, up_q} <= {8'd0, quo_q[Steps-1]};
    end else begin
      {cut_q, up_q} <= {s26_exp_q, quo_q[Steps-1][22:0], last_bit};
    end
  end

  // Stage 28: round, pack. A carry out of the fraction increments the exponent, up to infinity.
  always_ff @(posedge clk_i) begin
    logic [30:0] rounded;
    rounded = cut_q + {30'd0, up_q};
    if (nan_q)       y_o <= fp32_pkg::QuietNan;
    else if (zero_q) y_o <= {sign_q, 31'd0};
    else if (inf_q)  y_o <= {sign_q, 8'hff, 23'd0};
    else             y_o <= {sign_q, rounded};
  end
endmodule
