// sqrt(a) > b for the correctly rounded binary32 root, without taking the root.
//
// Handshake: none, one result every cycle. Latency: 6 cycles (fp_latency_pkg::SqrtGreater).
// Number format: binary32, nearest even, subnormals kept; the decision is exact. Unordered operands
// (a NaN, a negative a) compare false. Reset: none needed. No parameters.
//
// For b >= 0, RN(sqrt(a)) > b exactly when a > (b + ulp(b)/2)^2. With b = M * 2^(e-150) and
// a = S * 2^(f-150), S normalised to 24 bits, that is S * 2^k > (2M+1)^2 for k = f + 152 - 2e, or
// S * 2^(k-2) > M * (M+1), integers both. For a normal b the right side lies in [2^46, 2^48), so
// only k = 25, 26, 27 need the comparison. For a subnormal or zero b any a > 0 is greater.
module fp32_sqrt_greater (
  input  logic        clk_i,
  input  logic [31:0] a_i,
  input  logic [31:0] b_i,
  output logic        y_o
);
  localparam int unsigned Latency = 6;
  if (Latency != fp_latency_pkg::SqrtGreater) begin : gen_latency
    $error("fp32_sqrt_greater: the scheduler's table has another latency");
  end

  // Stage 1: classify, count the leading zeros of a.
  logic a_normal, a_nan, b_nan, a_inf, b_inf, a_zero, b_zero;
  always_comb begin
    a_normal = |a_i[30:23];
    a_nan    = (&a_i[30:23]) & (|a_i[22:0]);
    b_nan    = (&b_i[30:23]) & (|b_i[22:0]);
    a_inf    = (&a_i[30:23]) & ~(|a_i[22:0]);
    b_inf    = (&b_i[30:23]) & ~(|b_i[22:0]);
    a_zero   = ~(|a_i[30:0]);
    b_zero   = ~(|b_i[30:0]);
  end
  logic        s1_true_q, s1_false_q;  // decided without the comparison; false wins
  logic [7:0]  s1_a_exp_q, s1_b_exp_q;
  logic [4:0]  s1_zeros_q;
  logic [23:0] s1_a_q, s1_b_q;
  always_ff @(posedge clk_i) begin
    s1_false_q <= a_nan | b_nan | (a_i[31] & ~a_zero) | (b_inf & ~b_i[31])
                | (a_zero & (b_zero | ~b_i[31]));
    s1_true_q  <= a_inf | b_i[31] | ~(|b_i[30:23]);
    s1_a_exp_q <= {a_i[30:24], a_i[23] | ~a_normal};
    s1_b_exp_q <= b_i[30:23];
    s1_a_q     <= {a_normal, a_i[22:0]};
    s1_b_q     <= {1'b1, b_i[22:0]};
  end
  leading_zeros31 u_zeros (
    .clk_i,
    .clear_i (a_normal),
    .x_i     ({1'b0, a_i[22:0], 7'h40}),
    .n_o     (s1_zeros_q)
  );

  // Stage 2: normalise a; k - 25.
  logic               s2_true_q, s2_false_q;
  logic signed [10:0] s2_k_q;
  logic [23:0]        s2_a_q, s2_b_q;
  logic [24:0]        s2_b_next_q;
  always_ff @(posedge clk_i) begin
    s2_true_q   <= s1_true_q;
    s2_false_q  <= s1_false_q;
    s2_k_q      <= $signed({3'd0, s1_a_exp_q}) - $signed({6'd0, s1_zeros_q})
                 - $signed({2'd0, s1_b_exp_q, 1'b0}) + 11'sd127;
    s2_a_q      <= s1_a_q << s1_zeros_q;
    s2_b_q      <= s1_b_q;
    s2_b_next_q <= {1'b0, s1_b_q} + 25'd1;
  end

  // Stages 3 to 5: M * (M+1), and beside it S * 2^(k-2) and the decided cases.
  logic [48:0] product;
  mul24 u_mul24 (.clk_i, .a_i(s2_b_q), .b_i(s2_b_next_q), .y_o(product));

  logic        s3_true_q, s3_false_q;
  logic [1:0]  s3_shift_q;
  logic [23:0] s3_a_q;
  logic        s4_true_q, s4_false_q, s5_true_q, s5_false_q;
  logic [25:0] s4_a_q, s5_a_q;
  always_ff @(posedge clk_i) begin
    s3_true_q  <= s2_true_q | (s2_k_q > 11'sd2);
    s3_false_q <= s2_false_q | (~s2_true_q & (s2_k_q < 11'sd0));
    s3_shift_q <= s2_k_q[1:0];
    s3_a_q     <= s2_a_q;
    s4_true_q  <= s3_true_q;
    s4_false_q <= s3_false_q;
    s4_a_q     <= {2'b00, s3_a_q} << s3_shift_q;
    s5_true_q  <= s4_true_q;
    s5_false_q <= s4_false_q;
    s5_a_q     <= s4_a_q;
  end

  // Stage 6: compare.
  always_ff @(posedge clk_i) begin
    y_o <= ~s5_false_q & (s5_true_q | ({s5_a_q, 23'd0} > product));
  end
endmodule
