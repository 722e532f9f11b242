// Decides ahead of an scpu whether a pair is a miss (Flow 1), with exactly the scpu's decision but
// without its square root and division.
//
// The arithmetic is sphere_miss, generated from the C++ collider. pair_i is a pair record:
//   [ p1.x p1.y p1.z r1 p2.x p2.y p2.z r2 ], first field in the low word.
//
// Handshake: valid only, no back-pressure; valid_o is valid_i and miss_o belongs to pair_i, both
// scpu_pkg::CullLatency cycles ago. Throughput: one pair a cycle.
// Number format: binary32, nearest even, subnormals kept; a NaN distance or sum is not a miss.
// Reset (synchronous, active low): nothing is valid; pairs under way are dropped. No parameters.
module scpu_cull (
  input  logic                        clk_i,
  input  logic                        rst_ni,
  input  logic                        valid_i,
  input  harpoon_contract_pkg::pair_t pair_i,
  output logic                        valid_o,
  output logic                        miss_o
);
  sphere_miss u_sphere_miss (
    .clk_i, .rst_ni,
    .p1_x_i(pair_i.p1.x), .p1_y_i(pair_i.p1.y), .p1_z_i(pair_i.p1.z), .r1_i(pair_i.p1.r),
    .p2_x_i(pair_i.p2.x), .p2_y_i(pair_i.p2.y), .p2_z_i(pair_i.p2.z), .r2_i(pair_i.p2.r),
    .miss_o
  );

  logic [scpu_pkg::CullLatency-1:0] valid_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) valid_q <= '0;
    else         valid_q <= {valid_q[scpu_pkg::CullLatency-2:0], valid_i};
  end
  assign valid_o = valid_q[scpu_pkg::CullLatency-1];
endmodule
