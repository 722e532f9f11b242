// Properties of index_lanes. Every pair of every line is taken once and in order, in slices that
// are full but for the last; every pair that is not ruled out leaves once and in order. An index
// pair carries its own number here, so that identity shows in the data. Queues, credits and cull
// lanes do what is proven or tested of them.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (!rst_ni);

  // Lines come as the PUC sends them: full but for the last, numbered on, and held until taken.
  logic [7:0] f_line_q, f_taken_q;   // number of the line's first pair, pairs taken
  logic       f_last_q;              // the last line was taken
  logic [7:0] f_slice_pairs;
  always_comb begin
    f_slice_pairs = '0;
    for (int unsigned i = 0; i < Lanes; i++) f_slice_pairs = f_slice_pairs + 8'(present[i]);
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

  // Slices in, decisions queued, slices done.
  logic [4:0] f_in_q, f_decided_q, f_done_q, f_in_before_q, f_decided_before_q;
  logic [1:0] f_cull_q;   // the cull lanes, all alike
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      f_in_q             <= '0;
      f_decided_q        <= '0;
      f_done_q           <= '0;
      f_in_before_q      <= '0;
      f_decided_before_q <= '0;
      f_cull_q           <= '0;
    end else begin
      if (issue) f_in_q <= f_in_q + 5'd1;
      if (step & decided[0]) f_decided_q <= f_decided_q + 5'd1;
      if (head_done) f_done_q <= f_done_q + 5'd1;
      f_in_before_q      <= f_in_q;
      f_decided_before_q <= f_decided_q;
      if (running) f_cull_q <= {f_cull_q[0], fetch_q[1]};
    end
  end
  logic [Lanes-1:0] f_miss_q, f_present_q;   // of the head, held by the queues
  logic [30:0]      f_number_q;
  logic             f_held_q;
  always_ff @(posedge clk_i) begin
    f_held_q    <= rst_ni & head_valid & ~head_done;
    f_miss_q    <= head_miss;
    f_present_q <= head_present;
    f_number_q  <= head_number;
  end
  always_comb begin
    assume (decided == {Lanes{f_cull_q[1]}});
    assume (credit == (f_in_q - f_done_q != 5'(Depth)));
    assume (all_home == (f_in_q == f_done_q));
    if (head_valid) assume (f_decided_before_q != f_done_q);
    if (f_in_before_q != f_done_q) assume (head_queued);
    if (f_past_q && f_held_q)
      assume (head_valid && head_miss == f_miss_q && head_present == f_present_q
              && head_number == f_number_q);
  end

  logic [Lanes-1:0] f_other_pair;
  for (genvar g = 0; g < Lanes; g++) begin : gen_f_other
    assign f_other_pair[g] = slice[32*g +: 8] != f_taken_q + 8'(g);
  end
  logic [Lanes-1:0] f_kept;   // survivors of the head, sent or not
  assign f_kept = head_present & ~head_miss;
  always_comb if (f_past_q && rst_ni) begin
    if (issue) begin
      lanes_each_once: assert (8'(number_i[7:0] + 8'(place_q) - 8'(KEEP)) == f_taken_q);
      lanes_right_pair: assert ((present & f_other_pair) == '0);
      lanes_prefix: assert (present[0] && ((present + 1'b1) & present) == '0);
      if (!last_i) lanes_full: assert (&present);
      if (ready_o && last_i)
        lanes_whole_line: assert (f_taken_q + f_slice_pairs == f_line_q + 8'(count_i));
    end
    lanes_credit: assert (f_in_q - f_done_q <= 5'(Depth));
    lanes_room:   assert (f_decided_q - f_done_q <= 5'(Depth)
                          && !(step && decided[0] && f_decided_q - f_done_q == 5'(Depth)));
    lanes_conserves: assert (f_in_q == f_decided_q + 5'(slice_valid_q) + 5'(fetch_q[0])
                                       + 5'(fetch_q[1]) + 5'(f_cull_q[0]) + 5'(f_cull_q[1]));
    lanes_idle: assert (!idle_o || (f_in_q == f_done_q && place_q == PLACE'(KEEP)));
    // compaction
    if (compact) begin
      lanes_survivors_only: assert (((first_hot | second_hot) & ~f_kept) == '0
                                    && ((first_hot | second_hot) & sent_q) == '0);
      lanes_two_a_beat: assert (first_hot != '0 && (first_hot & (first_hot - 1'b1)) == '0
                                && (second_hot & (second_hot - 1'b1)) == '0
                                && found == {second_hot != '0, 1'b1});
      lanes_in_order: assert (first_hot > sent_q && (second_hot == '0 || second_hot > first_hot));
    end
    if (head_done) lanes_none_lost: assert ((sent_q | (compact ? first_hot | second_hot : '0))
                                            == f_kept);
    lanes_patient: assert (step || pause_q < PAUSE'(Patience));
    // invariants
    if (head_valid) assert (head_queued);
    assert (!head_valid || (sent_q & ~f_kept) == '0);
    assert (head_valid || sent_q == '0);
    assert (sent_q == '0 || survivors == '0 || (survivors & (~survivors + 1'b1)) > sent_q);
    assert (f_in_before_q == f_in_q || f_in_before_q + 5'd1 == f_in_q);
    assert (f_decided_before_q == f_decided_q || f_decided_before_q + 5'd1 == f_decided_q);
    assert (f_in_before_q - f_decided_before_q <= 5'd6);
    assert (f_decided_q - f_done_q <= f_in_q - f_done_q);
    assert (f_decided_before_q - f_done_q <= 5'(Depth));
    assert (f_taken_q == 8'(f_line_q + 8'(place_q) - 8'(KEEP)) || f_last_q);
    assert (!f_last_q || place_q == PLACE'(KEEP));
    assert (6'(place_q) < 6'(KEEP + PER_LINE));
    assert (6'(place_q) <= 6'(KEEP)
            || (f_waits_q && 6'(place_q) < 6'(KEEP) + {1'b0, f_count_before_q}
                && (f_last_before_q || 6'(place_q) + 6'(Lanes) <= 6'(KEEP + PER_LINE))));
    for (int unsigned i = 0; i < KEEP; i++) begin
      if (PLACE'(i) >= place_q) assert (kept_q[32*i +: 8] == 8'(f_line_q - 8'(KEEP) + 8'(i)));
    end
    if (fetch_q[1]) assert (pause_q == '0 || run_q != '0 || running);
    if (f_cull_q[0]) assert (run_q >= RUN'(scpu_pkg::CullLatency + 1));
    if (f_cull_q[1]) assert (run_q >= RUN'(scpu_pkg::CullLatency));
  end
  always_ff @(posedge clk_i) if (f_past_q && rst_ni && $past(rst_ni)) begin
    if ($past(valid_o & ~ready_i))
      lanes_stable: assert (valid_o && $stable(mask_o) && $stable(numbers_o));
    if (!$past(start_i) && $past(index_error_o)) lanes_error_stays: assert (index_error_o);
    if ($past(slice_valid_q && present_q[0] && !start_i
              && 32'(slice_q[15:0]) >= spheres_q))
      lanes_error_seen: assert (index_error_o);
    if ($past(!index_error_o) && index_error_o)
      lanes_error_true: assert ($past(slice_valid_q) && $past(outside) != '0);
  end
