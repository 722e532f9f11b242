// Properties of front_direct: its stream keeps the contract of puc_pkg, for lines that are numbered
// as is proven of source_numbers and that come before `lines_done_i`.
  always_comb begin
    assume (source_i.count == 5'd1 || source_i.count == 5'd2);
    if (lines_done_i) assume (!valid_i);

    if (valid_o) direct_empty_is_last: assert (beat_o.mask != 2'b00 || beat_o.last);
    if (valid_i) direct_passes: assert (valid_o && beat_o.last == source_i.last
                                        && beat_o.mask == {source_i.count == 5'd2, 1'b1}
                                        && beat_o.tags.first == source_i.number);
    if (!valid_i) direct_ends: assert (valid_o == (open_i && lines_done_i));
  end
