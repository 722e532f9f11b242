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
  input  logic                           clk_i,
  input  logic                           rst_ni,
  input  logic                           valid_i,
  input  harpoon_contract_pkg::pair_t    pair_i,
  output logic                           valid_o,
  output harpoon_contract_pkg::contact_t contact_o
);
  logic [31:0] pos_x, pos_y, pos_z, normal_x, normal_y, normal_z, depth;
  logic        hit, grazing;
  sphere_sphere u_sphere_sphere (
    .clk_i, .rst_ni,
    .p1_x_i(pair_i.p1.x), .p1_y_i(pair_i.p1.y), .p1_z_i(pair_i.p1.z), .r1_i(pair_i.p1.r),
    .p2_x_i(pair_i.p2.x), .p2_y_i(pair_i.p2.y), .p2_z_i(pair_i.p2.z), .r2_i(pair_i.p2.r),
    .pos_x_o(pos_x), .pos_y_o(pos_y), .pos_z_o(pos_z),
    .normal_x_o(normal_x), .normal_y_o(normal_y), .normal_z_o(normal_z),
    .depth_o(depth), .hit_o(hit), .grazing_o(grazing)
  );

  always_ff @(posedge clk_i) begin
    if (hit) begin
      contact_o.pos_x    <= pos_x;
      contact_o.pos_y    <= pos_y;
      contact_o.pos_z    <= pos_z;
      contact_o.normal_x <= normal_x;
      contact_o.normal_y <= normal_y;
      contact_o.normal_z <= normal_z;
      contact_o.depth    <= depth;
      contact_o.flow     <= grazing ? harpoon_contract_pkg::FLOW_GRAZING
                                    : harpoon_contract_pkg::FLOW_REAL;
    end else begin
      contact_o      <= '0;
      contact_o.flow <= harpoon_contract_pkg::FLOW_FAKE;
    end
  end

  logic [scpu_pkg::Latency-1:0] valid_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) valid_q <= '0;
    else         valid_q <= {valid_q[scpu_pkg::Latency-2:0], valid_i};
  end
  assign valid_o = valid_q[scpu_pkg::Latency-1];
endmodule
