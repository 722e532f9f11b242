// The Processing Units Controller: its parts, and who of them has the ports to SPL2.
//
//                puc_sequence ---- start, flush, which line ----> puc_report --+-> own lines
//                     |                                                ^       |
//   control <- puc_job (context, control line)            puc_counters-+       |
//                                                                              |
//   Src -> collector -> source_numbers -+-> front_direct --+-> scpu_array -> dispatcher -> Dst
//                                       +-> front_indexed -+
//
// A front end makes the stream of pairs (puc_pkg) from lines of Src. What a run is made of is the
// job's (puc_job), what happens when is the sequence's, whose head tells the life of a transaction.
// After the end (`done_o`) nothing happens until reset. Reset forgets everything but the sphere
// table and how much of it was loaded.
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

  // ---- the sequence, and the job ----
  puc_pkg::state_e state;
  puc_pkg::line_e  which;
  puc_pkg::job_t   job;
  puc_pkg::plan_t  plan;
  logic            start, running, ask_all, ask_again, got_control, go, forget, fetching, own_write;
  logic            run_over, job_read, fold_control;
  logic [57:0]     job_line;
  logic [63:0]     fold;
  logic [511:0]    control_line, own_line;
  harpoon_contract_pkg::error_e verdict;

  assign fetching  = state == puc_pkg::Fetch;
  assign own_write = state == puc_pkg::Send;
  assign done_o    = state == puc_pkg::Done;
  assign idle_o    = (state == puc_pkg::Idle) | done_o;
  assign state_o   = state;

  puc_sequence u_sequence (
    .clk_i, .rst_ni, .cold_rst_ni,
    .spl2_on_i,
    .dsm_commit_i,
    .got_control_i  (got_control),
    .go_i           (go),
    .verdict_i      (verdict),
    .run_over_i     (run_over),
    .index_error_i  (index_error),
    .results_idle_i (dispatcher_idle),
    .no_results_i   (results.lines == '0),
    .writes_idle_i  (write_idle_i),
    .write_ready_i,
    .ask_all_o      (ask_all),
    .ask_again_o    (ask_again),
    .start_o        (start),
    .running_o      (running),
    .state_o        (state),
    .line_o         (which),
    .error_o
  );
  puc_job #(.Spheres(Spheres)) u_job (
    .clk_i, .rst_ni,
    .ask_all_i     (ask_all),
    .ask_again_i   (ask_again),
    .fetch_i       (fetching),
    .context_line_i,
    .read_valid_o  (job_read),
    .read_ready_i,
    .read_line_o   (job_line),
    .data_valid_i,
    .data_i,
    .fold_valid_o  (fold_control),
    .fold_line_o   (control_line),
    .fold_i        (fold),
    .got_control_o (got_control),
    .go_o          (go),
    .forget_o      (forget),
    .job_o         (job),
    .plan_o        (plan),
    .verdict_o     (verdict)
  );
  line_fold u_fold (
    .clk_i,
    .valid_i    (fold_control),
    .line_i     (control_line),
    .or_valid_i (state == puc_pkg::Fold),
    .or_line_i  (own_line),
    .fold_o     (fold)
  );

  // ---- lines in ----
  logic             collector_read, collector_data_ready, collector_done, table_valid;
  logic             source_valid, source_ready, drained, line_taken, more;
  logic [57:0]      collector_line;
  logic [511:0]     table_data, source_data;
  puc_pkg::source_t source;

  collector u_collector (
    .clk_i, .rst_ni,
    .start_i        (start),
    .table_line_i   (job.spheres_line),
    .table_lines_i  (plan.table_lines),
    .source_line_i  (job.source_line),
    .source_lines_i (plan.source_lines),
    .barrier_i,
    .batch_lines_i  (plan.indexed ? 32'd1 : 32'((NumScpu + 1) / 2)),
    .drained_i      (drained),
    .read_valid_o   (collector_read),
    .read_ready_i   (read_ready_i & ~fetching),
    .read_line_o    (collector_line),
    .data_valid_i   (data_valid_i & ~fetching),
    .data_ready_o   (collector_data_ready),
    .data_i,
    .table_valid_o  (table_valid),
    .table_data_o   (table_data),
    .source_valid_o (source_valid),
    .source_ready_i (source_ready),
    .source_data_o  (source_data),
    .done_o         (collector_done)
  );
  source_numbers u_numbers (
    .clk_i,
    .start_i      (start),
    .pair_count_i (job.pair_count),
    .indexed_i    (plan.indexed),
    .taken_i      (source_valid & source_ready),
    .source_o     (source)
  );
  assign line_taken = data_valid_i & collector_data_ready & ~fetching;
  assign more       = ~collector_done & ~barrier_i;   // lines that are worth waiting for

  // ---- front ends ----
  logic           beat_valid, array_ready, ended_q, last_taken;
  logic           direct_valid, direct_ready, indexed_valid, indexed_ready, indexed_idle;
  logic           index_error;
  logic [31:0]    loaded;
  puc_pkg::beat_t beat, direct_beat, indexed_beat;
  harpoon_contract_pkg::pair_line_t pairs, direct_pairs, indexed_pairs;

  front_direct u_direct (
    .open_i       (~ended_q),
    .lines_done_i (collector_done),
    .valid_i      (source_valid),
    .ready_o      (direct_ready),
    .source_i     (source),
    .line_i       (source_data),
    .valid_o      (direct_valid),
    .ready_i      (array_ready),
    .beat_o       (direct_beat),
    .pairs_o      (direct_pairs)
  );
  front_indexed #(.Lanes(Lanes), .Spheres(Spheres)) u_indexed (
    .clk_i, .rst_ni, .cold_rst_ni,
    .enable_i       (plan.indexed),
    .start_i        (start),
    .forget_i       (ask_again & forget),
    .load_i         (plan.indexed & job.load_table),
    .sphere_count_i (job.sphere_count),
    .barrier_i,
    .more_i         (more),
    .open_i         (~ended_q),
    .lines_done_i   (collector_done),
    .table_valid_i  (table_valid),
    .table_data_i   (table_data),
    .valid_i        (source_valid),
    .ready_o        (indexed_ready),
    .source_i       (source),
    .line_i         (source_data),
    .valid_o        (indexed_valid),
    .ready_i        (array_ready),
    .beat_o         (indexed_beat),
    .pairs_o        (indexed_pairs),
    .loaded_o       (loaded),
    .index_error_o  (index_error),
    .idle_o         (indexed_idle)
  );
  assign source_ready = plan.indexed ? indexed_ready : direct_ready;
  assign beat_valid   = plan.indexed ? indexed_valid : direct_valid;
  assign beat         = plan.indexed ? indexed_beat : direct_beat;
  assign pairs        = plan.indexed ? indexed_pairs : direct_pairs;

  // ---- the stream to its end: every pair went to the SCPUs, and its result to Dst ----
  assign last_taken = beat_valid & array_ready & beat.last;
  assign drained    = indexed_idle & array_idle & dispatcher_idle;
  assign run_over   = (ended_q | (last_taken & ~beat.mask[0])) & collector_done & drained;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) ended_q <= 1'b1;
    else if (start) ended_q <= 1'b0;
    else if (last_taken) ended_q <= 1'b1;
  end

  // ---- SCPUs, dispatcher ----
  logic              array_idle, result_valid, result_ready;
  logic              dispatcher_write, dispatcher_ready, dispatcher_idle, line_sent;
  logic [57:0]       dispatcher_line;
  logic [511:0]      dispatcher_data;
  puc_pkg::result_t  result;
  puc_pkg::results_t results;
  harpoon_contract_pkg::contact_line_t contacts;

  scpu_array #(.NumScpu(NumScpu), .Depth(Depth)) u_array (
    .clk_i, .rst_ni,
    .spread_i   (barrier_i),
    .more_i     (more),
    .valid_i    (beat_valid),
    .ready_o    (array_ready),
    .beat_i     (beat),
    .pairs_i    (pairs),
    .valid_o    (result_valid),
    .ready_i    (result_ready),
    .result_o   (result),
    .contacts_o (contacts),
    .idle_o     (array_idle)
  );
  dispatcher u_dispatcher (
    .clk_i, .rst_ni,
    .start_i       (start),
    .flush_i       (state == puc_pkg::Flush),
    .hits_only_i   (plan.hits_only),
    .dest_line_i   (job.dest_line),
    .dest_lines_i  (job.dest_lines),
    .valid_i       (result_valid),
    .ready_o       (result_ready),
    .result_i      (result),
    .contacts_i    (contacts),
    .write_valid_o (dispatcher_write),
    .write_ready_i (dispatcher_ready),
    .write_line_o  (dispatcher_line),
    .write_data_o  (dispatcher_data),
    .idle_o        (dispatcher_idle),
    .results_o     (results)
  );
  assign line_sent = dispatcher_write & dispatcher_ready;

  // ---- counters, and the PUC's own lines ----
  puc_pkg::counters_t counters;
  puc_pkg::digests_t  digests;
  logic               own_dsm;
  logic [57:0]        own_address;
  logic [511:0]       own_data;

  puc_counters u_counters (
    .clk_i, .rst_ni,
    .start_i        (start),
    .running_i      (running),
    .waiting_i      (active_i & (fetching | (state == puc_pkg::Idle))),
    .settled_i      ((state == puc_pkg::Settle) & (which == puc_pkg::SendLatency)),
    .read_stall_i   (collector_read & ~read_ready_i),
    .write_stall_i  (dispatcher_write & ~dispatcher_ready),
    .line_taken_i   (line_taken),
    .line_i         (data_i),
    .line_sent_i    (line_sent),
    .sent_line_i    (dispatcher_data),
    .no_line_sent_i (results.lines == '0),
    .counters_o     (counters),
    .digests_o      (digests)
  );
  puc_report #(.Spheres(Spheres)) u_report (
    .which_i        (which),
    .context_line_i,
    .config_i,
    .sequence_i     (job.sequence_word),
    .loaded_i       (loaded),
    .error_i        (error_o),
    .counters_i     (counters),
    .digests_i      (digests),
    .results_i      (results),
    .fold_i         (fold),
    .line_o         (own_line),
    .data_o         (own_data),
    .dsm_o          (own_dsm),
    .write_line_o   (own_address)
  );

  // ---- ports to SPL2 ----
  assign data_ready_o     = fetching | collector_data_ready;
  assign read_valid_o     = fetching ? job_read : collector_read;
  assign read_line_o      = fetching ? job_line : collector_line;
  assign dispatcher_ready = write_ready_i & ~own_write;
  assign write_valid_o    = own_write | dispatcher_write;
  assign write_dsm_o      = own_write & own_dsm;
  assign write_data_o     = own_write ? own_data : dispatcher_data;
  assign write_line_o     = own_write ? own_address : dispatcher_line;
`ifdef FORMAL
  `include "puc.svh"
`endif
endmodule
