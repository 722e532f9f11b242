// Properties of source_numbers: pair numbers follow on, and the pairs of all lines are those of the
// job, of which one line is the last. Lines of a job come once it has begun, none after the last.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (start_i && pair_count_i != '0);

  logic [32:0] f_seen_q;   // pairs of the lines that went
  logic [31:0] f_pairs_q;  // of the job
  logic        f_over_q, f_indexed_q;
  always_ff @(posedge clk_i) begin
    if (start_i) begin
      f_seen_q    <= '0;
      f_pairs_q   <= pair_count_i;
      f_over_q    <= pair_count_i == '0;
      f_indexed_q <= indexed_i;
    end else if (taken_i) begin
      f_seen_q <= f_seen_q + 33'(source_o.count);
      f_over_q <= source_o.last;
    end
  end
  always_comb begin
    assume (pair_count_i < 32'h8000_0000);
    if (f_over_q || start_i) assume (!taken_i);
    if (f_past_q && !start_i) assume (indexed_i == f_indexed_q);
  end

  always_comb if (f_past_q && !start_i) begin
    if (!f_over_q) begin
      numbers_follow: assert ({2'b00, source_o.number} == f_seen_q);
      numbers_some: assert (source_o.count != '0 && 32'(source_o.count) <= per_line);
      numbers_full: assert (source_o.last || 32'(source_o.count) == per_line);
      numbers_last: assert (source_o.last
                            == (f_seen_q + 33'(source_o.count) == {1'b0, f_pairs_q}));
      assert ({1'b0, left_q} + f_seen_q == {1'b0, f_pairs_q} && left_q != '0);
      assert (number_q[31] == 1'b0);
    end else begin
      numbers_all: assert (f_seen_q == {1'b0, f_pairs_q});
    end
    assert (f_pairs_q < 32'h8000_0000);
  end
