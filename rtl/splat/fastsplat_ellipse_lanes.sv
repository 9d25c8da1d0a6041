// SPDX-License-Identifier: Apache-2.0
// A window's polynomial as words by bank column and bank row, so that a lane adds three of them and multiplies nothing
// (docs/microarchitecture.md, M-ellipse-5).
// Bank (g,h) takes pixel (X,Y) of the window, X = g - ox or g - ox + P, Y alike: a window meets at most two blocks a
// side.
// With X Y e = X b e + a h e + g h e, b = Y - h and a = X - g (two values each), q is
//   column: u0 + X (u1 + b e) + X^2 u2, for both b      row: Y v1 + Y^2 v2 + h a e, for both a      cross: g h e
// Registers: e10 u1 + b e, a e -> e11 multiples -> e12 sums by window lane -> e13 (with c3) by bank.
`include "fault.svh"

module fastsplat_ellipse_lanes (
    input  logic                                                         clk_i,
    // e9
    input  logic [fastsplat_pkg::LANE_LOG2-1:0]                          offset_x_i,  // ox: the window's first pixel mod P
    input  logic [fastsplat_pkg::LANE_LOG2-1:0]                          offset_y_i,
    input  logic [fastsplat_pkg::ELLIPSE_BITS-1:0]                       u0_i,
    input  logic [fastsplat_pkg::ELLIPSE_BITS-1:0]                       u1_i,
    input  logic [fastsplat_pkg::ELLIPSE_BITS-1:0]                       u2_i,
    input  logic [fastsplat_pkg::ELLIPSE_BITS-1:0]                       v1_i,
    input  logic [fastsplat_pkg::ELLIPSE_BITS-1:0]                       v2_i,
    input  logic [fastsplat_pkg::ELLIPSE_BITS-1:0]                       e_i,
    // e13: by bank column g, for banks whose row lies in the window's first block, and in its second; by row likewise
    output logic [2*fastsplat_pkg::LANES*fastsplat_pkg::ELLIPSE_BITS-1:0] columns_o,
    output logic [2*fastsplat_pkg::LANES*fastsplat_pkg::ELLIPSE_BITS-1:0] rows_o,
    output logic [fastsplat_pkg::BANKS*fastsplat_pkg::ELLIPSE_BITS-1:0]   cross_o,
    output logic [fastsplat_pkg::LANES-1:0]                               second_x_o,  // bank column g lies in the second block
    output logic [fastsplat_pkg::LANES-1:0]                               second_y_o
);
  localparam int P = fastsplat_pkg::LANES;
  localparam int QB = fastsplat_pkg::ELLIPSE_BITS;
  localparam int LOG2 = fastsplat_pkg::LANE_LOG2;

  // What is only passed on.
  logic [LOG2-1:0] ox_q[10:12], oy_q[10:12];
  logic [QB-1:0] u0_q[10:11], u2_q, v1_q, v2_q, e_q[10:12];
  // e10; [0]: the first block, [1]: the second
  logic [QB-1:0] slope_q[0:1], turn_q[0:1];  // u1 + b e; a e
  // e11, by window lane
  logic [QB-1:0] xu1_q[0:2*P-1], xxu2_q[0:P-1], yv1_q[0:P-1], yyv2_q[0:P-1], turn11_q[0:1];
  // e12
  logic [QB-1:0] column_q[0:2*P-1], row_q[0:P-1];
  logic [QB-1:0] hturn_q[0:2*P-1];  // by bank row

  logic [QB-1:0] oxe, oye;
  assign oxe = QB'(offset_x_i) * e_i;
  assign oye = QB'(offset_y_i) * e_i;
  always_ff @(posedge clk_i) begin
    slope_q[0] <= u1_i - oye;
    slope_q[1] <= u1_i - oye + (e_i << LOG2);
    turn_q[0] <= -oxe;
    turn_q[1] <= (e_i << LOG2) - oxe;
    turn11_q[0] <= turn_q[0];
    turn11_q[1] <= turn_q[1];
    ox_q[10] <= offset_x_i;
    oy_q[10] <= offset_y_i;
    u0_q[10] <= u0_i;
    u0_q[11] <= u0_q[10];
    u2_q <= u2_i;
    v1_q <= v1_i;
    v2_q <= v2_i;
    e_q[10] <= e_i;
    for (int s = 11; s <= 12; s++) begin
      ox_q[s] <= ox_q[s-1];
      oy_q[s] <= oy_q[s-1];
      e_q[s] <= e_q[s-1];
    end
  end

  for (genvar l = 0; l < P; l++) begin : gen_lane
    always_ff @(posedge clk_i) begin
      xxu2_q[l] <= QB'(l * l) * u2_q;
      yv1_q[l] <= QB'(l) * v1_q;
      yyv2_q[l] <= QB'(l * l) * v2_q;
      row_q[l] <= yv1_q[l] + yyv2_q[l];
      for (int k = 0; k < 2; k++) begin
        xu1_q[k*P+l] <= QB'(l) * slope_q[k];
        column_q[k*P+l] <= u0_q[11] + xu1_q[k*P+l] + xxu2_q[l];
        hturn_q[k*P+l] <= QB'(l) * turn11_q[k];
      end
    end
  end

  logic [LOG2-1:0] turn_y;
  assign turn_y = `FASTSPLAT_FAULT(ELLIPSE_BLOCK) ? '0 : oy_q[12];
  for (genvar g = 0; g < P; g++) begin : gen_bank
    logic [LOG2-1:0] x, y;  // the window lane that bank column, or row, g takes
    assign x = LOG2'(g) - ox_q[12];
    assign y = LOG2'(g) - oy_q[12];
    always_ff @(posedge clk_i) begin
      second_x_o[g] <= {1'b0, ox_q[12]} > (LOG2 + 1)'(g);
      second_y_o[g] <= {1'b0, turn_y} > (LOG2 + 1)'(g);
      columns_o[g*QB+:QB] <= column_q[{1'b0, x}];
      columns_o[(P+g)*QB+:QB] <= column_q[{1'b1, x}];
      rows_o[g*QB+:QB] <= row_q[y] + hturn_q[g];
      rows_o[(P+g)*QB+:QB] <= row_q[y] + hturn_q[P+g];
      for (int h = 0; h < P; h++) cross_o[(h*P+g)*QB+:QB] <= QB'(g * h) * e_q[12];
    end
  end
endmodule
