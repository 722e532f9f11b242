// The Processing Units Controller: control-memory handshake, collector, SCPUs, dispatcher, and the
// orderly end of a transaction.
//
// Life: wait until SPL2 is on; fetch VAFU2_CNTXT and the control line; poll the control line until
// its start byte is 0xFF; write the AFU ID into the DSM; run n_col pairs; then, each step only
// after all writes before it were acknowledged: counters into the DSM, Status into VAFU2_CNTXT.
// What the control line or the context got wrong ends the same way, with an error code and no
// results.
// After the end (`done_o`) nothing happens until reset. Reset forgets everything but the sphere
// table and how much of it was loaded.
//
//   Src -> collector -+-> (2 pairs) ------------------+-> scpu_array -> dispatcher -> Dst
//                     +-> index_lanes (16 index pairs)-+
module puc #(
  parameter int unsigned NumScpu = 10,
  parameter int unsigned Lanes   = 10,
  parameter int unsigned Spheres = 16384,
  parameter int unsigned Depth   = 256
) (
  input  logic         clk_i,
  input  logic         rst_ni,        // ends a transaction
  input  logic         cold_rst_ni,   // also forgets the sphere table

  input  logic         spl2_on_i,
  input  logic         active_i,      // SPL2 was enabled
  input  logic         dsm_commit_i,  // AFU_DSM_BASE was written
  input  logic [57:0]  context_line_i,
  input  logic         barrier_i,
  input  harpoon_contract_pkg::config_t config_i,
  output logic         done_o,
  output logic         idle_o,
  output harpoon_contract_pkg::error_e  error_o,
  output logic [3:0]   state_o,

  output logic         read_valid_o,
  input  logic         read_ready_i,
  output logic [57:0]  read_line_o,
  input  logic         data_valid_i,
  output logic         data_ready_o,
  input  logic [511:0] data_i,
  output logic         write_valid_o,
  input  logic         write_ready_i,
  output logic         write_dsm_o,
  output logic [57:0]  write_line_o,
  output logic [511:0] write_data_o,
  input  logic         write_idle_i
);
  if (NumScpu != 1 && (NumScpu == 0 || NumScpu > 254 || NumScpu % 2 != 0))
    $error("puc: NumScpu must be 1 or even, up to 254");
  if (Lanes < 1 || Lanes > 16)
    $error("puc: Lanes must be 1 to 16");
  if (Spheres < 8 || Spheres > 65536 || 1 << $clog2(Spheres) != Spheres)
    $error("puc: Spheres must be a power of two, 8 to 65536");
  if (1 << $clog2(Depth) != Depth || Depth <= scpu_pkg::Latency + 5)
    $error("puc: Depth must be a power of two above the latency");

  localparam int unsigned PER_LINE = harpoon_contract_pkg::INDEX_PAIRS_PER_LINE;

  typedef enum logic [3:0] {
    Idle, Fetch, Judge, Fold, Send, Run, Flush, Settle, Done
  } state_e;
  typedef enum logic [2:0] {SendId, SendLatency, SendPerformance, SendStatus, SendNothing} line_e;
  state_e state_q;
  line_e  line_q;

  // ---- what the context and the control line said ----
  logic [57:0] source_q, dest_q, spheres_q;
  logic [31:0] source_lines_q, dest_lines_q, sphere_count_q, pair_count_q, sequence_q;
  harpoon_contract_pkg::format_e format_q;
  logic        load_table_q, go_q, forget_q, context_good_q, context_judge_q;
  logic [63:0] check_q, fold;
  logic [1:0]  ask_q;        // bit 0: context, bit 1: control line, still to request
  logic        got_context_q, check_good, take_control_data;

  // ---- consequences ----
  logic        indexed, hits_only;
  logic [31:0] lines_needed, table_lines;
  harpoon_contract_pkg::error_e verdict, error_q;
  assign indexed      = format_q == harpoon_contract_pkg::FORMAT_INDEXED_HITS;
  assign hits_only    = format_q != harpoon_contract_pkg::FORMAT_DIRECT;
  assign lines_needed = indexed ? {4'd0, pair_count_q[31:4]} + 32'(pair_count_q[3:0] != '0)
                                : {1'b0, pair_count_q[31:1]} + 32'(pair_count_q[0]);
  assign table_lines  = (indexed & load_table_q)
                      ? {2'd0, sphere_count_q[31:2]} + 32'(sphere_count_q[1:0] != '0) : '0;
  assign check_good   = check_q == (harpoon_contract_pkg::CHECK_SEED ^ fold);
  always_comb begin
    if (!context_good_q) verdict = harpoon_contract_pkg::ERROR_BAD_CONTEXT;
    else if (!check_good) verdict = harpoon_contract_pkg::ERROR_BAD_CONTROL;
    else if (format_q >= harpoon_contract_pkg::FORMAT_COUNT)
      verdict = harpoon_contract_pkg::ERROR_BAD_FORMAT;
    else if (lines_needed > source_lines_q) verdict = harpoon_contract_pkg::ERROR_SOURCE_TOO_SHORT;
    else if (indexed & load_table_q & (sphere_count_q > Spheres))
      verdict = harpoon_contract_pkg::ERROR_TOO_MANY_SPHERES;
    else verdict = harpoon_contract_pkg::ERROR_NONE;
  end

  // ---- collector ----
  logic         start_q, collector_read, collector_data_ready, collector_done, drained, table_valid;
  logic         source_valid, source_ready;
  logic [57:0]  collector_line;
  logic [511:0] table_data, source_data;
  harpoon_contract_pkg::checked_line_t own_line, sent_line, control_line, data_view;
  harpoon_contract_pkg::vafu2_cntxt_t  context_view;
  harpoon_contract_pkg::control_t      control_view;
  collector u_collector (
    .clk_i, .rst_ni,
    .start_i        (start_q),
    .table_line_i   (spheres_q),
    .table_lines_i  (table_lines),
    .source_line_i  (source_q),
    .source_lines_i (lines_needed),
    .barrier_i      (barrier_i),
    .batch_lines_i  (indexed ? 32'd1 : 32'((NumScpu + 1) / 2)),
    .drained_i      (drained),
    .read_valid_o   (collector_read),
    .read_ready_i   (read_ready_i & (state_q != Fetch)),
    .read_line_o    (collector_line),
    .data_valid_i   (data_valid_i & (state_q != Fetch)),
    .data_ready_o   (collector_data_ready),
    .data_i         (data_i),
    .table_valid_o  (table_valid),
    .table_data_o   (table_data),
    .source_valid_o (source_valid),
    .source_ready_i (source_ready),
    .source_data_o  (source_data),
    .done_o         (collector_done)
  );

  logic more;   // pairs are on their way, and worth waiting for
  assign more = ~collector_done & ~barrier_i;

  // ---- numbering: pairs left, number of the next ----
  logic [31:0] left_q, number_q;
  always_ff @(posedge clk_i) begin
    if (start_q) begin
      left_q   <= pair_count_q;
      number_q <= '0;
    end else if (source_valid & source_ready) begin
      left_q   <= left_q - (indexed ? 32'(PER_LINE) : 32'd2);
      number_q <= number_q + (indexed ? 32'(PER_LINE) : 32'd2);
    end
  end

  // ---- index lanes ----
  logic         lanes_valid, lanes_ready, lane_beat_valid, lanes_idle, index_error;
  logic [1:0]   lane_mask;
  logic [511:0] lane_pairs;
  logic [61:0]  lane_numbers;
  logic [31:0]  loaded_q;
  logic         table_loading_q;
  assign lanes_valid = source_valid & indexed & ~table_loading_q;

  // Their clock is gated in the other formats, but for the start, which clears an index error, and
  // a reset, which the cull lanes see a cycle late. The slice keeps those formats' lines away.
  logic         lanes_clk, rst_nq, line_valid, line_ready, line_last;
  logic [511:0] line;
  logic [30:0]  line_number;
  logic [4:0]   line_count;
  always_ff @(posedge clk_i) rst_nq <= rst_ni;
  clock_gate u_lanes_gate (
    .clk_i,
    .enable_i (indexed | start_q | ~rst_ni | ~rst_nq),
    .clk_o    (lanes_clk)
  );
  register_slice #(.Width(512 + 31 + 5 + 1)) u_slice (
    .clk_i   (lanes_clk),
    .rst_ni,
    .valid_i (lanes_valid),
    .ready_o (lanes_ready),
    .data_i  ({barrier_i | (left_q <= 32'(PER_LINE)),
               (left_q >= 32'(PER_LINE)) ? 5'(PER_LINE) : left_q[4:0],
               number_q[30:0], source_data}),
    .valid_o (line_valid),
    .ready_i (line_ready),
    .data_o  ({line_last, line_count, line_number, line})
  );
  index_lanes #(.Lanes(Lanes), .Spheres(Spheres)) u_lanes (
    .clk_i          (lanes_clk),
    .clk_free_i     (clk_i),
    .rst_ni,
    .start_i        (start_q),
    .sphere_count_i (loaded_q),
    .table_clear_i  (start_q),
    .table_valid_i  (table_valid),
    .table_data_i   (table_data),
    .valid_i        (line_valid),
    .ready_o        (line_ready),
    .line_i         (line),
    .number_i       (line_number),
    .count_i        (line_count),
    .last_i         (line_last),
    .more_i         (more),
    .valid_o        (lane_beat_valid),
    .ready_i        (array_ready & indexed),
    .mask_o         (lane_mask),
    .pairs_o        (lane_pairs),
    .numbers_o      (lane_numbers),
    .index_error_o  (index_error),
    .idle_o         (lanes_idle)
  );
  // what was loaded counts once it is all there
  always_ff @(posedge clk_i) begin
    if (!cold_rst_ni || ((state_q == Judge) & forget_q & ~go_q)) begin
      loaded_q        <= '0;
      table_loading_q <= 1'b0;
    end else if (!rst_ni) begin
      table_loading_q <= 1'b0;
    end else if (start_q & indexed & load_table_q) begin
      loaded_q        <= '0;
      table_loading_q <= 1'b1;
    end else if (table_loading_q & (source_valid | collector_done)) begin
      loaded_q        <= sphere_count_q;
      table_loading_q <= 1'b0;
    end
  end

  // ---- SCPUs ----
  logic         array_valid, array_ready, array_idle, result_valid, result_ready;
  logic [1:0]   result_mask;
  logic [511:0] result_contacts;
  logic [61:0]  result_numbers;
  assign array_valid  = indexed ? lane_beat_valid : source_valid;
  assign source_ready = indexed ? lanes_ready & ~table_loading_q : array_ready;
  scpu_array #(.NumScpu(NumScpu), .Depth(Depth)) u_array (
    .clk_i, .rst_ni,
    .spread_i   (barrier_i),
    .more_i     (more),
    .valid_i    (array_valid),
    .ready_o    (array_ready),
    .mask_i     (indexed ? lane_mask : {left_q > 32'd1, 1'b1}),
    .pairs_i    (indexed ? lane_pairs : source_data),
    .tags_i     (indexed ? lane_numbers : {number_q[30:0] | 31'd1, number_q[30:0]}),
    .valid_o    (result_valid),
    .ready_i    (result_ready),
    .mask_o     (result_mask),
    .contacts_o (result_contacts),
    .tags_o     (result_numbers),
    .idle_o     (array_idle)
  );

  // ---- dispatcher ----
  logic         dispatcher_write, dispatcher_ready, dispatcher_idle;
  logic [57:0]  dispatcher_line;
  logic [511:0] dispatcher_data;
  logic [31:0]  lines_written, hits, scpu_pairs;
  dispatcher u_dispatcher (
    .clk_i, .rst_ni,
    .start_i       (start_q),
    .flush_i       (state_q == Flush),
    .hits_only_i   (hits_only),
    .dest_line_i   (dest_q),
    .dest_lines_i  (dest_lines_q),
    .valid_i       (result_valid),
    .ready_o       (result_ready),
    .mask_i        (result_mask),
    .contacts_i    (result_contacts),
    .numbers_i     (result_numbers),
    .write_valid_o (dispatcher_write),
    .write_ready_i (dispatcher_ready),
    .write_line_o  (dispatcher_line),
    .write_data_o  (dispatcher_data),
    .idle_o        (dispatcher_idle),
    .lines_o       (lines_written),
    .hits_o        (hits),
    .pairs_o       (scpu_pairs)
  );
  assign drained = ~line_valid & lanes_idle & array_idle & dispatcher_idle;

  // ---- digests of what came and what went ----
  logic        line_taken, line_sent;
  logic [63:0] source_digest, dest_digest;
  assign line_taken = data_valid_i & collector_data_ready & (state_q != Fetch);
  assign line_sent  = dispatcher_write & dispatcher_ready;
  line_digest u_source_digest (
    .clk_i, .rst_ni, .clear_i(start_q), .valid_i(line_taken), .line_i(data_i),
    .digest_o(source_digest)
  );
  line_digest u_dest_digest (
    .clk_i, .rst_ni, .clear_i(start_q), .valid_i(line_sent), .line_i(dispatcher_data),
    .digest_o(dest_digest)
  );

  // ---- counters, from the start signal on ----
  logic [31:0] cycles_q, spl2_cycles_q, first_line_q, first_write_q, last_write_q;
  logic [31:0] read_stalls_q, write_stalls_q, lines_read_q;
  logic        running_q, waiting;
  assign waiting = (state_q == Idle) | (state_q == Fetch);
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      cycles_q       <= '0;
      spl2_cycles_q  <= '0;
      first_line_q   <= '0;
      first_write_q  <= '0;
      last_write_q   <= '0;
      read_stalls_q  <= '0;
      write_stalls_q <= '0;
      lines_read_q   <= '0;
    end else begin
      if (active_i & waiting) spl2_cycles_q <= spl2_cycles_q + 32'd1;
      if (running_q) cycles_q <= cycles_q + 32'd1;
      if (line_taken) begin
        lines_read_q <= lines_read_q + 32'd1;
        if (lines_read_q == '0) first_line_q <= cycles_q;
      end
      if (line_sent & (lines_written == '0)) first_write_q <= cycles_q;
      if ((state_q == Settle) & (line_q == SendLatency)) last_write_q <= cycles_q;
      if (collector_read & ~read_ready_i) read_stalls_q <= read_stalls_q + 32'd1;
      if (dispatcher_write & ~dispatcher_ready) write_stalls_q <= write_stalls_q + 32'd1;
    end
  end

  // Without results there is nothing to be acknowledged before the counters.
  logic no_results;
  assign no_results = (line_q == SendLatency) & (lines_written == '0);

  // ---- ports to SPL2 ----
  logic own_write;
  assign own_write         = state_q == Send;
  assign take_control_data = (state_q == Fetch) & data_valid_i;
  assign data_ready_o      = (state_q == Fetch) | collector_data_ready;
  assign read_valid_o      = (state_q == Fetch) ? ask_q != '0 : collector_read;
  assign read_line_o       = (state_q == Fetch)
                           ? (ask_q[0] ? context_line_i
                                       : context_line_i + harpoon_contract_pkg::CONTROL_LINE)
                           : collector_line;
  assign dispatcher_ready  = write_ready_i & ~own_write;
  assign write_valid_o     = own_write | dispatcher_write;
  assign write_dsm_o       = own_write & (line_q != SendStatus);
  assign write_data_o      = own_write ? sent_line : dispatcher_data;
  always_comb begin
    write_line_o = dispatcher_line;
    if (own_write) begin
      unique case (line_q)
        SendId:          write_line_o = {52'd0, harpoon_contract_pkg::DSM_ID_LINE};
        SendLatency:     write_line_o = {52'd0, harpoon_contract_pkg::DSM_LATENCY_LINE};
        SendPerformance: write_line_o = {52'd0, harpoon_contract_pkg::DSM_PERFORMANCE_LINE};
        default:         write_line_o = context_line_i + harpoon_contract_pkg::STATUS_LINE;
      endcase
    end
  end

  // ---- the lines that the PUC itself writes ----
  harpoon_contract_pkg::dsm_id_t          id_line;
  harpoon_contract_pkg::dsm_latency_t     latency_line;
  harpoon_contract_pkg::dsm_performance_t performance_line;
  harpoon_contract_pkg::status_t          status_line;
  always_comb begin
    id_line                         = '0;
    id_line.low                     = harpoon_contract_pkg::AFU_ID_LOW;
    id_line.high                    = harpoon_contract_pkg::AFU_ID_HIGH;
    id_line.config_word             = config_i;
    id_line.table_spheres           = Spheres;
    id_line.sequence_word           = sequence_q;

    latency_line                    = '0;
    latency_line.sequence_word      = sequence_q;
    latency_line.first_line         = first_line_q;
    latency_line.first_write        = first_write_q;
    latency_line.last_write         = last_write_q;
    latency_line.read_stalls        = read_stalls_q;
    latency_line.write_stalls       = write_stalls_q;
    latency_line.spl2_cycles        = spl2_cycles_q;
    latency_line.sphere_count       = loaded_q;

    performance_line                = '0;
    performance_line.cycles         = cycles_q;
    performance_line.sequence_word  = sequence_q;
    performance_line.lines_read     = lines_read_q;
    performance_line.lines_written  = lines_written;
    performance_line.hits           = hits;
    performance_line.scpu_pairs     = scpu_pairs;
    performance_line.source_digest  = source_digest;
    performance_line.dest_digest    = dest_digest;

    status_line                     = '0;
    status_line.status.done         = 1'b1;
    status_line.status.failed       = error_q != harpoon_contract_pkg::ERROR_NONE;
    status_line.error.code          = error_q;
    status_line.sequence_word       = sequence_q;
    status_line.hits                = hits;
  end
  always_comb begin
    unique case (line_q)
      SendId:          own_line = id_line;
      SendLatency:     own_line = latency_line;
      SendPerformance: own_line = performance_line;
      default:         own_line = status_line;
    endcase
    sent_line       = own_line;
    sent_line.check = harpoon_contract_pkg::CHECK_SEED ^ fold;
  end

  // The lines hold still between fold and send: the counters stop before they are sent.
  line_fold u_fold (
    .clk_i,
    .valid_i      (take_control_data),
    .line_i       (control_line),
    .or_valid_i   (state_q == Fold),
    .or_line_i    (own_line),
    .fold_o       (fold)
  );

  // ---- what arrives while fetching ----
  assign data_view    = data_i;
  assign context_view = data_i;
  assign control_view = data_i;
  always_comb begin
    control_line       = data_i;
    control_line.check = '0;
  end
  always_ff @(posedge clk_i) begin
    context_judge_q <= take_control_data & ~got_context_q;
    if (context_judge_q) context_good_q <= check_good;
    if (take_control_data) check_q <= data_view.check;
    if (take_control_data & ~got_context_q) begin
      source_q       <= context_view.source.line;
      dest_q         <= context_view.dest.line;
      source_lines_q <= context_view.source_lines;
      dest_lines_q   <= context_view.dest_lines;
      spheres_q      <= context_view.spheres.line;
      sphere_count_q <= context_view.sphere_count;
    end
    if (take_control_data & got_context_q) begin
      go_q         <= control_view.start == harpoon_contract_pkg::CONTROL_GO;
      forget_q     <= control_view.reset == harpoon_contract_pkg::CONTROL_GO;
      pair_count_q <= control_view.pair_count;
      format_q     <= control_view.format;
      sequence_q   <= control_view.sequence_word;
      load_table_q <= control_view.load_table.load;
    end
  end

  // ---- the sequence ----
  logic id_pending_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      state_q       <= Idle;
      line_q        <= SendNothing;
      ask_q         <= '0;
      got_context_q <= 1'b0;
      start_q       <= 1'b0;
      running_q     <= 1'b0;
      error_q       <= harpoon_contract_pkg::ERROR_NONE;
    end else begin
      start_q <= 1'b0;
      unique case (state_q)
        Idle: begin
          if (id_pending_q) begin
            line_q  <= SendId;
            state_q <= Fold;
          end else if (spl2_on_i) begin
            ask_q         <= 2'b11;
            got_context_q <= 1'b0;
            state_q       <= Fetch;
          end
        end
        Fetch: begin
          if (read_ready_i & (ask_q != '0)) ask_q <= ask_q[0] ? {ask_q[1], 1'b0} : 2'b00;
          if (data_valid_i) begin
            got_context_q <= 1'b1;
            if (got_context_q) state_q <= Judge;
          end
        end
        Judge: begin
          if (!go_q) begin
            ask_q   <= 2'b10;
            state_q <= Fetch;
          end else begin
            error_q <= verdict;
            state_q <= Fold;
            if (verdict == harpoon_contract_pkg::ERROR_NONE) begin
              start_q   <= 1'b1;
              running_q <= 1'b1;
              line_q    <= SendId;
            end else begin
              line_q <= SendLatency;
            end
          end
        end
        Fold: state_q <= Send;
        Send: if (write_ready_i) begin
          unique case (line_q)
            SendId: state_q <= running_q ? Run : Idle;
            SendLatency: begin
              line_q  <= SendPerformance;
              state_q <= Fold;
            end
            SendPerformance: begin
              line_q  <= SendStatus;
              state_q <= Settle;
            end
            default: begin
              line_q  <= SendNothing;
              state_q <= Settle;
            end
          endcase
        end
        Run: if (collector_done & drained & ~start_q) state_q <= Flush;
        Flush: begin
          line_q  <= SendLatency;
          state_q <= Settle;
        end
        Settle: if (dispatcher_idle & (write_idle_i | no_results)) begin
          if (line_q == SendLatency) begin
            running_q <= 1'b0;
            if (index_error) error_q <= harpoon_contract_pkg::ERROR_INDEX;
          end
          state_q <= (line_q == SendNothing) ? Done : Fold;
        end
        default: ;
      endcase
    end
  end
  always_ff @(posedge clk_i) begin
    if (!cold_rst_ni) id_pending_q <= 1'b0;
    else if (dsm_commit_i) id_pending_q <= 1'b1;
    else if ((state_q == Send) & (line_q == SendId) & ~running_q) id_pending_q <= 1'b0;
  end

  assign done_o  = state_q == Done;
  assign idle_o  = (state_q == Idle) | (state_q == Done);
  assign error_o = error_q;
  assign state_o = state_q;
`ifdef FORMAL
  `include "puc.svh"
`endif
endmodule
