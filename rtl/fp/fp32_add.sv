// a + b, or a - b with Subtract.
//
// Handshake: none, one result every cycle. Latency: 7 cycles (fp_latency_pkg::Add).
// Number format: binary32, nearest even, subnormals kept, correctly rounded; NaN as a class.
// Reset: none needed, the cell has no state beyond the pipeline.
// Legal: Subtract 0 or 1.
module fp32_add #(
  parameter bit Subtract = 1'b0
) (
  input  logic        clk_i,
  input  logic [31:0] a_i,
  input  logic [31:0] b_i,
  output logic [31:0] y_o
);
  localparam int unsigned Latency = 7;
  if (Latency != fp_latency_pkg::Add) begin : gen_latency
    $error("fp32_add: the scheduler's table has another latency");
  end

  // Stage 1: compare magnitudes and take both exponent differences. Exponent field 0 means 1.
  logic        s1_swap_q;
  logic [31:0] s1_a_q, s1_b_q;
  logic [7:0]  s1_a_minus_b_q, s1_b_minus_a_q;
  always_ff @(posedge clk_i) begin
    logic [7:0] a_exp, b_exp;
    a_exp = {a_i[30:24], a_i[23] | ~(|a_i[30:23])};
    b_exp = {b_i[30:24], b_i[23] | ~(|b_i[30:23])};
    s1_swap_q      <= a_i[30:0] < b_i[30:0];
    s1_a_q         <= a_i;
    s1_b_q         <= {b_i[31] ^ Subtract, b_i[30:0]};
    s1_a_minus_b_q <= a_exp - b_exp;
    s1_b_minus_a_q <= b_exp - a_exp;
  end

  // Stage 2: order by magnitude, add hidden bits, classify.
  logic [2:0]  s2_class_q;  // sign, NaN, infinity; likewise below
  logic        s2_minus_q;
  logic [7:0]  s2_exp_q, s2_shift_q;
  logic [23:0] s2_hi_q, s2_lo_q;
  always_ff @(posedge clk_i) begin
    logic [31:0] hi, lo;
    logic        hi_normal, lo_normal;
    hi        = s1_swap_q ? s1_b_q : s1_a_q;
    lo        = s1_swap_q ? s1_a_q : s1_b_q;
    hi_normal = |hi[30:23];
    lo_normal = |lo[30:23];
    s2_class_q <= {hi[31],
                   (&hi[30:23]) & ((|hi[22:0]) | ((&lo[30:23]) & (hi[31] ^ lo[31]))),
                   &hi[30:23]};
    s2_minus_q <= hi[31] ^ lo[31];
    s2_exp_q   <= {hi[30:24], hi[23] | ~hi_normal};
    s2_shift_q <= s1_swap_q ? s1_b_minus_a_q : s1_a_minus_b_q;
    s2_hi_q    <= {hi_normal, hi[22:0]};
    s2_lo_q    <= {lo_normal, lo[22:0]};
  end

  // Stage 3: align the smaller; what falls off is kept as a sticky bit.
  logic [2:0]  s3_class_q;
  logic        s3_minus_q;
  logic [7:0]  s3_exp_q;
  logic [23:0] s3_hi_q;
  logic [26:0] s3_lo_q;
  always_ff @(posedge clk_i) begin
    logic [4:0]  shift;
    logic [26:0] aligned;
    logic        sticky;
    shift   = (s2_shift_q > 8'd27) ? 5'd27 : s2_shift_q[4:0];
    aligned = {s2_lo_q, 3'b000} >> shift;
    sticky  = |({s2_lo_q, 3'b000} & ~(27'h7ff_ffff << shift));
    s3_class_q <= s2_class_q;
    s3_minus_q <= s2_minus_q;
    s3_exp_q   <= s2_exp_q;
    s3_hi_q    <= s2_hi_q;
    s3_lo_q    <= {aligned[26:1], aligned[0] | sticky};
  end

  // Stage 4: add or subtract. The larger comes first, so the difference is never negative.
  logic [2:0]  s4_class_q;
  logic        s4_minus_q;
  logic [7:0]  s4_exp_q;
  logic [27:0] s4_floor_q;  // a one where exponent 1 has its hidden bit
  logic [27:0] s4_sum_q;
  always_ff @(posedge clk_i) begin
    s4_class_q <= s3_class_q;
    s4_minus_q <= s3_minus_q;
    s4_exp_q   <= s3_exp_q;
    s4_floor_q <= 28'h800_0000 >> s3_exp_q;
    s4_sum_q   <= {1'b0, s3_hi_q, 3'b000} + ({1'b0, s3_lo_q} ^ {28{s3_minus_q}})
                + {27'd0, s3_minus_q};
  end

  // Stage 5: how far to shift up: to the leading one, but not below exponent 1 (gradual underflow).
  // 0: there was a carry out; 1: as it is.
  logic [2:0]  s5_class_q;
  logic        s5_minus_q;
  logic [7:0]  s5_exp_q;  // after a carry out
  logic [4:0]  s5_shift_q;
  logic [27:0] s5_sum_q;
  always_ff @(posedge clk_i) begin
    s5_class_q <= s4_class_q;
    s5_minus_q <= s4_minus_q;
    s5_exp_q   <= s4_exp_q + 8'd1;
    s5_sum_q   <= s4_sum_q;
  end
  leading_zeros31 u_shift (
    .clk_i,
    .clear_i (1'b0),
    .x_i     ({s4_sum_q | s4_floor_q, 3'b100}),
    .n_o     (s5_shift_q)
  );

  // Stage 6: normalise; decide the rounding. Exact cancellation gives +0.
  logic [2:0]  s6_class_q;
  logic        s6_up_q;
  logic [7:0]  s6_exp_q;
  logic [22:0] s6_frac_q;
  always_ff @(posedge clk_i) begin
    logic [27:0] norm;
    logic [7:0]  norm_exp;
    norm     = s5_sum_q << s5_shift_q;
    norm_exp = s5_exp_q - {3'd0, s5_shift_q};
    s6_class_q <= (s5_class_q | {2'b00, norm_exp == 8'hff})
                & ~{(s5_sum_q == 28'd0) & s5_minus_q, 2'b00};
    s6_exp_q   <= norm[27] ? norm_exp : 8'd0;
    s6_frac_q  <= norm[26:4];
    s6_up_q    <= norm[3] & (norm[4] | (|norm[2:0]));
  end

  // Stage 7: round, pack. A carry out of the fraction increments the exponent, up to infinity.
  always_ff @(posedge clk_i) begin
    logic [30:0] rounded;
    rounded = {s6_exp_q, s6_frac_q} + {30'd0, s6_up_q};
    if (s6_class_q[1])      y_o <= fp32_pkg::QuietNan;
    else if (s6_class_q[0]) y_o <= {s6_class_q[2], 8'hff, 23'd0};
    else                    y_o <= {s6_class_q[2], rounded};
  end
endmodule
