// Properties of credits, for surroundings that take only what is available and give back only what
// they took.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (!rst_ni);

  logic [W-1:0] f_out_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) f_out_q <= '0;
    else         f_out_q <= f_out_q + W'(take_i) - W'(give_i);
  end
  always_comb begin
    if (take_i) assume (available_o);
    if (give_i) assume (f_out_q != '0);
  end
  always_comb if (f_past_q) begin
    credits_conserve:  assert ({1'b0, left_q} + {1'b0, f_out_q} == (W+1)'(Count));
    credits_available: assert (available_o == (f_out_q != W'(Count)));
    credits_home:      assert (all_home_o == (f_out_q == '0));
  end
