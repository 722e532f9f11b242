// The page table of SPL2: up to MaxPages entries of 2 MB in RAM, with one lookup port for reads and
// one for writes.
//
// A lookup takes one cycle; its result is held while `*_enable_i` is low. It is good (`*_ok_o`)
// when the request is physical (SPL2's own, never translated) or when its page lies inside the
// workspace and has a valid entry. Line addresses count lines of 64 bytes: 15 bits of line, 43 bits
// of page. MaxPages is a power of two.
module spl2_page_table #(
  parameter int unsigned MaxPages = 1024
) (
  input  logic                        clk_i,
  input  logic [42:0]                 base_page_i,   // first virtual page of the workspace
  input  logic [$clog2(MaxPages):0]   page_count_i,  // entries that are valid; 0: none

  input  logic                        store_i,
  input  logic [$clog2(MaxPages)-1:0] store_index_i,
  input  logic                        store_valid_i,
  input  logic [42:0]                 store_page_i,

  input  logic                        read_enable_i,
  input  logic                        read_physical_i,
  input  logic [57:0]                 read_line_i,
  output logic                        read_ok_o,
  output logic [57:0]                 read_line_o,

  input  logic                        write_enable_i,
  input  logic                        write_physical_i,
  input  logic [57:0]                 write_line_i,
  output logic                        write_ok_o,
  output logic [57:0]                 write_line_o
);
  if (MaxPages < 2 || MaxPages > 1024 || 1 << $clog2(MaxPages) != MaxPages)
    $error("spl2_page_table: MaxPages must be a power of two, 2 to 1024");

  localparam int unsigned IDX = $clog2(MaxPages);

  logic [43:0] mem_q [0:MaxPages-1];  // valid, physical page

  logic [42:0] read_index, write_index;
  logic [43:0] read_entry_q, write_entry_q;
  logic        read_inside_q, write_inside_q, read_physical_q, write_physical_q;
  logic [57:0] read_line_q, write_line_q;

  assign read_index  = read_line_i[57:15] - base_page_i;
  assign write_index = write_line_i[57:15] - base_page_i;

  always_ff @(posedge clk_i) begin
    if (store_i) mem_q[store_index_i] <= {store_valid_i, store_page_i};
    if (read_enable_i) begin
      read_entry_q    <= mem_q[read_index[IDX-1:0]];
      read_inside_q   <= read_index < {{(42-IDX){1'b0}}, page_count_i};
      read_physical_q <= read_physical_i;
      read_line_q     <= read_line_i;
    end
    if (write_enable_i) begin
      write_entry_q    <= mem_q[write_index[IDX-1:0]];
      write_inside_q   <= write_index < {{(42-IDX){1'b0}}, page_count_i};
      write_physical_q <= write_physical_i;
      write_line_q     <= write_line_i;
    end
  end

  assign read_ok_o    = read_physical_q | (read_inside_q & read_entry_q[43]);
  assign read_line_o  = read_physical_q ? read_line_q : {read_entry_q[42:0], read_line_q[14:0]};
  assign write_ok_o   = write_physical_q | (write_inside_q & write_entry_q[43]);
  assign write_line_o = write_physical_q ? write_line_q : {write_entry_q[42:0], write_line_q[14:0]};
`ifdef FORMAL
  `include "spl2_page_table.svh"
`endif
endmodule
