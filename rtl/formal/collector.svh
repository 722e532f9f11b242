// Properties of collector: every line is requested once, in order, and handed on once, in order.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (!rst_ni);

  // A transaction starts once, from rest. Its inputs are arbitrary but fixed; their sum
  // fits the counters.
  logic f_started_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) f_started_q <= 1'b0;
    else if (start_i) f_started_q <= 1'b1;
  end
  always_comb begin
    assume (!(start_i && f_started_q));
    assume (!table_lines_i[CountWidth-1] && !source_lines_i[CountWidth-1]);
    assume (batch_lines_i != '0 && !batch_lines_i[CountWidth-1]);
  end
  (* anyconst *) logic [57:0] f_table_line, f_source_line;
  (* anyconst *) logic [CountWidth-1:0] f_table_lines, f_source_lines, f_batch_lines;
  (* anyconst *) logic        f_barrier;
  always_comb begin
    assume (table_line_i == f_table_line && source_line_i == f_source_line);
    assume (table_lines_i == f_table_lines && source_lines_i == f_source_lines);
    assume (batch_lines_i == f_batch_lines && barrier_i == f_barrier);
  end

  logic [CountWidth-1:0] f_asked_q, f_got_q, f_table_q, f_source_q, f_batch_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni || start_i) begin
      f_asked_q  <= '0;
      f_got_q    <= '0;
      f_table_q  <= '0;
      f_source_q <= '0;
    end else begin
      if (asked) f_asked_q <= f_asked_q + 1'b1;
      if (data_valid_i & data_ready_o) f_got_q <= f_got_q + 1'b1;
      if (table_valid_o) f_table_q <= f_table_q + 1'b1;
      if (source_valid_o & source_ready_i) f_source_q <= f_source_q + 1'b1;
    end
  end
  // SPL2 answers what was asked, and nothing else.
  always_comb if (data_valid_i) assume (f_got_q != f_asked_q);

  logic [CountWidth-1:0] f_total;
  assign f_total = table_lines_i + source_lines_i;
  always_comb if (f_past_q && rst_ni && f_started_q) begin
    collector_count: assert (f_asked_q + table_ask_q + source_ask_q == f_total);
    assert (f_got_q + table_get_q + source_get_q == f_total);
    assert (f_got_q <= f_asked_q);
    assert (table_ask_q <= table_lines_i && source_ask_q <= source_lines_i);
    assert (table_ask_q == '0 || source_ask_q == source_lines_i);
    assert (table_get_q <= table_lines_i && source_get_q <= source_lines_i);
    assert (table_get_q == '0 || source_get_q == source_lines_i);
    collector_never_beyond: assert (f_asked_q <= f_total);
    if (table_ask_q != '0) begin
      collector_table_order: assert (read_line_o == table_line_i + 58'(f_asked_q));
    end else if (source_ask_q != '0) begin
      collector_source_order:
        assert (read_line_o == source_line_i + 58'(f_asked_q - table_lines_i));
    end
    collector_routes: assert (f_table_q + f_source_q == f_got_q);
    if (source_valid_o) collector_table_first: assert (f_table_q == table_lines_i);
    assert (f_table_q + table_get_q == table_lines_i);
    collector_done: assert (done_o == (f_got_q == f_total));
    assert (batch_left_q <= batch_lines_i || !barrier_i);
    if (barrier_i) begin
      collector_barrier: assert (source_get_q - source_ask_q <= batch_lines_i);
      assert (batch_left_q + (source_get_q - source_ask_q) <= batch_lines_i);
    end
  end
  always_comb if (f_past_q && rst_ni && !f_started_q) begin
    assert (table_ask_q == '0 && source_ask_q == '0 && table_get_q == '0 && source_get_q == '0);
    collector_quiet: assert (!read_valid_o && !source_valid_o && !table_valid_o);
  end
