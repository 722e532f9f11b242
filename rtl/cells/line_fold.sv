// The 64-bit fold of a line (contract: line_fold): of `line_i` one cycle after `valid_i`, or else
// of `or_line_i` one cycle after `or_valid_i`; held until the next.
//
// Every input bit flips three output bits, no two bits the same three: up to three wrong bits of a
// line always change its fold. Used for check words and for digests.
module line_fold (
  input  logic         clk_i,
  input  logic         valid_i,
  input  logic [511:0] line_i,
  input  logic         or_valid_i,
  input  logic [511:0] or_line_i,
  output logic [63:0]  fold_o
);
  logic [63:0] fold_q;

  assign fold_o = fold_q;

  always_ff @(posedge clk_i) begin
    if (valid_i | or_valid_i) begin
      logic [511:0] line;
      line = valid_i ? line_i : or_line_i;
      fold_q <= line[63:0]
              ^ {line[62:0], line[63:63]}
              ^ {line[43:0], line[63:44]}
              ^ line[127:64]
              ^ {line[125:64], line[127:126]}
              ^ {line[105:64], line[127:106]}
              ^ line[191:128]
              ^ {line[188:128], line[191:189]}
              ^ {line[167:128], line[191:168]}
              ^ line[255:192]
              ^ {line[251:192], line[255:252]}
              ^ {line[229:192], line[255:230]}
              ^ line[319:256]
              ^ {line[314:256], line[319:315]}
              ^ {line[291:256], line[319:292]}
              ^ line[383:320]
              ^ {line[377:320], line[383:378]}
              ^ {line[353:320], line[383:354]}
              ^ line[447:384]
              ^ {line[440:384], line[447:441]}
              ^ {line[415:384], line[447:416]}
              ^ line[511:448]
              ^ {line[503:448], line[511:504]}
              ^ {line[477:448], line[511:478]};
    end
  end
endmodule
