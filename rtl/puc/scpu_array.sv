// N sphere collision processing units behind one ready/valid port of two pairs a beat.
//
// The SCPUs are free-running pipelines of one pair a cycle and equal latency, so results return in
// pair order without any sorting; a credit for a place in the result queue is taken before a beat
// enters, so that nothing ever stalls inside. SCPUs work two at a time (slot 0 and slot 1); the
// work moves on to the next two after a turn (after every beat with `spread_i`), so N_col pairs are
// split over all N. Turns are FirstTurn beats long and double whenever all have had one, up to
// LastTurn: short batches are spread, long ones seldom change. With NumScpu = 1 a beat of two takes
// two cycles.
//
// The SCPUs move all together or not at all. While `more_i` says that beats are on their way, they
// wait up to Patience cycles for the next one instead of running empty. The clock of two SCPUs that
// hold no pair, or wait, is gated.
//
// The beats are those of the pair stream (puc_pkg); an empty one is taken and leaves nothing. The
// tags travel along. Latency: that of the SCPU plus 5, and the waiting. Legal: NumScpu = 1 or even,
// turns and Depth powers of two, Depth above that latency.
module scpu_array #(
  parameter int unsigned NumScpu    = 10,
  parameter int unsigned Depth      = 256,
  parameter int unsigned FirstTurn  = 64,
  parameter int unsigned LastTurn   = 4096,
  parameter int unsigned Patience   = 4
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             spread_i,
  input  logic             more_i,
  input  logic             valid_i,
  output logic             ready_o,
  input  puc_pkg::beat_t   beat_i,
  input  harpoon_contract_pkg::pair_line_t    pairs_i,
  output logic             valid_o,
  input  logic             ready_i,
  output puc_pkg::result_t result_o,
  output harpoon_contract_pkg::contact_line_t contacts_o,
  output logic             idle_o
);
  if (NumScpu != 1 && (NumScpu == 0 || NumScpu % 2 != 0))
    $error("scpu_array: NumScpu must be 1 or even");
  if (1 << $clog2(Depth) != Depth || Depth <= scpu_pkg::Latency + 5)
    $error("scpu_array: Depth must be a power of two above the latency");
  if (LastTurn < 4 || 1 << $clog2(LastTurn) != LastTurn)
    $error("scpu_array: LastTurn must be a power of two, at least 4");
  if (FirstTurn < 1 || FirstTurn > LastTurn || 1 << $clog2(FirstTurn) != FirstTurn)
    $error("scpu_array: FirstTurn must be a power of two, 1 to LastTurn");
  if (Patience < 1)
    $error("scpu_array: Patience must be at least 1");

  localparam int unsigned SLOTS   = (NumScpu == 1) ? 1 : 2;
  localparam int unsigned COLUMNS = NumScpu / SLOTS;
  localparam int unsigned COL     = (COLUMNS > 1) ? $clog2(COLUMNS) : 1;
  localparam int unsigned BEAT    = $clog2(LastTurn);
  localparam int unsigned PAUSE   = $clog2(Patience + 1);
  localparam int unsigned RUN     = $clog2(scpu_pkg::Latency + 3);

  // ---- one beat in, for NumScpu = 1 in two halves ----
  logic                  issue, credit, last_half;
  logic [1:0]            issue_mask;
  logic [256*SLOTS-1:0]  issue_pairs;
  puc_pkg::tags_t        issue_tags;

  assign issue   = valid_i & credit & beat_i.mask[0];
  assign ready_o = credit & last_half;
  if (SLOTS == 1) begin : gen_halves
    logic half_q;
    always_ff @(posedge clk_i) begin
      if (!rst_ni) half_q <= 1'b0;
      else if (issue) half_q <= ~last_half;
    end
    assign last_half   = half_q | ~beat_i.mask[1];
    assign issue_mask  = {1'b0, half_q | beat_i.mask[0]};
    assign issue_pairs = half_q ? pairs_i.second : pairs_i.first;
    assign issue_tags  = half_q ? {31'd0, beat_i.tags.second} : beat_i.tags;
  end else begin : gen_whole
    assign last_half   = 1'b1;
    assign issue_mask  = beat_i.mask;
    assign issue_pairs = pairs_i;
    assign issue_tags  = beat_i.tags;
  end

  // ---- which SCPUs ----
  logic            turn_over;
  logic [COL-1:0]  column_q;
  logic [BEAT-1:0] beat_q, last_beat_q;   // of the turn
  assign turn_over = spread_i | (beat_q == last_beat_q);
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      column_q    <= '0;
      beat_q      <= '0;
      last_beat_q <= BEAT'(FirstTurn - 1);
    end else if (issue) begin
      beat_q <= turn_over ? '0 : beat_q + BEAT'(1);
      if (turn_over) begin
        column_q <= (column_q == COL'(COLUMNS-1)) ? '0 : column_q + COL'(1);
        if (column_q == COL'(COLUMNS-1)) last_beat_q <= {last_beat_q[BEAT-2:0], 1'b1};
      end
    end
  end

  // ---- do they move in this cycle? ----
  logic             step;
  logic [PAUSE-1:0] pause_q;
  assign step = issue | ~more_i | (pause_q == PAUSE'(Patience));
  always_ff @(posedge clk_i) begin
    if (!rst_ni || issue) pause_q <= '0;
    else if (pause_q != PAUSE'(Patience)) pause_q <= pause_q + PAUSE'(1);
  end

  // ---- the SCPUs ----
  logic                   scpu_rst_nq;   // a cycle later: their state is not looked at till then
  always_ff @(posedge clk_i) scpu_rst_nq <= rst_ni;

  logic [NumScpu-1:0]     done;
  logic [256*NumScpu-1:0] contact;
  for (genvar c = 0; c < COLUMNS; c++) begin : gen_column
    logic           mine, clk, running;
    logic [RUN-1:0] run_q;

    assign mine    = issue & (column_q == COL'(c));
    assign running = (step & (mine | (run_q != '0))) | ~scpu_rst_nq;
    always_ff @(posedge clk_i) begin
      if (!rst_ni) run_q <= '0;
      else if (mine) run_q <= RUN'(scpu_pkg::Latency + 2);
      else if (step & (run_q != '0)) run_q <= run_q - RUN'(1);
    end
    clock_gate u_gate (.clk_i, .enable_i(running), .clk_o(clk));
    for (genvar s = 0; s < SLOTS; s++) begin : gen_slot
      logic         start_q;
      logic [255:0] pair_q;
      always_ff @(posedge clk_i) begin
        if (!rst_ni) start_q <= 1'b0;
        else if (step) start_q <= mine & issue_mask[s];
        if (mine & issue_mask[s]) pair_q <= issue_pairs[256*s +: 256];
      end
      scpu u_scpu (
        .clk_i     (clk),
        .rst_ni    (scpu_rst_nq),
        .valid_i   (start_q),
        .pair_i    (pair_q),
        .valid_o   (done[SLOTS*c+s]),
        .contact_o (contact[256*(SLOTS*c+s) +: 256])
      );
    end
  end

  // ---- collect: in each slot at most one SCPU finishes in a cycle ----
  logic [511:0] merged, merged_q;
  logic         merged_valid_q;
  always_comb begin
    merged = '0;
    for (int unsigned i = 0; i < NumScpu; i++) begin
      if (done[i]) begin
        merged[256*(i%SLOTS) +: 256] = contact[256*i +: 256];
      end
    end
  end
  always_ff @(posedge clk_i) begin
    if (!rst_ni) merged_valid_q <= 1'b0;
    else         merged_valid_q <= step & (|done) & scpu_rst_nq;
    if (|done) merged_q <= merged;
  end

  // ---- queues, reserved by credits ----
  logic           take_result, tag_valid, tag_ready, result_ready, tag_empty, result_empty;
  logic           all_home;
  logic [1:0]     mask;
  puc_pkg::tags_t tags;
  fifo #(.Width(64), .Depth(Depth)) u_tags (
    .clk_i, .rst_ni,
    .valid_i (issue),
    .ready_o (tag_ready),
    .data_i  ({issue_mask, issue_tags}),
    .valid_o (tag_valid),
    .ready_i (take_result),
    .data_o  ({mask, tags}),
    .empty_o (tag_empty)
  );
  fifo #(.Width(512), .Depth(Depth)) u_results (
    .clk_i, .rst_ni,
    .valid_i (merged_valid_q),
    .ready_o (result_ready),
    .data_i  (merged_q),
    .valid_o (valid_o),
    .ready_i (take_result),
    .data_o  (contacts_o),
    .empty_o (result_empty)
  );
  assign take_result = valid_o & ready_i;
  always_comb begin
    result_o.mask = mask;
    result_o.tags = tags;
  end
  credits #(.Count(Depth)) u_credits (
    .clk_i, .rst_ni,
    .take_i      (issue),
    .give_i      (take_result),
    .available_o (credit),
    .all_home_o  (all_home)
  );
  assign idle_o = all_home;

  // the credits make these constant; they are outputs of general cells. The last beat is no other
  // to the SCPUs.
  logic unused;
  assign unused = tag_valid ^ tag_ready ^ result_ready ^ tag_empty ^ result_empty ^ beat_i.last;
`ifdef FORMAL
  `include "scpu_array.svh"
`endif
endmodule
