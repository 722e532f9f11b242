// Properties of front_indexed: its stream keeps the contract of puc_pkg, and the table counts
// as loaded once it is. The lanes do what is proven of them: their beats hold pairs, and lanes that
// are idle have none and make none until a line comes.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (!rst_ni && !cold_rst_ni);

  // The job: it is open from its start until its last beat is taken, its lines come first.
  logic f_open_q, f_idle_q, f_done_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) f_open_q <= 1'b0;
    else if (start_i) f_open_q <= 1'b1;
    else if (valid_o & ready_i & beat_o.last) f_open_q <= 1'b0;
    f_idle_q <= rst_ni & idle_o & lines_done_i & ~start_i;
    f_done_q <= rst_ni & lines_done_i & ~start_i;
  end
  always_comb begin
    assume (open_i == f_open_q);
    if (!cold_rst_ni) assume (!rst_ni);
    if (start_i) assume (!f_open_q && lines_done_i);
    if (lines_done_i) assume (!valid_i && !table_valid_i);
    if (f_past_q && f_done_q) assume (lines_done_i);
    if (lanes_valid) assume (!lanes_idle && (mask == 2'b01 || mask == 2'b11));
    if (f_past_q && f_idle_q) assume (idle_o);
  end

  always_comb if (f_past_q && rst_ni) begin
    if (valid_o) indexed_empty_is_last: assert (beat_o.mask != 2'b00 || beat_o.last);
    if (valid_o && beat_o.last) indexed_last_is_last: assert (lines_done_i && idle_o && open_i);
    if (lines_done_i && idle_o && open_i) indexed_ends: assert (valid_o && beat_o.last);
    if (loading_q) indexed_waits: assert (!ready_o);
  end
  always_ff @(posedge clk_i) if (f_past_q && $past(f_past_q)) begin
    if ($past(start_i && load_i && rst_ni && cold_rst_ni && !forget_i))
      indexed_loads: assert (loaded_o == '0 && loading_q);
    if ($past(!cold_rst_ni)) indexed_forgets: assert (loaded_o == '0);
    if ($past(!rst_ni && cold_rst_ni && !forget_i)) indexed_keeps: assert ($stable(loaded_o));
    if ($past(rst_ni && valid_o && beat_o.last && ready_i && !start_i) && rst_ni)
      indexed_silent: assert (!valid_o);
  end
