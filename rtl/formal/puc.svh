// Properties of the PUC's sequence: what is written when. Collector, lanes, SCPUs and dispatcher
// are arbitrary but for their own proven properties: a finished collector stays finished and quiet,
// and a dispatcher that was flushed and emptied writes nothing more.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (!rst_ni && !cold_rst_ni);

  // Writes that were accepted and not yet acknowledged; write_idle_i tells the truth about them.
  logic [3:0]  f_pending_q, f_statuses_q, f_runs_q;
  logic [31:0] f_sent_q;
  logic        f_flushed_q, f_dry_q, f_finished_q, f_counted_q;
  (* anyseq *) logic f_ack;
  (* anyconst *) logic [31:0] f_config;
  always_comb begin
    assume (config_i == f_config);
    if (f_ack) assume (f_pending_q != '0);
    assume (write_idle_i == (f_pending_q == '0));
    if (f_pending_q >= 4'd14) assume (!write_ready_i);
    assume (lines_written == f_sent_q && f_sent_q != '1);
    if (dispatcher_write) assume (!dispatcher_idle && f_runs_q != '0);
    if (f_dry_q) assume (dispatcher_idle);
    if (f_finished_q) assume (collector_done);
    if (collector_done || f_runs_q == '0) begin
      assume (!collector_read && !collector_data_ready && !source_valid);
    end
    if (!cold_rst_ni) assume (!rst_ni);
  end
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      f_pending_q  <= '0;
      f_statuses_q <= '0;
      f_runs_q     <= '0;
      f_sent_q     <= '0;
      f_flushed_q  <= 1'b0;
      f_dry_q      <= 1'b0;
      f_finished_q <= 1'b0;
      f_counted_q  <= 1'b0;
    end else begin
      f_pending_q <= f_pending_q + 4'(write_valid_o & write_ready_i) - 4'(f_ack);
      if (own_write & write_ready_i & (line_q == SendStatus)) f_statuses_q <= f_statuses_q + 4'd1;
      if (own_write & write_ready_i & (line_q == SendPerformance)) f_counted_q <= 1'b1;
      if (start_q) f_runs_q <= f_runs_q + 4'd1;
      if (line_sent) f_sent_q <= f_sent_q + 32'd1;
      if (state_q == Flush) f_flushed_q <= 1'b1;
      f_dry_q      <= f_dry_q | (f_flushed_q & dispatcher_idle);
      f_finished_q <= f_finished_q | ((f_runs_q != '0) & collector_done);
    end
  end

  logic f_ending;   // the counters or the Status are next
  assign f_ending = (state_q != Idle) & (state_q != Fetch) & (state_q != Judge) & (state_q != Run)
                  & (line_q != SendId);
  always_comb if (f_past_q && rst_ni) begin
    if (own_write && line_q == SendStatus)
      puc_status_last: assert (f_pending_q == '0 && f_counted_q && !dispatcher_write);
    if (own_write && line_q == SendLatency && f_sent_q != '0)
      puc_counters_after_results: assert (f_pending_q == '0);
    if (own_write && line_q == SendLatency) puc_counters_after_run: assert (!dispatcher_write);
    if (state_q == Done)
      puc_done: assert (f_pending_q == '0 && f_statuses_q == 4'd1 && f_counted_q);
    puc_one_status: assert (f_statuses_q <= 4'd1);
    puc_one_start:  assert (f_runs_q + 4'(start_q) <= 4'd1);
    if (start_q) puc_starts_good: assert (error_q == harpoon_contract_pkg::ERROR_NONE);
    if (state_q == Done) puc_quiet_when_done: assert (!own_write && !dispatcher_write);
    // invariants
    if (state_q == Idle || state_q == Fetch || state_q == Judge) begin
      assert (f_runs_q == '0 && !start_q && f_statuses_q == '0 && !f_counted_q && !f_flushed_q);
      assert (!running_q && f_sent_q == '0);
    end
    if (start_q) assert (state_q == Fold && line_q == SendId && f_runs_q == '0);
    if (running_q) assert (f_runs_q == 4'd1 || start_q);
    if (state_q == Run) assert (running_q);
    if (state_q == Flush) assert (running_q && f_finished_q);
    if (f_ending && state_q != Flush && f_runs_q != '0) assert (f_flushed_q && f_finished_q);
    if (f_ending && f_runs_q == '0) assert (!running_q && f_sent_q == '0 && !start_q);
    if (f_ending && state_q != Flush && !(state_q == Settle && line_q == SendLatency)) begin
      assert (!running_q);
      if (f_runs_q != '0) assert (f_dry_q);
    end
    if (state_q == Fold && line_q == SendStatus) assert (f_pending_q == '0 && f_counted_q);
    if (state_q == Fold && line_q == SendLatency && f_sent_q != '0) assert (f_pending_q == '0);
    if (state_q == Settle) assert (line_q == SendLatency || line_q == SendStatus
                                   || line_q == SendNothing);
    if (line_q == SendStatus && f_ending) assert (f_counted_q && f_statuses_q == '0);
    if (line_q == SendLatency || line_q == SendPerformance) assert (f_statuses_q == '0);
    if (line_q == SendId && state_q != Idle && state_q != Fetch && state_q != Judge)
      assert (f_statuses_q == '0 && !f_counted_q && !f_flushed_q);
    if (line_q == SendNothing && f_ending) assert (f_statuses_q == 4'd1 && f_counted_q);
    if (state_q == Fold || state_q == Send) assert (line_q != SendNothing);
    if (f_ending && f_finished_q && state_q != Flush) assert (!table_loading_q);
    if (state_q == Flush) assert (!table_loading_q);
    if (f_runs_q == '0) assert (!table_loading_q && f_sent_q == '0 && !f_flushed_q);
    if ((state_q == Fold || state_q == Send) && line_q == SendId)
      assert (running_q == (f_runs_q != '0 || start_q));
    assert (state_q <= Done && line_q <= SendNothing);
    if (state_q == Run) assert (line_q == SendId && f_statuses_q == '0 && !f_counted_q
                                && !f_flushed_q);
    if (!f_flushed_q) assert (!f_dry_q);
    if (f_finished_q) assert (f_runs_q != '0);
  end
  // what is sent is what was folded into its check word
  always_ff @(posedge clk_i) if (f_past_q && rst_ni && $past(rst_ni)) begin
    if ($past(state_q) == Fold && line_q != SendId)
      puc_line_holds: assert (own_line == $past(own_line));
    if ($past(state_q) == Fold) puc_folded_then_sent: assert (state_q == Send);
  end
