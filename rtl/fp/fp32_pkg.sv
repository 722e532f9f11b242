// What the binary32 cells share: the NaN they emit and leading-zero counts.
// Number format of all cells: IEEE-754 binary32, round to nearest even, subnormals kept, no flags.
// A NaN is a class: any NaN in is accepted, QuietNan comes out.
package fp32_pkg;
  localparam logic [31:0] QuietNan = 32'h7fc0_0000;

  // Zeros above the first set bit, by nibbles: three or four levels of six-input tables.
  // All zero gives 31.
  function automatic logic [4:0] leading_zeros32(input logic [31:0] x);
    logic [6:0] some;  // nibble i, counted from the top, has a set bit
    logic [7:0] low0, low1;  // bits of the count inside nibble i
    logic [2:0] first;
    for (int i = 0; i < 8; i++) begin
      low1[i] = ~(x[31 - 4 * i] | x[30 - 4 * i]);
      low0[i] = ~x[31 - 4 * i] & (x[30 - 4 * i] | ~x[29 - 4 * i]);
    end
    for (int i = 0; i < 7; i++) some[i] = |x[28 - 4 * i +: 4];
    first[2] = ~(|some[3:0]);
    first[1] = ~(|some[1:0]) & ((|some[3:2]) | ~(|some[5:4]));
    first[0] = ~some[0] & (some[1] | (~some[2] & (some[3] | (~some[4] & (some[5] | ~some[6])))));
    leading_zeros32 = {first, low1[first], low0[first]};
  endfunction
endpackage
