// Properties of the PUC's sequence: what is written when. Collector, lanes, SCPUs and dispatcher
// are arbitrary but for their own proven properties: a finished collector stays finished and quiet,
// and a dispatcher that was flushed and emptied writes nothing more.
  localparam logic [3:0] Idle = puc_pkg::Idle, Fetch = puc_pkg::Fetch, Judge = puc_pkg::Judge,
                         Fold = puc_pkg::Fold, Send = puc_pkg::Send, Run = puc_pkg::Run,
                         Flush = puc_pkg::Flush, Settle = puc_pkg::Settle, Done = puc_pkg::Done;
  localparam logic [2:0] SendId = puc_pkg::SendId, SendLatency = puc_pkg::SendLatency,
                         SendPerformance = puc_pkg::SendPerformance,
                         SendStatus = puc_pkg::SendStatus, SendNothing = puc_pkg::SendNothing;

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
    assume (results.lines == f_sent_q && f_sent_q != '1);
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
      if (own_write & write_ready_i & (which == SendStatus)) f_statuses_q <= f_statuses_q + 4'd1;
      if (own_write & write_ready_i & (which == SendPerformance)) f_counted_q <= 1'b1;
      if (start) f_runs_q <= f_runs_q + 4'd1;
      if (line_sent) f_sent_q <= f_sent_q + 32'd1;
      if (state == Flush) f_flushed_q <= 1'b1;
      f_dry_q      <= f_dry_q | (f_flushed_q & dispatcher_idle);
      f_finished_q <= f_finished_q | ((f_runs_q != '0) & collector_done);
    end
  end

  logic f_ending;   // the counters or the Status are next
  assign f_ending = (state != Idle) & (state != Fetch) & (state != Judge) & (state != Run)
                  & (which != SendId);
  always_comb if (f_past_q && rst_ni) begin
    if (own_write && which == SendStatus)
      puc_status_last: assert (f_pending_q == '0 && f_counted_q && !dispatcher_write);
    if (own_write && which == SendLatency && f_sent_q != '0)
      puc_counters_after_results: assert (f_pending_q == '0);
    if (own_write && which == SendLatency) puc_counters_after_run: assert (!dispatcher_write);
    if (state == Done)
      puc_done: assert (f_pending_q == '0 && f_statuses_q == 4'd1 && f_counted_q);
    puc_one_status: assert (f_statuses_q <= 4'd1);
    puc_one_start:  assert (f_runs_q + 4'(start) <= 4'd1);
    if (start) puc_starts_good: assert (error_o == harpoon_contract_pkg::ERROR_NONE);
    if (state == Done) puc_quiet_when_done: assert (!own_write && !dispatcher_write);
    // invariants
    if (state == Idle || state == Fetch || state == Judge) begin
      assert (f_runs_q == '0 && !start && f_statuses_q == '0 && !f_counted_q && !f_flushed_q);
      assert (!running && f_sent_q == '0);
    end
    if (start) assert (state == Fold && which == SendId && f_runs_q == '0);
    if (running) assert (f_runs_q == 4'd1 || start);
    if (state == Run) assert (running);
    if (state == Flush) assert (running && f_finished_q);
    if (f_ending && state != Flush && f_runs_q != '0) assert (f_flushed_q && f_finished_q);
    if (f_ending && f_runs_q == '0) assert (!running && f_sent_q == '0 && !start);
    if (f_ending && state != Flush && !(state == Settle && which == SendLatency)) begin
      assert (!running);
      if (f_runs_q != '0) assert (f_dry_q);
    end
    if (state == Fold && which == SendStatus) assert (f_pending_q == '0 && f_counted_q);
    if (state == Fold && which == SendLatency && f_sent_q != '0) assert (f_pending_q == '0);
    if (state == Settle) assert (which == SendLatency || which == SendStatus
                                   || which == SendNothing);
    if (which == SendStatus && f_ending) assert (f_counted_q && f_statuses_q == '0);
    if (which == SendLatency || which == SendPerformance) assert (f_statuses_q == '0);
    if (which == SendId && state != Idle && state != Fetch && state != Judge)
      assert (f_statuses_q == '0 && !f_counted_q && !f_flushed_q);
    if (which == SendNothing && f_ending) assert (f_statuses_q == 4'd1 && f_counted_q);
    if (state == Fold || state == Send) assert (which != SendNothing);
    if (f_runs_q == '0) assert (f_sent_q == '0 && !f_flushed_q);
    if ((state == Fold || state == Send) && which == SendId)
      assert (running == (f_runs_q != '0 || start));
    assert (state <= Done && which <= SendNothing);
    if (state == Run) assert (which == SendId && f_statuses_q == '0 && !f_counted_q
                                && !f_flushed_q);
    if (!f_flushed_q) assert (!f_dry_q);
    if (f_finished_q) assert (f_runs_q != '0);
  end
  // what is sent is what was folded into its check word
  always_ff @(posedge clk_i) if (f_past_q && rst_ni && $past(rst_ni)) begin
    if ($past(state) == Fold && which != SendId)
      puc_line_holds: assert (own_line == $past(own_line));
    if ($past(state) == Fold) puc_folded_then_sent: assert (state == Send);
  end
