// The front end of the indexed format: the sphere table, and index_lanes, which turns a line of Src
// into beats of those of its pairs that are not ruled out.
//
// Lines of the sphere array come first (`table_*_i`), if `load_i`; what was loaded counts once it
// is all there: `loaded_o`. A cold reset and `forget_i` empty the table, no other reset does. A
// pair that names a sphere which was not loaded sets `index_error_o` until the next `start_i`.
//
// Where the stream ends is known only once all lines are decided: the last beat is an empty one.
// `open_i`: it is still to come. `lines_done_i`: no line will come. `more_i`: lines are on their
// way, and worth waiting for; with `barrier_i` nothing of a line waits for the next.
//
// The clock is gated in the other formats (`enable_i` low), but for the start, which clears an
// index error, and a reset, which the cull lanes see a cycle late. The slice keeps other lines
// away.
module front_indexed #(
  parameter int unsigned Lanes   = 10,
  parameter int unsigned Spheres = 16384
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             cold_rst_ni,
  input  logic             enable_i,
  input  logic             start_i,
  input  logic             forget_i,
  input  logic             load_i,
  input  logic [31:0]      sphere_count_i,
  input  logic             barrier_i,
  input  logic             more_i,
  input  logic             open_i,
  input  logic             lines_done_i,

  input  logic             table_valid_i,
  input  logic [511:0]     table_data_i,
  input  logic             valid_i,
  output logic             ready_o,
  input  puc_pkg::source_t source_i,
  input  logic [511:0]     line_i,
  output logic             valid_o,
  input  logic             ready_i,
  output puc_pkg::beat_t   beat_o,
  output harpoon_contract_pkg::pair_line_t pairs_o,

  output logic [31:0]      loaded_o,
  output logic             index_error_o,
  output logic             idle_o           // nothing inside
);
  if (Lanes < 1 || Lanes > 16)
    $error("front_indexed: Lanes must be 1 to 16");
  if (Spheres < 8 || Spheres > 65536 || 1 << $clog2(Spheres) != Spheres)
    $error("front_indexed: Spheres must be a power of two, 8 to 65536");

  // ---- what the table holds ----
  logic [31:0] loaded_q;
  logic        loading_q;
  assign loaded_o = loaded_q;
  always_ff @(posedge clk_i) begin
    if (!cold_rst_ni || forget_i) begin
      loaded_q  <= '0;
      loading_q <= 1'b0;
    end else if (!rst_ni) begin
      loading_q <= 1'b0;
    end else if (start_i & load_i) begin
      loaded_q  <= '0;
      loading_q <= 1'b1;
    end else if (loading_q & (valid_i | lines_done_i)) begin
      loaded_q  <= sphere_count_i;
      loading_q <= 1'b0;
    end
  end

  // ---- lines ----
  logic             clk, rst_nq, slice_ready, line_valid, line_ready;
  puc_pkg::source_t line;
  logic [511:0]     line_data;
  always_ff @(posedge clk_i) rst_nq <= rst_ni;
  assign ready_o = slice_ready & ~loading_q;
  clock_gate u_gate (
    .clk_i,
    .enable_i (enable_i | start_i | ~rst_ni | ~rst_nq),
    .clk_o    (clk)
  );
  register_slice #(.Width(549)) u_slice (
    .clk_i   (clk),
    .rst_ni,
    .valid_i (valid_i & enable_i & ~loading_q),
    .ready_o (slice_ready),
    .data_i  ({source_i.last | barrier_i, source_i.count, source_i.number, line_i}),
    .valid_o (line_valid),
    .ready_i (line_ready),
    .data_o  ({line, line_data})
  );

  // ---- pairs ----
  logic       lanes_valid, lanes_idle, closing;
  logic [1:0] mask;
  index_lanes #(.Lanes(Lanes), .Spheres(Spheres)) u_lanes (
    .clk_i          (clk),
    .clk_free_i     (clk_i),
    .rst_ni,
    .start_i,
    .sphere_count_i (loaded_q),
    .table_clear_i  (start_i),
    .table_valid_i,
    .table_data_i,
    .valid_i        (line_valid),
    .ready_o        (line_ready),
    .line_i         (line_data),
    .number_i       (line.number),
    .count_i        (line.count),
    .last_i         (line.last),
    .more_i,
    .valid_o        (lanes_valid),
    .ready_i        (ready_i & enable_i),
    .mask_o         (mask),
    .pairs_o        (pairs_o),
    .numbers_o      (beat_o.tags),
    .index_error_o,
    .idle_o         (lanes_idle)
  );
  assign idle_o      = ~line_valid & lanes_idle;
  assign closing     = open_i & lines_done_i & idle_o;
  assign valid_o     = lanes_valid | closing;
  assign beat_o.last = closing;
  assign beat_o.mask = closing ? 2'b00 : mask;
`ifdef FORMAL
  `include "front_indexed.svh"
`endif
endmodule
