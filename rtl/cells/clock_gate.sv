// Clock gate: `clk_o` pulses in the cycles whose rising edge sees `enable_i` high.
//
// `enable_i` must come from flops of `clk_i` (through logic). Latch and AND; on an FPGA map it to
// the clock buffer with enable (BUFGCE, or ALTCLKCTRL), on an ASIC to the library's gate.
module clock_gate (
  input  logic clk_i,
  input  logic enable_i,
  output logic clk_o
);
  logic enable_q;
  always_latch begin
    if (!clk_i) enable_q = enable_i;
  end
  assign clk_o = clk_i & enable_q;
endmodule
