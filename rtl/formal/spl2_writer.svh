// Properties of spl2_writer. A B response may come for any ID whose AW and W were accepted.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (!rst_ni);

  (* anyconst *) logic [ID:0] f_limit;
  logic [ID:0] f_count;
  logic [7:0]  f_addresses_q, f_lines_q, f_accepted_q, f_answered_q, f_dropped_q;
  always_comb begin
    assume (limit_i == f_limit && f_limit != '0 && f_limit <= (ID+1)'(MaxInFlight));
    if (axi_bvalid_i) assume (!(axi_awvalid_o && axi_awid_o == axi_bid_i));
    if (axi_bvalid_i) assume (!axi_wvalid_o || axi_bid_i != axi_awid_o);
    f_count = '0;
    for (int unsigned i = 0; i < MaxInFlight; i++) f_count = f_count + (ID+1)'(awaiting_q[i]);
  end
  logic f_drop;
  assign f_drop = look_valid_q & ~allowed;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      f_addresses_q <= '0;
      f_lines_q     <= '0;
      f_accepted_q  <= '0;
      f_answered_q  <= '0;
      f_dropped_q   <= '0;
    end else begin
      if (axi_awvalid_o & axi_awready_i) f_addresses_q <= f_addresses_q + 1'b1;
      if (axi_wvalid_o & axi_wready_i) f_lines_q <= f_lines_q + 1'b1;
      if (accept) f_accepted_q <= f_accepted_q + 1'b1;
      if (expected) f_answered_q <= f_answered_q + 1'b1;
      if (f_drop) f_dropped_q <= f_dropped_q + 1'b1;
    end
  end
  always_comb if (f_past_q && rst_ni) begin
    writer_counts: assert (outstanding_q == f_count);
    writer_limit:  assert (outstanding_q <= f_limit);
    if (go) writer_unique_id: assert (!awaiting_q[next_q]);
    // one W for every AW, whichever is accepted first
    writer_pairs: assert (f_addresses_q + 8'(aw_valid_q) == f_lines_q + 8'(w_valid_q));
    // nothing accepted is lost: answered, on its way, waiting, or dropped by a stop
    writer_conserves: assert (f_accepted_q == f_answered_q + f_dropped_q + 8'(outstanding_q)
                                              + 8'(look_valid_q));
    writer_idle: assert (!idle_o || (f_accepted_q == f_answered_q + f_dropped_q
                                     && !axi_awvalid_o && !axi_wvalid_o));
    if (go) writer_translated: assert (lookup_ok_i);
    if (axi_bvalid_i && !awaiting_q[axi_bid_i]) begin
      writer_stray: assert (fault_o && fault_code_o == harpoon_contract_pkg::FAULT_UNEXPECTED);
    end
    // invariants: what is on the bus is awaited
    assert (f_addresses_q + 8'(aw_valid_q) == f_answered_q + 8'(outstanding_q));
    if (aw_valid_q || w_valid_q) assert (awaiting_q[aw_id_q]);
  end
  always_ff @(posedge clk_i) if (f_past_q && rst_ni) begin
    if ($past(rst_ni) && $past(axi_awvalid_o & ~axi_awready_i)) begin
      writer_aw_stable: assert (axi_awvalid_o && $stable(axi_awid_o) && $stable(axi_awline_o));
    end
    if ($past(rst_ni) && $past(axi_wvalid_o & ~axi_wready_i)) begin
      writer_w_stable: assert (axi_wvalid_o && $stable(axi_wdata_o));
    end
    if ($past(rst_ni) && $past(stop_i & ~look_own_q) && !$past(axi_awvalid_o)) begin
      writer_stops: assert (!axi_awvalid_o);
    end
  end
