// Properties of fifo. An arbitrary item, the f_index-th, is followed from its entry to its exit.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (!rst_ni);

  (* anyconst *) logic [PTR+2:0] f_index;
  logic [PTR+2:0]   f_in_q, f_moved_q, f_out_q;   // items that entered, left the RAM, left
  logic [PTR+2:0]   f_in_before_q;                // a cycle ago
  logic [Width-1:0] f_item_q;
  always_ff @(posedge clk_i) begin
    f_in_before_q <= rst_ni ? f_in_q : '0;
    if (!rst_ni) begin
      f_in_q    <= '0;
      f_moved_q <= '0;
      f_out_q   <= '0;
    end else begin
      if (push) f_in_q <= f_in_q + 1'b1;
      if (pop) f_moved_q <= f_moved_q + 1'b1;
      if (valid_o & ready_i) f_out_q <= f_out_q + 1'b1;
    end
    if (push & (f_in_q == f_index)) f_item_q <= data_i;
  end

  logic [PTR+2:0] f_age;   // how many items entered after the one that is followed, itself included
  assign f_age = f_in_q - f_index;
  always_comb if (f_past_q) begin
    fifo_level:     assert (write_q - read_q <= (PTR+1)'(Depth));
    fifo_conserves: assert (f_in_q - f_out_q == {2'b00, write_q - read_q} + (PTR+3)'(out_valid_q));
    fifo_empty:     assert (empty_o == (f_in_q == f_out_q));
    if (f_in_before_q != f_out_q) fifo_prompt: assert (valid_o);
    assert (f_in_before_q == f_in_q || f_in_before_q + 1'b1 == f_in_q);
    assert (f_in_q - f_moved_q == {2'b00, write_q - read_q});
    assert (f_in_q[PTR:0] == write_q);
    assert (f_moved_q[PTR:0] == read_q);
    // in the RAM, then in the output register
    if (f_age != '0 && f_age <= f_in_q - f_moved_q) begin
      assert (mem_q[f_index[PTR-1:0]] == f_item_q);
    end
    if (out_valid_q && f_index == f_moved_q - 1'b1) begin
      fifo_order: assert (out_q == f_item_q);
    end
  end
  always_ff @(posedge clk_i) if (f_past_q) begin
    if ($past(rst_ni) && rst_ni && $past(valid_o & ~ready_i)) begin
      fifo_stable: assert (valid_o && data_o == $past(data_o));
    end
    if (!$past(rst_ni)) fifo_reset: assert (empty_o);
  end
