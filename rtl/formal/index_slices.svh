// Properties of index_slices. Every pair of every line is taken once and in order, in slices that
// are full but for the last. An index pair carries its own number here, so that identity shows in
// the data.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (!rst_ni);

  // Lines come as the PUC sends them: full but for the last, numbered on, and held until taken.
  logic [7:0] f_line_q, f_taken_q;   // number of the line's first pair, pairs taken
  logic       f_last_q;              // the last line was taken
  logic [7:0] f_slice_pairs;
  always_comb begin
    f_slice_pairs = '0;
    for (int unsigned i = 0; i < Lanes; i++) f_slice_pairs = f_slice_pairs + 8'(present_o[i]);
    assume (number_i[7:0] == f_line_q);
    assume (count_i != '0 && count_i <= 5'(PER_LINE) && (last_i || count_i == 5'(PER_LINE)));
    assume (!(valid_i && (f_last_q || start_i)));
    for (int unsigned i = 0; i < PER_LINE; i++) assume (line_i[32*i +: 8] == f_line_q + 8'(i));
  end
  logic       f_waits_q, f_last_before_q;
  logic [4:0] f_count_before_q;
  always_ff @(posedge clk_i) begin
    f_waits_q        <= rst_ni & valid_i & ~ready_o;
    f_count_before_q <= count_i;
    f_last_before_q  <= last_i;
  end
  always_comb if (f_past_q && f_waits_q)
    assume (valid_i && count_i == f_count_before_q && last_i == f_last_before_q);
  always_ff @(posedge clk_i) begin
    if (!rst_ni || start_i) begin
      f_line_q  <= '0;
      f_taken_q <= '0;
      f_last_q  <= 1'b0;
    end else begin
      if (valid_i & ready_o) f_line_q <= f_line_q + 8'(PER_LINE);
      if (issue) f_taken_q <= f_taken_q + f_slice_pairs;
      if (valid_i & ready_o & last_i) f_last_q <= 1'b1;
    end
  end

  logic [Lanes-1:0] f_other_pair;
  for (genvar g = 0; g < Lanes; g++) begin : gen_f_other
    assign f_other_pair[g] = slice_o[32*g +: 8] != f_taken_q + 8'(g);
  end
  always_comb if (f_past_q && rst_ni) begin
    if (issue) begin
      slices_each_once: assert (number_o[7:0] == f_taken_q);
      slices_right_pair: assert ((present_o & f_other_pair) == '0);
      slices_prefix: assert (present_o[0] && ((present_o + 1'b1) & present_o) == '0);
      if (!last_i) slices_full: assert (&present_o);
      if (ready_o && last_i)
        slices_whole_line: assert (f_taken_q + f_slice_pairs == f_line_q + 8'(count_i));
    end
    if (f_last_q) slices_empty: assert (empty_o);
    // invariants
    assert (f_taken_q == 8'(f_line_q + 8'(place_q) - 8'(KEEP)) || f_last_q);
    assert (6'(place_q) < 6'(KEEP + PER_LINE));
    assert (6'(place_q) <= 6'(KEEP)
            || (f_waits_q && 6'(place_q) < 6'(KEEP) + {1'b0, f_count_before_q}
                && (f_last_before_q || 6'(place_q) + 6'(Lanes) <= 6'(KEEP + PER_LINE))));
    for (int unsigned i = 0; i < KEEP; i++) begin
      if (PLACE'(i) >= place_q) assert (kept_q[32*i +: 8] == 8'(f_line_q - 8'(KEEP) + 8'(i)));
    end
  end
