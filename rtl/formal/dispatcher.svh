// Properties of dispatcher. The f_index-th record that is kept is followed: it must leave in line
// f_index / 2, in half f_index % 2.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (!rst_ni);
  always_comb begin
    assume (!(flush_i && (!idle_o || start_i)));
    assume (result_i.mask == 2'b01 || result_i.mask == 2'b11);
  end
  // Nothing comes after the flush, until the next start. Mode and place are arbitrary but fixed.
  logic f_flushed_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni || start_i) f_flushed_q <= 1'b0;
    else if (flush_i) f_flushed_q <= 1'b1;
  end
  always_comb if (f_flushed_q) assume (!valid_i && !flush_i);
  (* anyconst *) logic        f_hits_only;
  (* anyconst *) logic [57:0] f_dest_line;
  (* anyconst *) logic [31:0] f_dest_lines;
  always_comb begin
    assume (hits_only_i == f_hits_only && dest_line_i == f_dest_line);
    assume (dest_lines_i == f_dest_lines);
  end

  (* anyconst *) logic [7:0] f_index;
  logic [7:0]   f_kept_q, f_left_q;      // records kept, records in lines that left
  logic [255:0] f_record_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni || start_i) begin
      f_kept_q <= '0;
      f_left_q <= '0;
    end else begin
      if (take) f_kept_q <= f_kept_q + 8'(keep[0]) + 8'(keep[1]);
      if (out_valid_q & write_ready_i) f_left_q <= f_left_q + 8'd2;
    end
    if (take && keep != 2'b00 && f_kept_q == f_index) f_record_q <= first;
    if (take && (&keep) && f_kept_q + 8'd1 == f_index) f_record_q <= record[1];
  end

  always_comb if (f_past_q && rst_ni) begin
    // while lines are written: what is kept is held, in the output register, or has left
    if (emitted_q != dest_lines_i && !f_flushed_q) begin
      dispatcher_conserves:
        assert (f_kept_q == f_left_q + (out_valid_q ? 8'd2 : 8'd0) + 8'(held_q));
    end
    assert (emitted_q == lines_q + 32'(out_valid_q));
    assert (f_left_q == {lines_q[6:0], 1'b0});
    dispatcher_room: assert (emitted_q <= dest_lines_i || dest_lines_i == '0);
    if (emitted_q != dest_lines_i && !f_flushed_q && held_q && f_index == f_kept_q - 8'd1) begin
      assert (held_data_q == f_record_q);
    end
    if (emitted_q != dest_lines_i && !f_flushed_q && out_valid_q && f_kept_q != '0) begin
      if (f_index == f_left_q) dispatcher_order_low: assert (out_q[255:0] == f_record_q);
      if (f_index == f_left_q + 8'd1) dispatcher_order_high: assert (out_q[511:256] == f_record_q);
    end
    if (out_valid_q) dispatcher_place: assert (write_line_o == dest_line_i + {26'd0, lines_q});
    if (hits_only_i) dispatcher_hits: assert (f_kept_q == hits_q[7:0]);
    else             dispatcher_all:  assert (f_kept_q == pairs_q[7:0]);
  end
  always_ff @(posedge clk_i) if (f_past_q && rst_ni) begin
    if ($past(rst_ni) && !$past(start_i) && $past(write_valid_o & ~write_ready_i)) begin
      dispatcher_stable: assert (write_valid_o && write_data_o == $past(write_data_o)
                                 && write_line_o == $past(write_line_o));
    end
    if ($past(rst_ni) && $past(flush_i)) dispatcher_flushed: assert (!held_q);
  end
