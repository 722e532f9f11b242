// sqrt(a).
//
// Handshake: none, one result every cycle. Latency: 27 cycles (fp_latency_pkg::Sqrt).
// Number format: binary32, nearest even, subnormals kept, correctly rounded; NaN as a class.
// sqrt(-0) is -0; other negative numbers give NaN.
// Reset: none needed, the cell has no state beyond the pipeline. No parameters.
//
// Restoring digit recurrence, one root bit a stage: 25 bits, the last of which rounds. A root never
// lies half-way between two floats (its square would need 49 bits), so that bit alone decides; and
// it is never subnormal.
module fp32_sqrt (
  input  logic        clk_i,
  input  logic [31:0] a_i,
  output logic [31:0] y_o
);
  localparam int unsigned Latency  = 27;
  localparam int unsigned Steps    = 24;
  localparam int unsigned RadSteps = 12;
  if (Latency != fp_latency_pkg::Sqrt) begin : gen_latency
    $error("fp32_sqrt: the scheduler's table has another latency");
  end

  // Stage 1: classify, count leading zeros.
  logic normal, is_zero;
  assign normal  = |a_i[30:23];
  assign is_zero = (a_i[30:0] == 31'd0);
  logic        s1_sign_q, s1_nan_q, s1_inf_q, s1_zero_q;
  logic [7:0]  s1_exp_q;
  logic [4:0]  s1_zeros_q;
  logic [23:0] s1_man_q;
  always_ff @(posedge clk_i) begin
    s1_sign_q  <= a_i[31];
    s1_zero_q  <= is_zero;
    s1_nan_q   <= ((&a_i[30:23]) & (|a_i[22:0])) | (a_i[31] & ~is_zero);
    s1_inf_q   <= (&a_i[30:23]);
    s1_exp_q   <= {a_i[30:24], a_i[23] | ~normal};
    s1_man_q   <= {normal, a_i[22:0]};
  end
  leading_zeros31 u_zeros (
    .clk_i,
    .clear_i (normal),
    .x_i     ({1'b0, a_i[22:0], 7'h40}),
    .n_o     (s1_zeros_q)
  );

  // Stage 2: normalise, halve the exponent, take the first root bit, which is always one.
  logic [8:0]  odd_exp;  // biased exponent + 23, at least 1; odd when the true exponent is even
  logic [23:0] man;
  logic [25:0] radicand;
  logic [1:0]  first;
  always_comb begin
    odd_exp  = {1'b0, s1_exp_q} + 9'd23 - {4'd0, s1_zeros_q};
    man      = s1_man_q << s1_zeros_q;
    radicand = odd_exp[0] ? {man, 2'b00} : {1'b0, man, 1'b0};
    first    = radicand[25:24] - 2'd1;
  end

  // Stages 3 to 26: one bit each. Before step g the root has g + 1 bits and the remainder, at most
  // twice the root, g + 2. The two radicand bits of a step enter as low = bits - 1, the borrow on
  // top, decoded one stage ahead; from step RadSteps on they are zero.
  logic [11:0] side_q [Steps];  // sign, NaN, infinity, zero, half the exponent
  logic [23:0] rad_q  [RadSteps-1];
  logic [2:0]  low_q  [RadSteps];
  logic [24:0] rem_q  [Steps];
  logic [23:0] root_q [Steps+1];
  always_ff @(posedge clk_i) begin
    side_q[0] <= {s1_sign_q, s1_nan_q, s1_inf_q, s1_zero_q, odd_exp[8:1]};
    rad_q[0]  <= {radicand[21:0], 2'b00};
    low_q[0]  <= {1'b0, radicand[23:22]} - 3'd1;
    rem_q[0]  <= {23'd0, first};
    root_q[0] <= 24'd1;
  end
  for (genvar g = 0; g + 2 < RadSteps; g++) begin : gen_rad
    always_ff @(posedge clk_i) rad_q[g+1] <= {rad_q[g][21:0], 2'b00};
  end
  for (genvar g = 0; g + 1 < RadSteps; g++) begin : gen_low
    always_ff @(posedge clk_i) low_q[g+1] <= {1'b0, rad_q[g][23:22]} - 3'd1;
  end
  for (genvar g = 0; g + 1 < Steps; g++) begin : gen_step
    logic [2:0] low;
    if (g < RadSteps) begin : gen_rad_bits
      assign low = low_q[g];
    end else begin : gen_zeros
      assign low = 3'd7;
    end
    always_ff @(posedge clk_i) begin
      logic [g+3:0] trial;  // (remainder - root - borrow) * 2; negative: the bit is 0
      trial = {1'b0, rem_q[g][g+1:0], 1'b0} - {2'b00, root_q[g][g:0], low[2]};
      side_q[g+1] <= side_q[g];
      rem_q[g+1]  <= {{(22-g){1'b0}}, trial[g+3] ? {rem_q[g][g:0], low[1:0] + 2'd1}
                                                 : {trial[g+1:1], low[1:0]}};
      root_q[g+1] <= {root_q[g][22:0], ~trial[g+3]};
    end
  end
  always_ff @(posedge clk_i) begin
    root_q[Steps] <= {root_q[Steps-1][22:0],
                      {rem_q[Steps-1], 1'b0} >= {1'b0, root_q[Steps-1], 1'b1}};
  end

  // Beside the last bit: the exponent field.
  logic       sign_q, nan_q, inf_q, zero_q;
  logic [7:0] exp_q;
  always_ff @(posedge clk_i) begin
    {sign_q, nan_q, inf_q, zero_q} <= side_q[Steps-1][11:8];
    exp_q <= side_q[Steps-1][7:0] + 8'd52;
  end

  // Stage 27: round, pack. The leading one of the root has left root_q.
  always_ff @(posedge clk_i) begin
    logic [30:0] rounded;
    rounded = {exp_q, root_q[Steps][23:1]} + {30'd0, root_q[Steps][0]};
    if (nan_q)       y_o <= fp32_pkg::QuietNan;
    else if (zero_q) y_o <= {sign_q, 31'd0};
    else if (inf_q)  y_o <= {1'b0, 8'hff, 23'd0};
    else             y_o <= {1'b0, rounded};
  end
endmodule
