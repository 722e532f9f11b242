// The 64-bit fold of a line (contract: line_fold), one cycle after `valid_i`; held until the next.
//
// Every input bit flips three output bits, no two bits the same three: up to three wrong bits of a
// line always change its fold. Used for check words and for digests.
module line_fold (
  input  logic         clk_i,
  input  logic         valid_i,
  input  logic [511:0] line_i,
  output logic [63:0]  fold_o
);
  logic [63:0] fold_q;

  assign fold_o = fold_q;

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      fold_q <= line_i[63:0]
              ^ {line_i[62:0], line_i[63:63]}
              ^ {line_i[43:0], line_i[63:44]}
              ^ line_i[127:64]
              ^ {line_i[125:64], line_i[127:126]}
              ^ {line_i[105:64], line_i[127:106]}
              ^ line_i[191:128]
              ^ {line_i[188:128], line_i[191:189]}
              ^ {line_i[167:128], line_i[191:168]}
              ^ line_i[255:192]
              ^ {line_i[251:192], line_i[255:252]}
              ^ {line_i[229:192], line_i[255:230]}
              ^ line_i[319:256]
              ^ {line_i[314:256], line_i[319:315]}
              ^ {line_i[291:256], line_i[319:292]}
              ^ line_i[383:320]
              ^ {line_i[377:320], line_i[383:378]}
              ^ {line_i[353:320], line_i[383:354]}
              ^ line_i[447:384]
              ^ {line_i[440:384], line_i[447:441]}
              ^ {line_i[415:384], line_i[447:416]}
              ^ line_i[511:448]
              ^ {line_i[503:448], line_i[511:504]}
              ^ {line_i[477:448], line_i[511:478]};
    end
  end
endmodule
