// Zeros above the first set bit of x_i, or 0 with clear_i.
//
// Handshake: none, one result every cycle. Latency: 1 cycle. All zero gives 31.
// Reset: none needed. No parameters. By halving, so that the depth is logarithmic in every tool.
module leading_zeros31 (
  input  logic        clk_i,
  input  logic        clear_i,
  input  logic [31:1] x_i,
  output logic [4:0]  n_o
);
  always_ff @(posedge clk_i) begin
    if (clear_i) begin
      n_o <= '0;
    end else begin
      logic        n4, n3, n2, n1;
      logic [15:1] x16;
      logic [7:1]  x8;
      logic [3:1]  x4;
      n4  = (x_i[31:16] == 16'd0);
      x16 = n4 ? x_i[15:1] : x_i[31:17];
      n3  = (x16[15:8] == 8'd0);
      x8  = n3 ? x16[7:1] : x16[15:9];
      n2  = (x8[7:4] == 4'd0);
      x4  = n2 ? x8[3:1] : x8[7:5];
      n1  = (x4[3:2] == 2'd0);
      n_o <= {n4, n3, n2, n1, n1 ? ~x4[1] : ~x4[3]};
    end
  end
endmodule
