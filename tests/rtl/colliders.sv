// The generated colliders that the AFU does not use, side by side for the tests. sphere_plane takes
// the first eight words, aabb_overlap all twelve. No handshake; each output has its own latency.
module colliders (
  input  logic         clk_i,
  input  logic         rst_ni,
  input  logic [383:0] words_i,
  output logic [223:0] plane_o,
  output logic         plane_hit_o,
  output logic         overlap_o
);
  sphere_plane u_sphere_plane (
    .clk_i, .rst_ni,
    .p_x_i(words_i[31:0]), .p_y_i(words_i[63:32]), .p_z_i(words_i[95:64]), .r_i(words_i[127:96]),
    .n_x_i(words_i[159:128]), .n_y_i(words_i[191:160]), .n_z_i(words_i[223:192]),
    .offset_i(words_i[255:224]),
    .pos_x_o(plane_o[31:0]), .pos_y_o(plane_o[63:32]), .pos_z_o(plane_o[95:64]),
    .normal_x_o(plane_o[127:96]), .normal_y_o(plane_o[159:128]), .normal_z_o(plane_o[191:160]),
    .depth_o(plane_o[223:192]), .hit_o(plane_hit_o)
  );
  aabb_overlap u_aabb_overlap (
    .clk_i, .rst_ni,
    .a_min_x_i(words_i[31:0]), .a_min_y_i(words_i[63:32]), .a_min_z_i(words_i[95:64]),
    .a_max_x_i(words_i[127:96]), .a_max_y_i(words_i[159:128]), .a_max_z_i(words_i[191:160]),
    .b_min_x_i(words_i[223:192]), .b_min_y_i(words_i[255:224]), .b_min_z_i(words_i[287:256]),
    .b_max_x_i(words_i[319:288]), .b_max_y_i(words_i[351:320]), .b_max_z_i(words_i[383:352]),
    .overlap_o
  );
endmodule
