// Delays a word by a fixed number of cycles; balances the paths of a pipeline.
//
// Handshake: none, a new word every cycle. Latency: `Latency` cycles.
// Short lines are flip-flops (shift-register LUTs where the target has them); from RamMin cycles on
// the words stay where they are in a circular buffer with one write and one read port.
// Reset (synchronous, active low) sets the buffer's pointer only; what leaves in the first Latency
// cycles after power-up is undefined.
// Legal: Width >= 1, Latency >= 1, RamMin >= 2.
module delay_line #(
  parameter int unsigned Width   = 32,
  parameter int unsigned Latency = 8,
  parameter int unsigned RamMin  = 12
) (
  input  logic             clk_i,
  input  logic             rst_ni,
  input  logic [Width-1:0] d_i,
  output logic [Width-1:0] q_o
);
  if (Width < 1)
    $error("delay_line: Width must be at least 1");
  if (Latency < 1)
    $error("delay_line: Latency must be at least 1");
  if (RamMin < 2)
    $error("delay_line: RamMin must be at least 2");

  if (Latency <= 1) begin : gen_one
    logic unused_rst;
    assign unused_rst = rst_ni;
    always_ff @(posedge clk_i) q_o <= d_i;
  end else if (Latency < RamMin) begin : gen_flops
    logic             unused_rst;
    logic [Width-1:0] line_q [Latency];
    assign unused_rst = rst_ni;
    always_ff @(posedge clk_i) line_q[0] <= d_i;
    for (genvar i = 1; i < Latency; i++) begin : gen_place
      always_ff @(posedge clk_i) line_q[i] <= line_q[i-1];
    end
    assign q_o = line_q[Latency-1];
  end else begin : gen_ram
    localparam int unsigned AddrWidth = $clog2(Latency);
    logic [AddrWidth-1:0] write_q, read;
    logic [Width-1:0]     ram_q [1 << AddrWidth];
    // a word written at edge t is read, into a register, at edge t + Latency - 1
    assign read = write_q - AddrWidth'(Latency - 1);
    always_ff @(posedge clk_i) begin
      if (!rst_ni) write_q <= '0;
      else         write_q <= write_q + AddrWidth'(1);
    end
    always_ff @(posedge clk_i) begin
      ram_q[write_q] <= d_i;
      q_o            <= ram_q[read];
    end
  end
endmodule
