// What a transaction is measured by: cycles from the start signal on, stalls, lines, and digests of
// what came and what went.
//
// All start at 0 after reset; the digests start anew with `start_i` and cover a line two cycles
// after it was taken or sent. Each input is counted in every cycle in which it is high.
module puc_counters (
  input  logic               clk_i,
  input  logic               rst_ni,
  input  logic               start_i,
  input  logic               running_i,
  input  logic               waiting_i,       // SPL2 is at work, the run has not begun
  input  logic               settled_i,       // last in the cycle of the last acknowledged result
  input  logic               read_stall_i,
  input  logic               write_stall_i,
  input  logic               line_taken_i,
  input  logic [511:0]       line_i,
  input  logic               line_sent_i,
  input  logic [511:0]       sent_line_i,
  input  logic               no_line_sent_i,  // before this one
  output puc_pkg::counters_t counters_o,
  output puc_pkg::digests_t  digests_o
);
  puc_pkg::counters_t counters_q;
  assign counters_o = counters_q;

  line_digest u_source_digest (
    .clk_i, .rst_ni, .clear_i(start_i), .valid_i(line_taken_i), .line_i(line_i),
    .digest_o(digests_o.source)
  );
  line_digest u_dest_digest (
    .clk_i, .rst_ni, .clear_i(start_i), .valid_i(line_sent_i), .line_i(sent_line_i),
    .digest_o(digests_o.dest)
  );

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      counters_q <= '0;
    end else begin
      if (waiting_i) counters_q.spl2_cycles <= counters_q.spl2_cycles + 32'd1;
      if (running_i) counters_q.cycles <= counters_q.cycles + 32'd1;
      if (line_taken_i) begin
        counters_q.lines_read <= counters_q.lines_read + 32'd1;
        if (counters_q.lines_read == '0) counters_q.first_line <= counters_q.cycles;
      end
      if (line_sent_i & no_line_sent_i) counters_q.first_write <= counters_q.cycles;
      if (settled_i) counters_q.last_write <= counters_q.cycles;
      if (read_stall_i) counters_q.read_stalls <= counters_q.read_stalls + 32'd1;
      if (write_stall_i) counters_q.write_stalls <= counters_q.write_stalls + 32'd1;
    end
  end
endmodule
