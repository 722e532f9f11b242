// The job: fetches VAFU2_CNTXT and the control line, checks and holds them, and says what they ask
// for and what is wrong with it.
//
// `ask_all_i` (one cycle) asks for both lines, `ask_again_i` for the control line alone; both are
// requested while `fetch_i` is high, and in that time every line that arrives is taken for one of
// them, the context first. `got_control_o`: this is the control line. The job, the plan,
// `verdict_o`, `go_o` and `forget_o` are good from the next cycle on. The fold of a line is worked
// out elsewhere: `fold_i` is that of `fold_line_o` a cycle after `fold_valid_o`.
module puc_job #(
  parameter int unsigned Spheres = 16384
) (
  input  logic                         clk_i,
  input  logic                         rst_ni,
  input  logic                         ask_all_i,
  input  logic                         ask_again_i,
  input  logic                         fetch_i,
  input  logic [57:0]                  context_line_i,

  output logic                         read_valid_o,
  input  logic                         read_ready_i,
  output logic [57:0]                  read_line_o,
  input  logic                         data_valid_i,
  input  logic [511:0]                 data_i,

  output logic                         fold_valid_o,
  output logic [511:0]                 fold_line_o,
  input  logic [63:0]                  fold_i,

  output logic                         got_control_o,
  output logic                         go_o,
  output logic                         forget_o,   // the sphere table
  output puc_pkg::job_t                job_o,
  output puc_pkg::plan_t               plan_o,
  output harpoon_contract_pkg::error_e verdict_o
);
  if (Spheres < 8 || Spheres > 65536 || 1 << $clog2(Spheres) != Spheres)
    $error("puc_job: Spheres must be a power of two, 8 to 65536");

  // ---- the two lines, as they arrive ----
  harpoon_contract_pkg::checked_line_t data_view;
  harpoon_contract_pkg::vafu2_cntxt_t  context_view;
  harpoon_contract_pkg::control_t      control_view;
  logic [1:0]  ask_q;   // bit 0: context, bit 1: control line, still to request
  logic        got_context_q, take, take_context, take_control;

  assign data_view     = data_i;
  assign context_view  = data_i;
  assign control_view  = data_i;
  assign take          = fetch_i & data_valid_i;
  assign take_context  = take & ~got_context_q;
  assign take_control  = take & got_context_q;
  assign got_control_o = take_control;
  assign fold_valid_o  = take;
  assign fold_line_o   = {64'd0, data_view.body};
  assign read_valid_o  = ask_q != '0;
  assign read_line_o   = ask_q[0] ? context_line_i
                                  : context_line_i + harpoon_contract_pkg::CONTROL_LINE;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      ask_q         <= '0;
      got_context_q <= 1'b0;
    end else if (ask_all_i) begin
      ask_q         <= 2'b11;
      got_context_q <= 1'b0;
    end else if (ask_again_i) begin
      ask_q         <= 2'b10;
    end else if (fetch_i) begin
      if (read_ready_i & read_valid_o) ask_q <= ask_q[0] ? {ask_q[1], 1'b0} : 2'b00;
      if (data_valid_i) got_context_q <= 1'b1;
    end
  end

  // ---- what they say ----
  puc_pkg::job_t job_q;
  logic          context_good_q, context_judge_q, check_good;
  logic [63:0]   check_q;
  logic [31:0]   source_lines_q;   // that Src has
  harpoon_contract_pkg::format_e format_q;

  assign job_o      = job_q;
  assign check_good = check_q == (harpoon_contract_pkg::CHECK_SEED ^ fold_i);
  always_ff @(posedge clk_i) begin
    context_judge_q <= take_context;
    if (context_judge_q) context_good_q <= check_good;
    if (take) check_q <= data_view.check;
    if (take_context) begin
      job_q.source_line  <= context_view.source.line;
      job_q.dest_line    <= context_view.dest.line;
      job_q.spheres_line <= context_view.spheres.line;
      source_lines_q     <= context_view.source_lines;
      job_q.dest_lines   <= context_view.dest_lines;
      job_q.sphere_count <= context_view.sphere_count;
    end
    if (take_control) begin
      go_o                <= control_view.start == harpoon_contract_pkg::CONTROL_GO;
      forget_o            <= control_view.reset == harpoon_contract_pkg::CONTROL_GO;
      format_q            <= control_view.format;
      job_q.pair_count    <= control_view.pair_count;
      job_q.sequence_word <= control_view.sequence_word;
      job_q.load_table    <= control_view.load_table.load;
    end
  end

  // ---- what follows ----
  // | format              | front end | pairs a line | records           |
  // | direct              | direct    |       2      | of every pair     |
  // | direct, hits only   | direct    |       2      | of hits, numbered |
  // | indexed, hits only  | indexed   |      16      | of hits, numbered |
  logic        indexed, load;
  logic [31:0] pairs, spheres, source_lines;
  assign pairs        = job_q.pair_count;
  assign spheres      = job_q.sphere_count;
  assign indexed      = format_q == harpoon_contract_pkg::FORMAT_INDEXED_HITS;
  assign load         = indexed & job_q.load_table;
  assign source_lines = indexed ? {4'd0, pairs[31:4]} + 32'(pairs[3:0] != '0)
                                : {1'b0, pairs[31:1]} + 32'(pairs[0]);
  always_comb begin
    plan_o.indexed      = indexed;
    plan_o.hits_only    = format_q != harpoon_contract_pkg::FORMAT_DIRECT;
    plan_o.source_lines = source_lines;
    plan_o.table_lines  = load ? {2'd0, spheres[31:2]} + 32'(spheres[1:0] != '0) : '0;

    if (!context_good_q) verdict_o = harpoon_contract_pkg::ERROR_BAD_CONTEXT;
    else if (!check_good) verdict_o = harpoon_contract_pkg::ERROR_BAD_CONTROL;
    else if (format_q >= harpoon_contract_pkg::FORMAT_COUNT)
      verdict_o = harpoon_contract_pkg::ERROR_BAD_FORMAT;
    else if (source_lines > source_lines_q)
      verdict_o = harpoon_contract_pkg::ERROR_SOURCE_TOO_SHORT;
    else if (load & (spheres > Spheres))
      verdict_o = harpoon_contract_pkg::ERROR_TOO_MANY_SPHERES;
    else verdict_o = harpoon_contract_pkg::ERROR_NONE;
  end
endmodule
