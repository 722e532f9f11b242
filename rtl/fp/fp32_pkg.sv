// What the binary32 cells share: the NaN they emit and leading-zero counts.
// Number format of all cells: IEEE-754 binary32, round to nearest even, subnormals kept, no flags.
// A NaN is a class: any NaN in is accepted, QuietNan comes out.
package fp32_pkg;
  localparam logic [31:0] QuietNan = 32'h7fc0_0000;

  // Zeros above the first set bit, by halving, so that the depth is logarithmic in every tool.
  // All zero gives 31.
  function automatic logic [4:0] leading_zeros31(input logic [31:1] x);
    logic [15:1] x16;
    logic [7:1]  x8;
    logic [3:1]  x4;
    logic [4:0]  n;
    n[4] = (x[31:16] == 16'd0);
    x16  = n[4] ? x[15:1] : x[31:17];
    n[3] = (x16[15:8] == 8'd0);
    x8   = n[3] ? x16[7:1] : x16[15:9];
    n[2] = (x8[7:4] == 4'd0);
    x4   = n[2] ? x8[3:1] : x8[7:5];
    n[1] = (x4[3:2] == 2'd0);
    n[0] = n[1] ? ~x4[1] : ~x4[3];
    leading_zeros31 = n;
  endfunction
endpackage
