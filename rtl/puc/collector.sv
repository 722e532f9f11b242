// The collector: fetches the sphere array (if any) and then Src, as fast as SPL2 accepts requests,
// and hands on the lines in order: spheres to the table, the rest to the consumer.
//
// `start_i` (one cycle) takes the addresses and counts. Lines return in request order and each is
// handed on exactly once. With `barrier_i` only `batch_lines_i` lines of Src are requested at a
// time; the next batch waits until all of them were consumed and `drained_i` says that their
// results have been dispatched: the published behaviour. `done_o`: all lines were consumed.
module collector #(
  parameter int unsigned CountWidth = 32
) (
  input  logic         clk_i,
  input  logic         rst_ni,
  input  logic         start_i,
  input  logic [57:0]  table_line_i,
  input  logic [CountWidth-1:0] table_lines_i,
  input  logic [57:0]  source_line_i,
  input  logic [CountWidth-1:0] source_lines_i,
  input  logic         barrier_i,
  input  logic [CountWidth-1:0] batch_lines_i,
  input  logic         drained_i,

  output logic         read_valid_o,
  input  logic         read_ready_i,
  output logic [57:0]  read_line_o,
  input  logic         data_valid_i,
  output logic         data_ready_o,
  input  logic [511:0] data_i,

  output logic         table_valid_o,
  output logic [511:0] table_data_o,
  output logic         source_valid_o,
  input  logic         source_ready_i,
  output logic [511:0] source_data_o,
  output logic         done_o
);
  if (CountWidth < 1 || CountWidth > 32)
    $error("collector: CountWidth must be 1 to 32");

  logic [57:0] next_q;
  logic [CountWidth-1:0] table_ask_q, source_ask_q, table_get_q, source_get_q, batch_left_q;
  logic        asked, got_source, batch_open;

  // asked but not yet requested; got but not yet consumed
  assign batch_open     = ~barrier_i | (batch_left_q != '0) | (table_ask_q != '0);
  assign read_valid_o   = ((table_ask_q != '0) | (source_ask_q != '0)) & batch_open;
  assign read_line_o    = next_q;
  assign asked          = read_valid_o & read_ready_i;
  assign table_valid_o  = data_valid_i & (table_get_q != '0);
  assign table_data_o   = data_i;
  assign source_valid_o = data_valid_i & (table_get_q == '0) & (source_get_q != '0);
  assign source_data_o  = data_i;
  assign data_ready_o   = table_valid_o | (source_valid_o & source_ready_i);
  assign got_source     = source_valid_o & source_ready_i;
  assign done_o         = (table_get_q == '0) & (source_get_q == '0);

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      table_ask_q  <= '0;
      source_ask_q <= '0;
      table_get_q  <= '0;
      source_get_q <= '0;
      batch_left_q <= '0;
      next_q       <= '0;
    end else if (start_i) begin
      table_ask_q  <= table_lines_i;
      table_get_q  <= table_lines_i;
      source_ask_q <= source_lines_i;
      source_get_q <= source_lines_i;
      batch_left_q <= batch_lines_i;
      next_q       <= (table_lines_i != '0) ? table_line_i : source_line_i;
    end else begin
      if (asked) begin
        next_q <= (table_ask_q == CountWidth'(1)) ? source_line_i : next_q + 58'd1;
        if (table_ask_q != '0) begin
          table_ask_q <= table_ask_q - CountWidth'(1);
        end else begin
          source_ask_q <= source_ask_q - CountWidth'(1);
          batch_left_q <= batch_left_q - CountWidth'(1);
        end
      end else if (barrier_i & (batch_left_q == '0) & (source_ask_q == source_get_q)
                   & drained_i) begin
        batch_left_q <= batch_lines_i;
      end
      if (table_valid_o) table_get_q <= table_get_q - CountWidth'(1);
      if (got_source) source_get_q <= source_get_q - CountWidth'(1);
    end
  end
`ifdef FORMAL
  `include "collector.svh"
`endif
endmodule
