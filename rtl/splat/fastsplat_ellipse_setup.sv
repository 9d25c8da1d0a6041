// SPDX-License-Identifier: Apache-2.0
// A record's shape as six coefficients at its first pixel, each exact and then narrowed once (docs/numerics.md,
// N-4.6-5; cmodel/splat/ellipse_unit.cpp). One record a cycle; its coefficients are computed anew for each window.
// Registers: e1 way from the centre -> e2 first products -> e3 sums -> e4 second products -> e5 u0 -> e6 shift by
// eights -> e7 shift by ones -> e8 rounded. All words are two's complement, modulo their width.
`include "fault.svh"

module fastsplat_ellipse_setup (
    input  logic                                      clk_i,
    // c0
    input  logic signed [fastsplat_pkg::POS_BITS-1:0] x_i,
    input  logic signed [fastsplat_pkg::POS_BITS-1:0] y_i,
    input  logic [fastsplat_pkg::SHAPE_BITS-1:0]      shape_i,  // {top, left, h, C, B, A}
    // e8
    output logic [fastsplat_pkg::ELLIPSE_BITS-1:0]    u0_o,
    output logic [fastsplat_pkg::ELLIPSE_BITS-1:0]    u1_o,
    output logic [fastsplat_pkg::ELLIPSE_BITS-1:0]    u2_o,
    output logic [fastsplat_pkg::ELLIPSE_BITS-1:0]    v1_o,
    output logic [fastsplat_pkg::ELLIPSE_BITS-1:0]    v2_o,
    output logic [fastsplat_pkg::ELLIPSE_BITS-1:0]    e_o
);
  localparam int PF = fastsplat_pkg::POS_FRAC;
  localparam int QB = fastsplat_pkg::ELLIPSE_BITS;
  localparam int F = fastsplat_pkg::ELLIPSE_FRAC;
  localparam int XB = 11 + PF;       // X and Y: left 2^pf less a fraction
  localparam int MB = 24 + XB;       // A X, B X and the like
  localparam int SB = MB + 2;        // 2 A X + B Y
  localparam int UB = SB + XB;       // A X^2 + B X Y + C Y^2
  localparam int TERM = 22, CROSS = 24;

  logic [TERM-1:0] a, c;
  logic signed [CROSS-1:0] b;
  logic [5:0] h;
  logic signed [9:0] left, top;
  assign {top, left, h, c, b, a} = shape_i;

  // What is only passed on.
  logic signed [TERM:0] a_q[1:5], c_q[1:5];
  logic signed [CROSS-1:0] b_q[1:5];
  logic [5:0] h_q[1:6];

  // e1
  logic signed [XB-1:0] x_q[1:3], y_q[1:3];
  // e2
  logic signed [MB-1:0] ax_q, by_q, bx_q, cy_q;
  // e3
  logic signed [SB-1:0] sum_q, cy3_q, u1_q[3:5], v1_q[3:5];
  // e4, e5
  logic signed [UB-1:0] xsum_q, ycy_q, u0_q;
  always_ff @(posedge clk_i) begin
    x_q[1] <= (XB'(left) <<< PF) - $signed({{(XB - PF) {1'b0}}, x_i[PF-1:0]});
    y_q[1] <= (XB'(top) <<< PF) - $signed({{(XB - PF) {1'b0}}, y_i[PF-1:0]});
    a_q[1] <= $signed({1'b0, a});
    b_q[1] <= b;
    c_q[1] <= $signed({1'b0, c});
    h_q[1] <= h;

    ax_q <= MB'(a_q[1]) * MB'(x_q[1]);
    by_q <= MB'(b_q[1]) * MB'(y_q[1]);
    bx_q <= MB'(b_q[1]) * MB'(x_q[1]);
    cy_q <= MB'(c_q[1]) * MB'(y_q[1]);

    sum_q <= SB'(ax_q) + SB'(by_q);
    cy3_q <= SB'(cy_q);
    u1_q[3] <= (SB'(ax_q) <<< 1) + SB'(by_q);
    v1_q[3] <= (SB'(cy_q) <<< 1) + SB'(bx_q);

    xsum_q <= UB'(x_q[3]) * UB'(sum_q);
    ycy_q <= UB'(y_q[3]) * UB'(cy3_q);
    u0_q <= xsum_q + ycy_q;

    for (int s = 2; s <= 3; s++) begin
      x_q[s] <= x_q[s-1];
      y_q[s] <= y_q[s-1];
    end
    for (int s = 4; s <= 5; s++) begin
      u1_q[s] <= u1_q[s-1];
      v1_q[s] <= v1_q[s-1];
    end
    for (int s = 2; s <= 5; s++) begin
      a_q[s] <= a_q[s-1];
      b_q[s] <= b_q[s-1];
      c_q[s] <= c_q[s-1];
    end
    for (int s = 2; s <= 6; s++) h_q[s] <= h_q[s-1];
  end

  // e6 to e8: floor((v 2^f + 2^(h-1)) / 2^h) is v 2^f shifted right, and the last bit that fell off added.
  localparam int WIDE = 8 + UB + F + 1 + 64;  // a shift of 63 still finds signs to fill with
  logic signed [UB-1:0] exact[0:5];
  logic [QB-1:0] word_q[0:5];
  assign exact[0] = u0_q;
  assign exact[1] = UB'(u1_q[5]) <<< PF;
  assign exact[2] = UB'(a_q[5]) <<< (2 * PF);
  assign exact[3] = UB'(v1_q[5]) <<< PF;
  assign exact[4] = UB'(c_q[5]) <<< (2 * PF);
  assign exact[5] = UB'(b_q[5]) <<< (2 * PF);
  for (genvar n = 0; n < 6; n++) begin : gen_narrow
    logic signed [WIDE-1:0] wide, coarse;
    logic [QB+7:0] coarse_q, fine;
    logic [QB:0] fine_q;  // the last bit is the first that falls off
    assign wide = WIDE'(exact[n]) <<< (F + 1);
    assign coarse = wide >>> {h_q[5][5:3], 3'b000};
    assign fine = coarse_q >> h_q[6][2:0];
    always_ff @(posedge clk_i) begin
      coarse_q <= coarse[QB+7:0];
      fine_q <= fine[QB:0];
      word_q[n] <= fine_q[QB:1] + (`FASTSPLAT_FAULT(ELLIPSE_TRN) ? '0 : QB'(fine_q[0]));
    end
    logic unused;
    assign unused = &{1'b0, coarse, fine};
  end
  assign u0_o = word_q[0];
  assign u1_o = word_q[1];
  assign u2_o = word_q[2];
  assign v1_o = word_q[3];
  assign v2_o = word_q[4];
  assign e_o = word_q[5];

  logic unused;
  assign unused = &{1'b0, x_i[fastsplat_pkg::POS_BITS-1:PF], y_i[fastsplat_pkg::POS_BITS-1:PF]};
endmodule
