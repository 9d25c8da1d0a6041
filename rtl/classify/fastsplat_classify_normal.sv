// SPDX-License-Identifier: Apache-2.0
// A pixel's density gradient: from differences to its length and its products with the light and half vectors
// (docs/numerics.md, N-6.2-10 to N-6.2-12; cmodel/classify/classify_unit.cpp). The unit normal is never formed: the
// products are scaled by 1/length instead.
// Registers: d3 products -> d4 slopes -> d5 tilt -> d6 ahead -> d7 squares -> d8 sums -> d9 even power -> d12 root ->
// d13 -> d14.
`include "fault.svh"
`include "narrow.svh"
module fastsplat_classify_normal (
    input  logic clk_i,
    // ROOT
    input  logic        we_i,
    input  logic [6:0]  waddr_i,
    input  logic [29:0] wdata_i,
    // LIGHTING; the sheet's scales
    input  logic [13*32-1:0] lighting_i,
    input  logic [12:0] across_scale_i,
    input  logic [12:0] along_scale_i,
    // d2: differences; the pixel of the image
    input  logic signed [fastsplat_pkg::SHEET_BITS+1:0] dx_i,
    input  logic signed [fastsplat_pkg::SHEET_BITS+1:0] dy_i,
    input  logic signed [fastsplat_pkg::SHEET_BITS:0]   dz_i,
    input  logic [15:0] x_i,
    input  logic [15:0] y_i,
    // d9: the gradient is not 0
    output logic        sloped_o,
    // d14: length U 5.24, |n.L| and |n.H| One.14
    output logic [28:0] length_o,
    output logic [14:0] light_o,
    output logic [14:0] half_o
);
  localparam int SB = fastsplat_pkg::SHEET_BITS;
  localparam int SF = fastsplat_pkg::SHEET_FRAC;
  localparam int GB = 20;             // bits of a slope, S 4.16
  localparam int AB = SB + 16;        // bits of a difference times its scale
  localparam int ZB = SB + 15 + 16 - SF;  // bits of dz, scaled, with 28 fraction bits
  localparam int HB = (ZB > 37 ? ZB : 37) + 2;
  `FASTSPLAT_NARROW_SIGNED(narrow_across, AB, GB, SF - 4)
  `FASTSPLAT_NARROW_SIGNED(narrow_along, HB, GB, 12)
  `FASTSPLAT_NARROW_SIGNED(narrow_tilt, 50, 16, 16)

  function automatic logic signed [31:0] word(input int n);
    word = lighting_i[32*n+:32];
  endfunction

  // d3, d4
  logic signed [AB-1:0] across_x_q, across_y_q;
  logic signed [ZB-1:0] along_q[3:5];
  logic signed [49:0] tilt_x_q, tilt_y_q;
  logic signed [GB-1:0] gx_q[4:6], gy_q[4:6], gz_q;
  logic signed [15:0] tx_q, ty_q;
  logic signed [GB+15:0] tx_gx_q, ty_gy_q;
  always_ff @(posedge clk_i) begin
    across_x_q <= AB'(dx_i) * $signed(AB'({1'b0, across_scale_i}));
    across_y_q <= AB'(dy_i) * $signed(AB'({1'b0, across_scale_i}));
    along_q[3] <= (ZB'(dz_i) * $signed(ZB'({1'b0, along_scale_i}))) <<< (16 - SF);
    tilt_x_q <= 50'(word(9)) + 50'(word(10)) * $signed(50'({1'b0, x_i}));
    tilt_y_q <= 50'(word(11)) + 50'(word(12)) * $signed(50'({1'b0, y_i}));
    gx_q[4] <= narrow_across(across_x_q);
    gy_q[4] <= narrow_across(across_y_q);
    tx_q <= narrow_tilt(tilt_x_q);
    ty_q <= narrow_tilt(tilt_y_q);
    along_q[4] <= along_q[3];
    // d5, d6
    tx_gx_q <= tx_q * gx_q[4];
    ty_gy_q <= ty_q * gy_q[4];
    along_q[5] <= along_q[4];
    gz_q <= narrow_along(HB'(along_q[5]) - HB'(tx_gx_q) - HB'(ty_gy_q));
    for (int s = 5; s <= 6; s++) begin
      gx_q[s] <= gx_q[s-1];
      gy_q[s] <= gy_q[s-1];
    end
  end

  // d7, d8: squares and, of light (0) and half vector (1), products
  logic [2*GB-2:0] square_x_q, square_y_q, square_z_q;
  logic signed [GB+15:0] along_x_q[0:1], along_y_q[0:1], along_z_q[0:1];
  logic signed [GB+17:0] sum[0:1];
  logic [GB+16:0] facing_q[0:1];
  logic [2*GB-1:0] square_q;
  for (genvar v = 0; v < 2; v++) begin : gen_vector
    assign sum[v] = (GB + 18)'(along_x_q[v]) + (GB + 18)'(along_y_q[v]) + (GB + 18)'(along_z_q[v]);
    always_ff @(posedge clk_i) begin
      along_x_q[v] <= gx_q[6] * $signed(lighting_i[32*(3*v)+:16]);
      along_y_q[v] <= gy_q[6] * $signed(lighting_i[32*(3*v+1)+:16]);
      along_z_q[v] <= gz_q * $signed(lighting_i[32*(3*v+2)+:16]);
      facing_q[v] <= (GB + 17)'(sum[v] < 0 ? -sum[v] : sum[v]);
    end
  end
  function automatic logic [2*GB-2:0] squared(input logic signed [GB-1:0] g);
    squared = (2 * GB - 1)'((2 * GB)'(g) * (2 * GB)'(g));
  endfunction
  always_ff @(posedge clk_i) begin
    square_x_q <= squared(gx_q[6]);
    square_y_q <= squared(gy_q[6]);
    square_z_q <= squared(gz_q);
    square_q <= (2 * GB)'(square_x_q) + (2 * GB)'(square_y_q) + (2 * GB)'(square_z_q);
  end

  // d9: the square is m 2^(2 power), m of 1..4 with 16 fraction bits
  logic [4:0] power, power_q;
  logic [17:0] m, m_q;
  logic [2*GB+16:0] padded;
  assign padded = {1'b0, square_q, 16'b0};
  always_comb begin
    power = '0;
    m = 18'h10000;  // without a slope: ROOT's first word, which there is, times nothing
    for (int i = 0; i < GB; i++) begin
      if (square_q[2*i+:2] != '0) begin
        power = 5'(i);
        m = `FASTSPLAT_FAULT(POST_POWER) ? padded[2*i+1+:18] : padded[2*i+:18];
      end
    end
  end
  always_ff @(posedge clk_i) begin
    power_q <= power;
    m_q <= m;
    sloped_o <= square_q != '0;
  end

  // d12: 1/sqrt(m), One.14
  logic [14:0] root;
  logic [17:0] place;
  assign place = m_q - 18'h10000;
  fastsplat_classify_line #(.BITS(15), .WORDS(96), .ADDR(7), .REST(11)) u_root (
      .clk_i, .we_i, .waddr_i, .wdata_i, .index_i(place[17:11]), .rest_i({1'b0, place[10:0]}), .value_o(root)
  );
  logic [17:0] m_d12;
  logic [4:0] power_d13;
  logic [2*(GB+17)-1:0] facing_d12;
  fastsplat_delay #(.BITS(18), .STAGES(3)) u_m (.clk_i, .rst_ni(1'b1), .data_i(m_q), .data_o(m_d12));
  fastsplat_delay #(.BITS(5), .STAGES(4)) u_power (.clk_i, .rst_ni(1'b1), .data_i(power_q), .data_o(power_d13));
  fastsplat_delay #(.BITS(2 * (GB + 17)), .STAGES(4)) u_facing (
      .clk_i, .rst_ni(1'b1), .data_i({facing_q[1], facing_q[0]}), .data_o(facing_d12)
  );

  // d13, d14
  localparam int LB = 33 + 19 + 1;
  localparam int FB = GB + 17 + 15 + 1;
  logic [32:0] length_q;
  logic [FB-1:0] facing_q2[0:1];
  logic [LB-1:0] length;
  logic [FB-1:0] facing[0:1];
  assign length = ((LB'(length_q) << power_d13) + (LB'(1) << 21)) >> 22;
  for (genvar v = 0; v < 2; v++) begin : gen_facing
    assign facing[v] = (facing_q2[v] + (FB'(1) << (5'd13 + {1'b0, power_d13}))) >> (6'd14 + {1'b0, power_d13});
  end
  function automatic logic [14:0] at_most_one(input logic [FB-1:0] value);
    at_most_one = (value > FB'(16384)) ? 15'd16384 : value[14:0];
  endfunction
  always_ff @(posedge clk_i) begin
    length_q <= 33'(m_d12) * 33'(root);
    for (int v = 0; v < 2; v++) facing_q2[v] <= FB'(facing_d12[v*(GB+17)+:GB+17]) * FB'(root);
    length_o <= (length > LB'(29'h1fffffff)) ? '1 : length[28:0];
    light_o <= at_most_one(facing[0]);
    half_o <= at_most_one(facing[1]);
  end
  logic unused;
  assign unused = &{1'b0, lighting_i};
endmodule
