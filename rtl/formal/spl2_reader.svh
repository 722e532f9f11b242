// Properties of spl2_reader. The memory is taken to answer every read with its own address (before
// translation), so that order and identity show in the data.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (!rst_ni);

  (* anyconst *) logic [ID:0] f_limit;
  (* anyconst *) logic [ID+2:0] f_index;   // the request that is followed
  logic [ID+2:0] f_asked_q, f_taken_q;     // requests accepted, lines handed on
  logic [57:0]   f_line_q;
  logic [ID:0]   f_count;
  always_comb begin
    assume (limit_i == f_limit && f_limit != '0 && f_limit <= (ID+1)'(MaxInFlight));
    if (clear_i) assume (stop_i && outstanding_o == '0);
    if (axi_rvalid_i) assume (axi_rdata_i[57:0] == asked_q[axi_rid_i]);
    f_count = '0;
    for (int unsigned i = 0; i < MaxInFlight; i++) f_count = f_count + (ID+1)'(awaiting_q[i]);
  end
  always_ff @(posedge clk_i) begin
    if (!rst_ni || clear_i) begin
      f_asked_q <= '0;
      f_taken_q <= '0;
    end else begin
      if (accept) f_asked_q <= f_asked_q + 1'b1;
      if (pop) f_taken_q <= f_taken_q + 1'b1;
    end
    if (accept && f_asked_q == f_index) f_line_q <= req_line_i;
  end
  // once stopped, it stays so until clear (SPL2 goes through drain)
  logic f_stopped_q;
  always_ff @(posedge clk_i) f_stopped_q <= rst_ni && stop_i && !clear_i;
  always_comb if (f_past_q && f_stopped_q) assume (stop_i);

  logic [ID+2:0] f_age;
  assign f_age = f_asked_q - f_index;
  always_comb if (f_past_q && rst_ni) begin
    reader_counts: assert (outstanding_q == f_count);
    reader_limit:  assert (outstanding_q <= f_limit && tail_q - head_q <= f_limit);
    if (go) reader_unique_id: assert (!awaiting_q[look_id_q] && !filled_q[look_id_q]);
    if (go) reader_translated: assert (lookup_ok_i);
    if (axi_rvalid_i && !awaiting_q[axi_rid_i]) begin
      reader_stray: assert (fault_o && fault_code_o == harpoon_contract_pkg::FAULT_UNEXPECTED);
    end
    // the line handed on is the one that was asked for, in order
    if (out_valid_q && f_taken_q != '0 && f_index == f_taken_q - 1'b1 && f_age != '0) begin
      reader_order: assert (out_q[57:0] == f_line_q);
    end
    // invariants
    assert (f_asked_q - f_taken_q == {2'b00, tail_q - head_q});
    assert (f_asked_q[ID:0] == tail_q && f_taken_q[ID:0] == head_q);
    if (f_age != '0 && f_age <= f_asked_q - f_taken_q) begin
      assert (asked_q[f_index[ID-1:0]] == f_line_q);
    end
    for (int unsigned i = 0; i < MaxInFlight; i++) begin
      if (filled_q[i]) assert (mem_q[i][57:0] == asked_q[i] && !awaiting_q[i]);
      if (awaiting_q[i] || filled_q[i]) begin
        assert ({1'b0, ID'(i) - head_q[ID-1:0]} < tail_q - head_q);
      end
    end
    if (look_valid_q) begin
      assert (!awaiting_q[look_id_q] && !filled_q[look_id_q]);
      assert (tail_q != head_q && look_id_q == ID'(tail_q[ID-1:0] - 1'b1));
    end
  end
  always_ff @(posedge clk_i) if (f_past_q && rst_ni) begin
    if ($past(rst_ni) && $past(axi_arvalid_o & ~axi_arready_i)) begin
      reader_ar_stable: assert (axi_arvalid_o && $stable(axi_arid_o) && $stable(axi_arline_o));
    end
    if ($past(rst_ni) && $past(stop_i) && !$past(axi_arvalid_o)) begin
      reader_stops: assert (!axi_arvalid_o);
    end
    if ($past(rst_ni) && !$past(clear_i) && $past(rsp_valid_o & ~rsp_ready_i)) begin
      reader_rsp_stable: assert (rsp_valid_o && rsp_data_o == $past(rsp_data_o));
    end
  end
