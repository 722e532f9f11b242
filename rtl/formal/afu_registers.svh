// Properties of afu_registers: one answer for every access, a command for every write that asks for
// one and for no other, and settings that stay legal and hold.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (!rst_ni);

  logic [3:0]  f_writes_q, f_answers_q, f_reads_q, f_data_q;
  logic [31:0] f_high_q;
  logic        f_high_half;
  assign f_high_half = (awaddr_i == harpoon_contract_pkg::REG_SPL_DSM_BASE + 16'd4)
                     | (awaddr_i == harpoon_contract_pkg::REG_AFU_DSM_BASE + 16'd4)
                     | (awaddr_i == harpoon_contract_pkg::REG_SPL2_CNTXT_BASE + 16'd4)
                     | (awaddr_i == harpoon_contract_pkg::REG_AFU_CNTXT_BASE + 16'd4);
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      f_writes_q  <= '0;
      f_answers_q <= '0;
      f_reads_q   <= '0;
      f_data_q    <= '0;
      f_high_q    <= '0;
    end else begin
      if (awvalid_i & awready_o) f_writes_q <= f_writes_q + 4'd1;
      if (bvalid_o & bready_i) f_answers_q <= f_answers_q + 4'd1;
      if (arvalid_i & arready_o) f_reads_q <= f_reads_q + 4'd1;
      if (rvalid_o & rready_i) f_data_q <= f_data_q + 4'd1;
      if (write & f_high_half) f_high_q <= wdata_i;
    end
  end

  always_comb if (f_past_q && rst_ni) begin
    registers_both: assert (awready_o == wready_o && (!awready_o || (awvalid_i && wvalid_i)));
    registers_one_b: assert (f_writes_q == f_answers_q + 4'(bvalid_o));
    registers_one_r: assert (f_reads_q == f_data_q + 4'(rvalid_o));
    registers_limit: assert (limit_o != '0 && limit_o <= (ID+1)'(MaxInFlight));
    assert (high_q == f_high_q);
  end
  always_ff @(posedge clk_i) if (f_past_q && rst_ni && $past(rst_ni)) begin
    if ($past(bvalid_o & ~bready_i)) registers_b_stable: assert (bvalid_o);
    if ($past(rvalid_o & ~rready_i))
      registers_r_stable: assert (rvalid_o && rdata_o == $past(rdata_o));
    registers_enable: assert (enable_o == $past(write
      && ((awaddr_i == harpoon_contract_pkg::REG_AP_CTRL && wdata_i[0])
          || (awaddr_i == harpoon_contract_pkg::REG_SPL2_CH_CTRL && wdata_i[1]))));
    registers_reset: assert (reset_o == $past(write && wdata_i[0]
      && awaddr_i == harpoon_contract_pkg::REG_SPL2_CH_CTRL));
    registers_commit:
      assert (spl_dsm_commit_o == $past(write && awaddr_i == harpoon_contract_pkg::REG_SPL_DSM_BASE)
              && afu_dsm_commit_o
                 == $past(write && awaddr_i == harpoon_contract_pkg::REG_AFU_DSM_BASE));
    if ($past(write && awaddr_i == harpoon_contract_pkg::REG_SPL2_CNTXT_BASE))
      registers_high_half_first:
        assert (spl2_context_line_o == {$past(f_high_q), $past(wdata_i[31:6])});
    if (!$past(write))
      registers_hold: assert ($stable(limit_o) && $stable(barrier_o) && $stable(spl_dsm_page_o)
                              && $stable(spl2_context_line_o) && $stable(afu_dsm_line_o)
                              && $stable(afu_context_line_o));
    if ($past(ap_done_q) && !ap_done_q)
      registers_done_until_read:
        assert ($past(read && araddr_i == harpoon_contract_pkg::REG_AP_CTRL));
    if ($past(done_i) && $past(f_past_q) && $past(rst_ni, 2) && !$past(done_i, 2))
      registers_done_seen: assert (ap_done_q);
    if ($past(read && araddr_i == harpoon_contract_pkg::REG_STATE))
      registers_reads: assert (rdata_o == $past(state_i));
  end
