// a * b.
//
// Handshake: none, one result every cycle. Latency: 8 cycles (fp_latency_pkg::Mul).
// Number format: binary32, nearest even, subnormals kept, correctly rounded; NaN as a class.
// Reset: none needed, the cell has no state beyond the pipeline. No parameters.
//
// A subnormal operand is normalised before the product, so that the product needs no long shift to
// the left. Only one is: the product of two subnormals rounds to zero in any case.
module fp32_mul (
  input  logic        clk_i,
  input  logic [31:0] a_i,
  input  logic [31:0] b_i,
  output logic [31:0] y_o
);
  localparam int unsigned Latency = 8;
  if (Latency != fp_latency_pkg::Mul) begin : gen_latency
    $error("fp32_mul: the scheduler's table has another latency");
  end

  // Stage 1: classify; put the operand that may be subnormal first. Leading zeros are counted of
  // both, beside the finding of which it is.
  logic a_normal, b_normal;
  assign a_normal = |a_i[30:23];
  assign b_normal = |b_i[30:23];
  logic [3:0]  s1_class_q;  // sign, then the first that is set: NaN, infinity, zero
  logic [8:0]  s1_exp_q;  // sum of the biased exponents, 2..508
  logic [4:0]  s1_a_zeros_q, s1_b_zeros_q;  // of the first: the other is 0
  logic [23:0] s1_first_q, s1_second_q;
  leading_zeros31 u_a_zeros (
    .clk_i,
    .clear_i (a_normal),
    .x_i     ({1'b0, a_i[22:0], 7'h40}),
    .n_o     (s1_a_zeros_q)
  );
  leading_zeros31 u_b_zeros (
    .clk_i,
    .clear_i (b_normal | ~a_normal),
    .x_i     ({1'b0, b_i[22:0], 7'h40}),
    .n_o     (s1_b_zeros_q)
  );
  always_ff @(posedge clk_i) begin
    logic a_ones, b_ones, a_some, b_some, a_zero, b_zero;
    a_ones = &a_i[30:23];
    b_ones = &b_i[30:23];
    a_some = |a_i[22:0];
    b_some = |b_i[22:0];
    a_zero = ~(a_normal | a_some);
    b_zero = ~(b_normal | b_some);
    s1_class_q  <= {a_i[31] ^ b_i[31], (a_ones & (a_some | b_zero)) | (b_ones & (b_some | a_zero)),
                    a_ones | b_ones, a_zero | b_zero};
    s1_exp_q    <= {1'b0, a_i[30:24], a_i[23] | ~a_normal}
                 + {1'b0, b_i[30:24], b_i[23] | ~b_normal};
    s1_first_q  <= a_normal ? {b_normal, b_i[22:0]} : {1'b0, a_i[22:0]};
    s1_second_q <= a_normal ? {1'b1, a_i[22:0]} : {b_normal, b_i[22:0]};
  end

  // Stage 2: normalise. The exponent is that of a product whose leading one is bit 46.
  logic [3:0]         s2_class_q;
  logic signed [10:0] s2_exp_q;
  logic [23:0]        s2_first_q, s2_second_q;
  always_ff @(posedge clk_i) begin
    logic [4:0] zeros;
    zeros = s1_a_zeros_q | s1_b_zeros_q;
    s2_class_q  <= s1_class_q;
    s2_exp_q    <= $signed({2'b00, s1_exp_q}) - $signed({6'd0, zeros}) - 11'sd127;
    s2_first_q  <= s1_first_q << zeros;
    s2_second_q <= s1_second_q;
  end

  // Stages 3 to 5: the product. Beside it the shift that makes a tiny result subnormal, and the
  // range of the exponent.
  logic [48:0] product;
  logic        unused_product;
  assign unused_product = product[48];
  mul24 u_mul24 (.clk_i, .a_i(s2_first_q), .b_i({1'b0, s2_second_q}), .y_o(product));

  logic [3:0]         s3_class_q;
  logic signed [10:0] s3_exp_q, s3_minus_exp_q;
  always_ff @(posedge clk_i) begin
    s3_class_q     <= s2_class_q;
    s3_exp_q       <= s2_exp_q;
    s3_minus_exp_q <= -s2_exp_q;
  end
  logic [3:0] s4_class_q;
  logic       s4_normal_q, s4_top_q;
  logic [7:0] s4_exp_q;
  logic [4:0] s4_shift_q;
  always_ff @(posedge clk_i) begin
    s4_class_q  <= s3_class_q | {2'b00, s3_exp_q >= 11'sd255, 1'b0};
    s4_top_q    <= (s3_exp_q == 11'sd254);
    s4_normal_q <= (s3_exp_q >= 11'sd1);
    s4_exp_q    <= s3_exp_q[7:0];
    s4_shift_q  <= (s3_exp_q >= 11'sd0)        ? 5'd0
                 : (s3_minus_exp_q > 11'sd26) ? 5'd26
                                              : s3_minus_exp_q[4:0];
  end
  logic [3:0] s5_class_q;
  logic       s5_normal_q, s5_top_q;
  logic [7:0] s5_exp_q;
  logic [4:0] s5_shift_q;
  always_ff @(posedge clk_i) begin
    s5_class_q  <= s4_class_q;
    s5_top_q    <= s4_top_q;
    s5_normal_q <= s4_normal_q;
    s5_exp_q    <= s4_exp_q;
    s5_shift_q  <= s4_shift_q;
  end

  // Stage 6: shift a tiny product to where exponent 1 has it; keep 26 bits and a sticky bit.
  logic [3:0]  s6_class_q;
  logic        s6_normal_q, s6_sticky_q;
  logic [7:0]  s6_exp_q;
  logic [25:0] s6_upper_q;
  always_ff @(posedge clk_i) begin
    logic lost;
    lost = |(product[47:22] & ~(26'h3ff_ffff << s5_shift_q));
    s6_class_q  <= s5_class_q | {2'b00, s5_top_q & product[47], 1'b0};
    s6_normal_q <= s5_normal_q;
    s6_exp_q    <= s5_exp_q;
    s6_sticky_q <= (|product[21:0]) | lost;
    s6_upper_q  <= product[47:22] >> s5_shift_q;
  end

  // Stage 7: leading one to the hidden place; decide the rounding.
  // | exponent >= 1 | bit 25 | hidden place | exponent field  |
  // |       1       |   1    |      25      | exponent + 1    |
  // |       1       |   0    |      24      | exponent        |
  // |       0       |   x    |      25      | bit 25 (0 or 1) |
  logic [3:0]  s7_class_q;
  logic        s7_up_q;
  logic [7:0]  s7_exp_q;
  logic [22:0] s7_frac_q;
  always_ff @(posedge clk_i) begin
    logic by_one;
    by_one = s6_normal_q & ~s6_upper_q[25];
    s7_class_q <= s6_class_q;
    s7_exp_q   <= (s6_normal_q ? s6_exp_q : 8'd0) + {7'd0, s6_upper_q[25]};
    s7_frac_q  <= by_one ? s6_upper_q[23:1] : s6_upper_q[24:2];
    s7_up_q    <= by_one ? s6_upper_q[0] & (s6_upper_q[1] | s6_sticky_q)
                         : s6_upper_q[1] & (s6_upper_q[2] | s6_upper_q[0] | s6_sticky_q);
  end

  // Stage 8: round, pack. A carry out of the fraction increments the exponent, up to infinity.
  always_ff @(posedge clk_i) begin
    logic [30:0] rounded;
    rounded = {s7_exp_q, s7_frac_q} + {30'd0, s7_up_q};
    if (s7_class_q[2])      y_o <= fp32_pkg::QuietNan;
    else if (s7_class_q[1]) y_o <= {s7_class_q[3], 8'hff, 23'd0};
    else if (s7_class_q[0]) y_o <= {s7_class_q[3], 31'd0};
    else                    y_o <= {s7_class_q[3], rounded};
  end
endmodule
