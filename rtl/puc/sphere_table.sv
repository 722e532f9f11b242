// The sphere table: Spheres records {r, z, y, x} in on-chip RAM, four written a cycle, Ports read.
//
// A read takes two cycles: row, then one of the four spheres of the row; `enable_i` low holds a
// port's stages. Reading beyond what was written gives any value. The store keeps its content over
// reset. Spheres is a power of two.
module sphere_table #(
  parameter int unsigned Spheres = 16384,
  parameter int unsigned Ports   = 20
) (
  input  logic                            clk_i,
  input  logic                            write_i,
  input  logic [$clog2(Spheres)-3:0]      write_row_i,
  input  logic [511:0]                    write_data_i,
  input  logic [Ports-1:0]                enable_i,
  input  logic [Ports*$clog2(Spheres)-1:0] index_i,
  output logic [Ports*128-1:0]            sphere_o
);
  if (Spheres < 8 || Spheres > 65536 || 1 << $clog2(Spheres) != Spheres)
    $error("sphere_table: Spheres must be a power of two, 8 to 65536");
  if (Ports < 1)
    $error("sphere_table: Ports must be at least 1");

  localparam int unsigned W    = (Spheres > 4) ? $clog2(Spheres) : 3;
  localparam int unsigned ROWS = Spheres / 4;

  logic [511:0] mem_q [0:ROWS-1];

  always_ff @(posedge clk_i) begin
    if (write_i) mem_q[write_row_i] <= write_data_i;
  end

  for (genvar g = 0; g < Ports; g++) begin : gen_port
    logic [W-1:0]   index;
    logic [511:0]   row_q;
    logic [1:0]     part_q;
    logic [127:0]   sphere_q;
    assign index = index_i[g*W +: W];
    assign sphere_o[g*128 +: 128] = sphere_q;
    always_ff @(posedge clk_i) begin
      if (enable_i[g]) begin
        row_q    <= mem_q[index[W-1:2]];
        part_q   <= index[1:0];
        sphere_q <= row_q[{part_q, 7'd0} +: 128];
      end
    end
  end
endmodule
