// First-in first-out queue with a registered output, so that the store maps to block RAM.
//
// Ready/valid on both sides; an item leaves two cycles after it entered at the earliest; one item
// per cycle. Holds Depth items in RAM and one in the output register. `valid_o` and `data_o` are
// stable until `ready_i`. Reset (synchronous) empties it. Depth is a power of two, at least 2.
module fifo #(
  parameter int unsigned Width = 8,
  parameter int unsigned Depth = 4
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic             valid_i,
  output logic             ready_o,
  input  logic [Width-1:0] data_i,
  output logic             valid_o,
  input  logic             ready_i,
  output logic [Width-1:0] data_o,
  output logic             empty_o
);
  if (Width < 1)
    $error("fifo: Width must be at least 1");
  if (Depth < 2 || 1 << $clog2(Depth) != Depth)
    $error("fifo: Depth must be a power of two, at least 2");

  localparam int unsigned PTR = $clog2(Depth);

  logic [Width-1:0] mem_q [0:Depth-1];
  logic [PTR:0]     write_q, read_q;
  logic [Width-1:0] out_q;
  logic             out_valid_q;
  logic             push, pop;

  assign ready_o = (write_q - read_q) != (PTR+1)'(Depth);
  assign push    = valid_i & ready_o;
  assign pop     = (write_q != read_q) & (~out_valid_q | ready_i);
  assign valid_o = out_valid_q;
  assign data_o  = out_q;
  assign empty_o = (write_q == read_q) & ~out_valid_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      write_q     <= '0;
      read_q      <= '0;
      out_valid_q <= 1'b0;
    end else begin
      if (push) write_q <= write_q + (PTR+1)'(1);
      if (pop) begin
        read_q      <= read_q + (PTR+1)'(1);
        out_valid_q <= 1'b1;
      end else if (ready_i) begin
        out_valid_q <= 1'b0;
      end
    end
    if (push) mem_q[write_q[PTR-1:0]] <= data_i;
    if (pop) out_q <= mem_q[read_q[PTR-1:0]];
  end
`ifdef FORMAL
  `include "fifo.svh"
`endif
endmodule
