// Properties of scpu_array. Every beat that enters leaves the SCPUs once, in order: one beat, the
// f_index-th, is coloured, and so must be the f_index-th result and no other. Queues and credits do
// what is proven of them.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (!rst_ni);

  (* anyconst *) logic [4:0] f_index;
  logic [4:0] f_in_q, f_results_q, f_out_q;       // beats in, results queued, beats out
  logic [4:0] f_in_before_q, f_results_before_q;  // a cycle ago
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      f_in_q             <= '0;
      f_results_q        <= '0;
      f_out_q            <= '0;
      f_in_before_q      <= '0;
      f_results_before_q <= '0;
    end else begin
      if (issue) f_in_q <= f_in_q + 5'd1;
      if (merged_valid_q) f_results_q <= f_results_q + 5'd1;
      if (valid_o & ready_i) f_out_q <= f_out_q + 5'd1;
      f_in_before_q      <= f_in_q;
      f_results_before_q <= f_results_q;
    end
  end
  always_comb begin
    assume (beat_i.mask != 2'b10);
    assume (pairs_i.first.p1.x[0] == (f_in_q == f_index)
            && pairs_i.second.p1.x[0] == (f_in_q == f_index));
    // credits (credits_available, credits_home) and fifo (fifo_prompt, fifo_conserves)
    assume (credit == (f_in_q - f_out_q != 5'(Depth)));
    assume (all_home == (f_in_q == f_out_q));
    if (valid_o) assume (f_results_before_q != f_out_q);
    if (f_in_before_q != f_out_q) assume (tag_valid);
  end

  // What an scpu does: its valid bit and the colour of its pair appear scpu_pkg::Latency ticks of
  // its clock after they entered; without a tick nothing changes.
  logic [NumScpu-1:0] f_at [0:2];
  logic [NumScpu-1:0] f_coloured [0:2];
  for (genvar g = 0; g < NumScpu; g++) begin : gen_f_scpu
    logic           f_running, f_start, f_colour;
    logic [RUN-1:0] f_run;
    assign f_running = gen_column[g/SLOTS].running;
    assign f_run     = gen_column[g/SLOTS].run_q;
    assign f_start   = gen_column[g/SLOTS].gen_slot[g%SLOTS].start_q;
    assign f_colour  = gen_column[g/SLOTS].gen_slot[g%SLOTS].pair_q[0];
    logic [1:0] f_valid_q, f_colour_q;
    always_ff @(posedge clk_i) begin
      if (!rst_ni) f_valid_q <= '0;
      else if (f_running) f_valid_q <= {f_valid_q[0], f_start};
      if (f_running) f_colour_q <= {f_colour_q[0], f_colour};
    end
    always_comb begin
      assume (done[g] == f_valid_q[1]);
      assume (contact[256*g] == f_colour_q[1]);
    end
    // it ticks as long as it holds a pair
    always_comb if (f_past_q && rst_ni) begin
      if (f_start) assert (f_run == RUN'(scpu_pkg::Latency + 2));
      if (f_valid_q[0]) assert (f_run >= RUN'(scpu_pkg::Latency + 1));
      if (f_valid_q[1]) assert (f_run >= RUN'(scpu_pkg::Latency));
    end
    assign f_at[0][g] = f_start;
    assign f_at[1][g] = f_valid_q[0];
    assign f_at[2][g] = f_valid_q[1];
    assign f_coloured[0][g] = f_start & f_colour;
    assign f_coloured[1][g] = f_valid_q[0] & f_colour_q[0];
    assign f_coloured[2][g] = f_valid_q[1] & f_colour_q[1];
  end

  // Where beats are: entered, in the SCPUs, merged. Each is newer than the next.
  logic [4:0] f_newer [0:3];
  logic [3:0] f_there;
  logic       f_merged_colour_q;
  always_ff @(posedge clk_i) if (|done) f_merged_colour_q <= merged[0];
  assign f_there    = {merged_valid_q, |f_at[2], |f_at[1], |f_at[0]};
  assign f_newer[0] = '0;
  assign f_newer[1] = f_newer[0] + 5'(f_there[0]);
  assign f_newer[2] = f_newer[1] + 5'(f_there[1]);
  assign f_newer[3] = f_newer[2] + 5'(f_there[2]);
  logic [NumScpu-1:0] f_even;
  for (genvar g = 0; g < NumScpu; g++) begin : gen_f_even
    assign f_even[g] = (g % SLOTS) == 0;
  end

  always_comb if (f_past_q && rst_ni) begin
    array_conserves:
      assert (f_in_q == f_results_q + f_newer[3] + 5'(f_there[3]));
    array_credit:    assert (f_in_q - f_out_q <= 5'(Depth));
    array_room:      assert (f_results_q - f_out_q <= 5'(Depth)
                             && !(merged_valid_q && f_results_q - f_out_q == 5'(Depth)));
    if (merged_valid_q) array_order: assert (merged_q[0] == (f_results_q == f_index));
    array_idle: assert (idle_o == (f_there == '0 && f_results_q == f_out_q));
    array_one_column: assert ((done & f_even & (done & f_even) - 1'b1) == '0);
    array_patient: assert (step || pause_q < PAUSE'(Patience));
    // invariants
    if (valid_o) assert (tag_valid);
    assert (f_merged_colour_q == merged_q[0] || !merged_valid_q);
    assert (f_in_before_q == f_in_q || f_in_before_q + 5'd1 == f_in_q);
    assert (f_results_before_q == f_results_q || f_results_before_q + 5'd1 == f_results_q);
    assert (f_in_before_q - f_results_before_q <= 5'd4);
    assert (f_results_q - f_out_q <= f_in_q - f_out_q);
    assert (f_results_before_q - f_out_q <= 5'(Depth));
    for (int unsigned s = 0; s < 3; s++) begin
      assert ((f_at[s] & f_even & (f_at[s] & f_even) - 1'b1) == '0);
      assert (SLOTS == 1 || (f_at[s] & ~f_even & ~(f_even << 1 & f_at[s] << 1)) == '0);
      if (|f_at[s]) begin
        assert ((f_coloured[s] != '0) == (f_in_q - 5'd1 - f_newer[s] == f_index));
        assert (f_coloured[s] == '0 || f_coloured[s] == f_at[s]);
      end
    end
  end
  always_ff @(posedge clk_i) if (f_past_q && rst_ni && $past(rst_ni)) begin
    if ($past(scpu_rst_nq && more_i && !valid_i && pause_q != PAUSE'(Patience)))
      array_waits: assert ($stable(done) && !merged_valid_q);
  end
