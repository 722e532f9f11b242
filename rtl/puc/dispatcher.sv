// The dispatcher: packs results two a line and writes the lines to Dst, in the order they came.
//
// | hits_only_i | kept            | word 7 of a record                        |
// |      0      | every result    | flow, as the SCPU said                    |
// |      1      | flow 2 and 3    | pair number (30:0), grazing mark (bit 31) |
//
// `flush_i` (one cycle, while `idle_o`) writes a last odd record, its neighbour zero. Lines beyond
// `dest_lines_i` are not written, but hits are still counted. `start_i` begins a transaction.
module dispatcher (
  input  logic         clk_i,
  input  logic         rst_ni,
  input  logic         start_i,
  input  logic         flush_i,
  input  logic         hits_only_i,
  input  logic [57:0]  dest_line_i,
  input  logic [31:0]  dest_lines_i,

  input  logic         valid_i,
  output logic         ready_o,
  input  puc_pkg::result_t result_i,
  input  harpoon_contract_pkg::contact_line_t contacts_i,

  output logic         write_valid_o,
  input  logic         write_ready_i,
  output logic [57:0]  write_line_o,
  output logic [511:0] write_data_o,

  output logic         idle_o,
  output puc_pkg::results_t results_o
);
  // ---- the one or two records of a beat that are kept ----
  logic         take;
  logic [1:0]   hit, keep;
  logic [255:0] record [0:1];

  harpoon_contract_pkg::hit_t first_record, second_record;
  always_comb begin
    first_record  = contacts_i.first;
    second_record = contacts_i.second;
    if (hits_only_i) begin
      first_record.hit.number   = result_i.tags.first;
      first_record.hit.grazing  = contacts_i.first.flow == harpoon_contract_pkg::FLOW_GRAZING;
      second_record.hit.number  = result_i.tags.second;
      second_record.hit.grazing = contacts_i.second.flow == harpoon_contract_pkg::FLOW_GRAZING;
    end
  end
  assign hit[0]    = result_i.mask[0] & (contacts_i.first.flow != harpoon_contract_pkg::FLOW_FAKE);
  assign hit[1]    = result_i.mask[1] & (contacts_i.second.flow != harpoon_contract_pkg::FLOW_FAKE);
  assign keep      = hits_only_i ? hit : result_i.mask;
  assign record[0] = first_record;
  assign record[1] = second_record;

  // ---- pairing: a record may wait for its neighbour ----
  // | held | kept | line out          | held then |
  // |  no  |  0   | -                 | no        |
  // |  no  |  1   | -                 | the one   |
  // |  no  |  2   | second, first     | no        |
  // |  yes |  0   | -                 | yes       |
  // |  yes |  1   | the one, held     | no        |
  // |  yes |  2   | first, held       | second    |
  logic         held_q, out_valid_q, out_free, emit, full;
  logic [255:0] held_data_q, first;
  logic [511:0] out_q;
  logic [31:0]  lines_q, hits_q, pairs_q, emitted_q;

  assign first    = keep[0] ? record[0] : record[1];
  assign out_free = ~out_valid_q | write_ready_i;
  assign ready_o  = out_free;
  assign take     = valid_i & ready_o;
  assign emit     = (take & ((held_q & (keep != 2'b00)) | (&keep))) | (flush_i & held_q);
  assign full     = emitted_q == dest_lines_i;

  assign write_valid_o = out_valid_q;
  assign write_line_o  = dest_line_i + {26'd0, lines_q};
  assign write_data_o  = out_q;
  assign idle_o        = ~out_valid_q & ~valid_i;
  always_comb begin
    results_o.lines = lines_q;
    results_o.hits  = hits_q;
    results_o.pairs = pairs_q;
  end

  always_ff @(posedge clk_i) begin
    if (!rst_ni || start_i) begin
      held_q      <= 1'b0;
      out_valid_q <= 1'b0;
      lines_q     <= '0;
      hits_q      <= '0;
      pairs_q     <= '0;
      emitted_q   <= '0;
    end else begin
      if (take) begin
        hits_q  <= hits_q + 32'(hit[0]) + 32'(hit[1]);
        pairs_q <= pairs_q + 32'(result_i.mask[0]) + 32'(result_i.mask[1]);
        if (keep != 2'b00) held_q <= held_q ? (&keep) : ~(&keep);
      end
      if (flush_i) held_q <= 1'b0;
      if (emit & ~full) begin
        out_valid_q <= 1'b1;
        emitted_q   <= emitted_q + 32'd1;
      end else if (write_ready_i) begin
        out_valid_q <= 1'b0;
      end
      if (out_valid_q & write_ready_i) lines_q <= lines_q + 32'd1;
    end
    if (take & (keep != 2'b00)) held_data_q <= (held_q & (&keep)) ? record[1] : first;
    if (emit) begin
      out_q <= flush_i ? {256'd0, held_data_q}
             : held_q  ? {first, held_data_q} : {record[1], record[0]};
    end
  end
`ifdef FORMAL
  `include "dispatcher.svh"
`endif
endmodule
