// What the binary32 cells share: the NaN they emit.
// Number format of all cells: IEEE-754 binary32, round to nearest even, subnormals kept, no flags.
// A NaN is a class: any NaN in is accepted, QuietNan comes out.
package fp32_pkg;
  localparam logic [31:0] QuietNan = 32'h7fc0_0000;
endpackage
