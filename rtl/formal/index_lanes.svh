// Properties of index_lanes: a slice that is taken finds a place behind the cull lanes, is decided
// once, and its places return when it is done. Slicing and compacting are proven of their own
// modules; queues, credits and cull lanes do what is proven or tested of them.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (!rst_ni);

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
  always_comb begin
    assume (decided == {Lanes{f_cull_q[1]}});
    assume (credit == (f_in_q - f_done_q != 5'(Depth)));
    assume (all_home == (f_in_q == f_done_q));
    if (head_valid) assume (f_decided_before_q != f_done_q);
    if (f_in_before_q != f_done_q) assume (head_queued);
  end

  always_comb if (f_past_q && rst_ni) begin
    lanes_credit: assert (f_in_q - f_done_q <= 5'(Depth));
    lanes_room:   assert (f_decided_q - f_done_q <= 5'(Depth)
                          && !(step && decided[0] && f_decided_q - f_done_q == 5'(Depth)));
    lanes_conserves: assert (f_in_q == f_decided_q + 5'(slice_valid_q) + 5'(fetch_q[0])
                                       + 5'(fetch_q[1]) + 5'(f_cull_q[0]) + 5'(f_cull_q[1]));
    lanes_idle: assert (!idle_o || (f_in_q == f_done_q && none_kept));
    lanes_patient: assert (step || pause_q < PAUSE'(Patience));
    // invariants
    if (head_valid) assert (head_queued);
    assert (f_in_before_q == f_in_q || f_in_before_q + 5'd1 == f_in_q);
    assert (f_decided_before_q == f_decided_q || f_decided_before_q + 5'd1 == f_decided_q);
    assert (f_in_before_q - f_decided_before_q <= 5'd6);
    assert (f_decided_q - f_done_q <= f_in_q - f_done_q);
    assert (f_decided_before_q - f_done_q <= 5'(Depth));
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
