// Properties of spl2: which addresses it ever names, that a fault is terminal, that reset drains.
// That a virtual address is translated by a stored entry is proven of spl2_page_table, that nothing
// reaches the bus untranslated or after a stop of spl2_reader and spl2_writer; here the ports, the
// loader and the life are taken together with arbitrary readers and writers.
  logic f_past_q = 1'b0;
  always_ff @(posedge clk_i) f_past_q <= 1'b1;
  always_comb if (!f_past_q) assume (!rst_ni);

  always_comb if (f_past_q && rst_ni) begin
    // once on, the table is complete and is not touched
    if (state_q == On) spl2_table_complete: assert (stored_q == page_count_q && !entry_good);
    if (state_q == On) spl2_pages_bounded: assert (page_count_q <= (IDX+1)'(MaxPages));
    if (state_q == Entries) assert (stored_q < page_count_q || entry_good == 1'b0);
    if (state_q == Entries) assert (page_count_q <= (IDX+1)'(MaxPages) && stored_q < page_count_q
                                    && context_good_q);
    if (state_q == ContextCheck) begin
      assert (stored_q == '0 && (!context_good_q || (page_count_q != '0
              && page_count_q <= (IDX+1)'(MaxPages))));
    end
    // before that, reads are those of the context and of the table
    if (reader_req_valid && state_q == ContextRequest)
      spl2_reads_context: assert (reader_req_line == context_line_i);
    if (reader_req_valid && state_q == Entries)
      spl2_reads_table: assert (reader_req_line - table_line_q < 58'(page_count_q));
    if (reader_req_valid)
      spl2_reads_when: assert (state_q == On || state_q == ContextRequest || state_q == Entries);
    // untranslated writes stay in the two DSM pages, translated ones wait for the table
    if (writer_req_valid && writer_req_own)
      spl2_own_writes: assert (writer_req_line[57:6] == spl_dsm_page_i);
    if (writer_req_valid && !writer_req_own && write_dsm_i)
      spl2_dsm_writes: assert (writer_req_line[57:6] == afu_dsm_line_i[57:6]);
    if (writer_req_valid && !writer_req_own && !write_dsm_i)
      spl2_writes_when: assert (state_q == On);
    // a fault stops everything
    if (state_q == Fault) spl2_fault_stops: assert (stop && !read_ready_o && !write_ready_o
                                                    && !data_valid_o && fault_valid_o);
    if (state_q == Drain) spl2_drain_stops: assert (stop && !read_ready_o && !write_ready_o
                                                    && !data_valid_o);
  end
  always_ff @(posedge clk_i) if (f_past_q && rst_ni && $past(rst_ni)) begin
    if ($past(state_q == Fault) && !$past(reset_req_i))
      spl2_fault_terminal: assert (state_q == Fault && $stable(fault_code_o)
                                   && $stable(fault_line_o));
    if ($past(fault && !stop && !reset_req_i) && !$past(enable_pending_q && puc_done_i))
      spl2_fault_taken: assert (state_q == Fault);
    if ($past(reset_req_i)) spl2_reset_drains: assert (state_q == Drain);
    if (state_q == Off && $past(state_q) == Drain)
      spl2_drained: assert ($past(reads_outstanding_o == '0 && writer_idle));
    if (state_q == On && $past(state_q) != On)
      spl2_on_last_entry: assert ($past(entry_good));
  end
