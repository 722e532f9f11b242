// Sphere collision processing unit: one pair record in, one contact record out, every cycle.
//
// The arithmetic is sphere_sphere, generated from the C++ collider; this module packs and unpacks
// the records of records.hpp, first field in the low word:
//   pair_i    [ p1.x p1.y p1.z r1 p2.x p2.y p2.z r2 ]
//   contact_o [ pos.xyz normal.xyz depth flow ]
// | hit | grazing | flow      | numbers                                   |
// |  0  |    x    | 1 fake    | +0                                        |
// |  1  |    1    | 2 grazing | pos p1, normal (1, 0, 0), depth r1 + r2   |
// |  1  |    0    | 3 real    | the contact                               |
//
// Handshake: valid only, no back-pressure; valid_o is valid_i and contact_o belongs to pair_i, both
// scpu_pkg::Latency cycles ago. Throughput: one pair a cycle.
// Number format: binary32, nearest even, subnormals kept; every NaN is 0x7fc00000 except one that
// was passed through from the pair.
// Reset (synchronous, active low): no record is valid; records under way are dropped.
// No parameters.
module scpu (
  input  logic         clk_i,
  input  logic         rst_ni,
  input  logic         valid_i,
  input  logic [255:0] pair_i,
  output logic         valid_o,
  output logic [255:0] contact_o
);
  logic [31:0] pos_x, pos_y, pos_z, normal_x, normal_y, normal_z, depth;
  logic        hit, grazing;
  sphere_sphere u_sphere_sphere (
    .clk_i, .rst_ni,
    .p1_x_i(pair_i[31:0]), .p1_y_i(pair_i[63:32]), .p1_z_i(pair_i[95:64]), .r1_i(pair_i[127:96]),
    .p2_x_i(pair_i[159:128]), .p2_y_i(pair_i[191:160]), .p2_z_i(pair_i[223:192]),
    .r2_i(pair_i[255:224]),
    .pos_x_o(pos_x), .pos_y_o(pos_y), .pos_z_o(pos_z),
    .normal_x_o(normal_x), .normal_y_o(normal_y), .normal_z_o(normal_z),
    .depth_o(depth), .hit_o(hit), .grazing_o(grazing)
  );

  localparam logic [31:0] FlowFake    = 32'd1;
  localparam logic [31:0] FlowGrazing = 32'd2;
  localparam logic [31:0] FlowReal    = 32'd3;
  always_ff @(posedge clk_i) begin
    if (hit) begin
      contact_o <= {grazing ? FlowGrazing : FlowReal, depth, normal_z, normal_y, normal_x,
                    pos_z, pos_y, pos_x};
    end else begin
      contact_o <= {FlowFake, 224'd0};
    end
  end

  logic [scpu_pkg::Latency-1:0] valid_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) valid_q <= '0;
    else         valid_q <= {valid_q[scpu_pkg::Latency-2:0], valid_i};
  end
  assign valid_o = valid_q[scpu_pkg::Latency-1];
endmodule
