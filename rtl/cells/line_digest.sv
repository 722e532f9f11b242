// Digest of a sequence of lines: digest = rotl(digest, 1) + line_fold(line), from 0.
//
// `digest_o` covers a line two cycles after its `valid_i`. `clear_i` starts anew.
module line_digest (
  input  logic         clk_i,
  input  logic         rst_ni,
  input  logic         clear_i,
  input  logic         valid_i,
  input  logic [511:0] line_i,
  output logic [63:0]  digest_o
);
  logic [63:0] digest_q, fold;
  logic        fold_valid_q;

  line_fold u_fold (
    .clk_i, .valid_i, .line_i, .or_valid_i(1'b0), .or_line_i('0), .fold_o(fold)
  );

  assign digest_o = digest_q;

  always_ff @(posedge clk_i) begin
    if (!rst_ni || clear_i) begin
      digest_q     <= '0;
      fold_valid_q <= 1'b0;
    end else begin
      fold_valid_q <= valid_i;
      if (fold_valid_q) digest_q <= {digest_q[62:0], digest_q[63]} + fold;
    end
  end
endmodule
