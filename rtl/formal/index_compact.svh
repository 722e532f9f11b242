// Properties of index_compact: of a slice that is held until it is done, every pair that is there
// and not ruled out leaves once, in order.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (!rst_ni);

  // The slice is held.
  logic             f_held_q;
  logic [Lanes-1:0] f_miss_q, f_present_q, f_kept;
  always_ff @(posedge clk_i) begin
    f_held_q    <= rst_ni & valid_i & ~done_o;
    f_miss_q    <= miss_i;
    f_present_q <= present_i;
  end
  always_comb if (f_past_q && f_held_q)
    assume (valid_i && miss_i == f_miss_q && present_i == f_present_q);

  assign f_kept = present_i & ~miss_i;   // survivors, sent or not
  always_comb if (f_past_q && rst_ni) begin
    if (valid_o) begin
      compact_survivors_only: assert (((first_hot | second_hot) & ~f_kept) == '0
                                      && ((first_hot | second_hot) & sent_q) == '0);
      compact_two_a_beat: assert (first_hot != '0 && (first_hot & (first_hot - 1'b1)) == '0
                                  && (second_hot & (second_hot - 1'b1)) == '0
                                  && mask_o == {second_hot != '0, 1'b1});
      compact_in_order: assert (first_hot > sent_q && (second_hot == '0
                                                       || second_hot > first_hot));
    end
    if (done_o) compact_none_lost: assert ((sent_q | (valid_o ? first_hot | second_hot : '0))
                                           == f_kept);
    if (valid_i && f_kept == '0) compact_at_once: assert (done_o && !valid_o);
    // invariants
    assert (!valid_i || (sent_q & ~f_kept) == '0);
    assert (valid_i || sent_q == '0);
    assert (sent_q == '0 || survivors == '0 || (survivors & (~survivors + 1'b1)) > sent_q);
  end
