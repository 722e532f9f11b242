// Properties of spl2_page_table. One arbitrary entry is followed: a lookup of its page is good only
// if it lies within the count and was stored valid, and then it gives what was stored.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;

  (* anyconst *) logic [IDX-1:0] f_index;
  logic [43:0] f_entry_q, f_read_entry_q, f_write_entry_q;
  logic        f_known_q = 1'b0, f_read_q = 1'b0, f_write_q = 1'b0;
  logic        f_read_inside_q, f_write_inside_q, f_looked_q = 1'b0;
  logic [57:0] f_read_line_q, f_write_line_q;
  always_ff @(posedge clk_i) begin
    if (store_i && store_index_i == f_index) begin
      f_known_q <= 1'b1;
      f_entry_q <= {store_valid_i, store_page_i};
    end
    if (read_enable_i) begin
      f_looked_q      <= 1'b1;
      f_read_q        <= f_known_q && read_line_i[57:15] - base_page_i == 43'(f_index);
      f_read_entry_q  <= f_entry_q;
      f_read_inside_q <= read_line_i[57:15] - base_page_i < 43'(page_count_i);
      f_read_line_q   <= read_line_i;
    end
    if (write_enable_i) begin
      f_write_q        <= f_known_q && write_line_i[57:15] - base_page_i == 43'(f_index);
      f_write_entry_q  <= f_entry_q;
      f_write_inside_q <= write_line_i[57:15] - base_page_i < 43'(page_count_i);
      f_write_line_q   <= write_line_i;
    end
  end
  always_comb if (f_past_q) begin
    if (f_known_q) assert (mem_q[f_index] == f_entry_q);
    if (f_read_q) assert (read_entry_q == f_read_entry_q && read_inside_q == f_read_inside_q
                          && read_line_q == f_read_line_q);
    if (f_write_q) assert (write_entry_q == f_write_entry_q && write_inside_q == f_write_inside_q
                           && write_line_q == f_write_line_q);
    if (f_read_q && !read_physical_q && read_ok_o) begin
      table_read_inside: assert (f_read_inside_q);
      table_read_page:   assert ({1'b1, read_line_o[57:15]} == f_read_entry_q);
      table_read_line:   assert (read_line_o[14:0] == f_read_line_q[14:0]);
    end
    if (f_write_q && !write_physical_q && write_ok_o) begin
      table_write_inside: assert (f_write_inside_q);
      table_write_page:   assert ({1'b1, write_line_o[57:15]} == f_write_entry_q);
    end
  end
