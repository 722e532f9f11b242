// Properties of register_slice: what enters leaves next and once, and holds still until it does.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (!rst_ni);

  always_ff @(posedge clk_i) if (f_past_q && rst_ni && $past(rst_ni)) begin
    if ($past(valid_i & ready_o)) slice_takes: assert (valid_o && data_o == $past(data_i));
    if ($past(~valid_i & ready_o)) slice_empties: assert (!valid_o);
    if ($past(valid_o & ~ready_i)) slice_stable: assert (valid_o && $stable(data_o));
  end
