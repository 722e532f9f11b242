// The indexed format: lines of 16 index pairs in, beats of one or two pairs of spheres out, those
// that the cull lanes could not rule out, in pair order.
//
// Lanes pairs a cycle are looked up in the sphere table and decided by scpu_cull (the exact miss
// test without a square root). What survives, by index, is compacted to two pairs a cycle, looked
// up again and handed to the SCPUs, which decide all over: the cull may err only towards keeping.
// Credits reserve the place of every slice that enters.
//
//   line -> index_slices -> table (2) -> scpu_cull -> decisions -+
//                  +----> indices, numbers (queue) --------------+-> index_compact -> table (2)
//                                                                      -> pairs
//
// `last_i`: nothing of this line is to wait; a line that is not the last has 16 pairs. The cull
// lanes move all together or not at all; while `more_i` says that lines are on their way, they wait
// up to Patience cycles for the next slice instead of running empty.
//
// `index_error_o` (sticky until `start_i`): a pair named a sphere at or beyond `sphere_count_i`.
// Lanes is 1 to 16. `idle_o`: nothing inside. `clk_i` may be gated; `clk_free_i` is that clock
// before its gate, for the gate of the cull lanes.
module index_lanes #(
  parameter int unsigned Lanes   = 10,
  parameter int unsigned Spheres = 16384,
  parameter int unsigned Depth   = 128,
  parameter int unsigned Patience = 4
) (
  input  logic         clk_i,
  input  logic         clk_free_i,
  input  logic         rst_ni,
  input  logic         start_i,
  input  logic [31:0]  sphere_count_i,
  input  logic         table_clear_i,   // the next table line is row 0
  input  logic         table_valid_i,
  input  logic [511:0] table_data_i,

  input  logic         valid_i,
  output logic         ready_o,
  input  logic [511:0] line_i,
  input  logic [30:0]  number_i,        // of the first pair in the line
  input  logic [4:0]   count_i,         // pairs in the line, 1 to 16
  input  logic         last_i,
  input  logic         more_i,

  output logic         valid_o,
  input  logic         ready_i,
  output logic [1:0]   mask_o,
  output logic [511:0] pairs_o,
  output logic [61:0]  numbers_o,

  output logic         index_error_o,
  output logic         idle_o
);
  if (Lanes < 1 || Lanes > 16)
    $error("index_lanes: Lanes must be 1 to 16");
  if (Spheres < 8 || Spheres > 65536 || 1 << $clog2(Spheres) != Spheres)
    $error("index_lanes: Spheres must be a power of two, 8 to 65536");
  if (Depth < 2 || 1 << $clog2(Depth) != Depth)
    $error("index_lanes: Depth must be a power of two, at least 2");
  if (Patience < 1)
    $error("index_lanes: Patience must be at least 1");

  localparam int unsigned W        = (Spheres > 4) ? $clog2(Spheres) : 3;
  localparam int unsigned PORTS    = 2*Lanes + 4;
  localparam int unsigned IDX      = (Lanes > 0) ? 32*Lanes : 32;

  // ---- table, filled row by row ----
  logic [W-3:0]         row_q;
  logic [PORTS-1:0]     port_enable;
  logic [PORTS*W-1:0]   port_index;
  logic [PORTS*128-1:0] port_sphere;

  always_ff @(posedge clk_i) begin
    if (!rst_ni || table_clear_i) row_q <= '0;
    else if (table_valid_i) row_q <= row_q + (W-2)'(1);
  end
  sphere_table #(.Spheres(Spheres), .Ports(PORTS)) u_table (
    .clk_i,
    .write_i      (table_valid_i),
    .write_row_i  (row_q),
    .write_data_i (table_data_i),
    .enable_i     (port_enable),
    .index_i      (port_index),
    .sphere_o     (port_sphere)
  );

  // ---- slices of Lanes pairs; a credit for a place behind is taken with each ----
  logic             credit, issue, slice_there, slice_valid_q, all_home, none_kept;
  logic [IDX-1:0]   slice, slice_q;
  logic [Lanes-1:0] present, present_q;
  logic [30:0]      slice_number;
  index_slices #(.Lanes(Lanes)) u_slicer (
    .clk_i, .rst_ni,
    .start_i,
    .valid_i,
    .ready_o,
    .line_i,
    .number_i,
    .count_i,
    .last_i,
    .valid_o   (slice_there),
    .ready_i   (credit),
    .slice_o   (slice),
    .present_o (present),
    .number_o  (slice_number),
    .empty_o   (none_kept)
  );
  assign issue = slice_there & credit;
  always_ff @(posedge clk_i) begin
    slice_valid_q <= rst_ni & ~start_i & issue;
    if (issue) begin
      slice_q   <= slice;
      present_q <= present;
    end
  end

  // ---- range check ----
  logic [31:0]      spheres_q;   // where the lanes are: the PUC's count is not
  logic [Lanes-1:0] outside;
  for (genvar g = 0; g < Lanes; g++) begin : gen_range
    assign outside[g] = present_q[g] & ((32'(slice_q[32*g +: 16]) >= spheres_q)
                                      | (32'(slice_q[32*g+16 +: 16]) >= spheres_q));
  end
  always_ff @(posedge clk_i) begin
    spheres_q <= sphere_count_i;
    if (!rst_ni || start_i) index_error_o <= 1'b0;
    else if (slice_valid_q & (|outside)) index_error_o <= 1'b1;
  end

  // ---- lanes: look up, decide ----
  logic [1:0]       fetch_q;
  logic [Lanes-1:0] decided, miss;
  logic             lookup;
  assign lookup = slice_valid_q | fetch_q[0];
  always_ff @(posedge clk_i) begin
    if (!rst_ni) fetch_q <= '0;
    else         fetch_q <= {fetch_q[0], slice_valid_q};
  end
  localparam int unsigned RUN = $clog2(scpu_pkg::CullLatency + 3);
  localparam int unsigned PAUSE = $clog2(Patience + 1);
  logic             step, running, clk;
  logic [RUN-1:0]   run_q;
  logic [PAUSE-1:0] pause_q;
  logic             cull_rst_nq;   // a cycle later: their state is not looked at till then
  always_ff @(posedge clk_i) cull_rst_nq <= rst_ni;
  assign step    = fetch_q[1] | ~more_i | (pause_q == PAUSE'(Patience));
  assign running = (step & ((run_q != '0) | fetch_q[1])) | ~cull_rst_nq;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) run_q <= '0;
    else if (fetch_q[1]) run_q <= RUN'(scpu_pkg::CullLatency + 2);
    else if (step & (run_q != '0)) run_q <= run_q - RUN'(1);
    if (!rst_ni || fetch_q[1]) pause_q <= '0;
    else if (pause_q != PAUSE'(Patience)) pause_q <= pause_q + PAUSE'(1);
  end
  clock_gate u_gate (.clk_i(clk_free_i), .enable_i(running), .clk_o(clk));
  for (genvar g = 0; g < Lanes; g++) begin : gen_lane
    assign port_enable[2*g +: 2]    = {2{lookup}};
    assign port_index[2*g*W +: W]     = slice_q[32*g +: W];
    assign port_index[(2*g+1)*W +: W] = slice_q[32*g+16 +: W];
    scpu_cull u_cull (
      .clk_i   (clk),
      .rst_ni  (cull_rst_nq),
      .valid_i (fetch_q[1]),
      .pair_i  (port_sphere[256*g +: 256]),
      .valid_o (decided[g]),
      .miss_o  (miss[g])
    );
  end

  // ---- decisions meet their indices ----
  logic             head_valid, head_queued, head_done, decision_ready, queue_ready;
  logic             decision_empty, queue_empty;
  logic [Lanes-1:0] head_miss, head_present;
  logic [IDX-1:0]   head_slice;
  logic [30:0]      head_number;
  fifo #(.Width(Lanes), .Depth(Depth)) u_decisions (
    .clk_i, .rst_ni,
    .valid_i (step & decided[0] & cull_rst_nq),
    .ready_o (decision_ready),
    .data_i  (miss),
    .valid_o (head_valid),
    .ready_i (head_done),
    .data_o  (head_miss),
    .empty_o (decision_empty)
  );
  fifo #(.Width(31 + Lanes + IDX), .Depth(Depth)) u_slices (
    .clk_i, .rst_ni,
    .valid_i (issue),
    .ready_o (queue_ready),
    .data_i  ({slice_number, present, slice}),
    .valid_o (head_queued),
    .ready_i (head_done),
    .data_o  ({head_number, head_present, head_slice}),
    .empty_o (queue_empty)
  );
  credits #(.Count(Depth)) u_credits (
    .clk_i, .rst_ni,
    .take_i      (issue),
    .give_i      (head_done),
    .available_o (credit),
    .all_home_o  (all_home)
  );

  // ---- compact: the survivors of the head, two a cycle ----
  logic [1:0]  found;
  logic        look_ready, compact;
  harpoon_contract_pkg::index_pair_t first_idx, second_idx;
  logic [30:0] first_number, second_number;
  index_compact #(.Lanes(Lanes)) u_compact (
    .clk_i, .rst_ni,
    .valid_i         (head_valid),
    .done_o          (head_done),
    .slice_i         (head_slice),
    .present_i       (head_present),
    .miss_i          (head_miss),
    .number_i        (head_number),
    .valid_o         (compact),
    .ready_i         (look_ready),
    .mask_o          (found),
    .first_o         (first_idx),
    .second_o        (second_idx),
    .first_number_o  (first_number),
    .second_number_o (second_number)
  );

  // ---- look up again: two stages that move together ----
  logic [2:0]  look_valid_q;
  logic [1:0]  look_mask_q   [0:2];
  logic [61:0] look_number_q [0:2];
  logic [4*W-1:0] look_idx_q;
  assign look_ready = ~look_valid_q[2] | ready_i;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) look_valid_q <= '0;
    else if (look_ready) look_valid_q <= {look_valid_q[1:0], compact};
    if (look_ready) begin
      look_mask_q[0]   <= found;
      look_mask_q[1]   <= look_mask_q[0];
      look_mask_q[2]   <= look_mask_q[1];
      look_number_q[0] <= {second_number, first_number};
      look_number_q[1] <= look_number_q[0];
      look_number_q[2] <= look_number_q[1];
      look_idx_q       <= {second_idx.p2[W-1:0], second_idx.p1[W-1:0],
                           first_idx.p2[W-1:0], first_idx.p1[W-1:0]};
    end
  end
  for (genvar g = 0; g < 4; g++) begin : gen_again
    assign port_enable[2*Lanes+g] = look_ready & (look_valid_q != '0);
    assign port_index[(2*Lanes+g)*W +: W] = look_idx_q[W*g +: W];
  end

  assign valid_o   = look_valid_q[2];
  assign mask_o    = look_mask_q[2];
  assign numbers_o = look_number_q[2];
  assign pairs_o   = port_sphere[256*Lanes +: 512];
  assign idle_o    = all_home & (look_valid_q == '0) & none_kept;

  // the credits make these constant; they are outputs of general cells
  logic unused;
  assign unused = head_queued ^ decision_ready ^ queue_ready ^ decision_empty ^ queue_empty
                ^ (^decided);
`ifdef FORMAL
  `include "index_lanes.svh"
`endif
endmodule
