// SPDX-License-Identifier: Apache-2.0
// Whether the first window of a record just taken into decode's register lies over the window issued in the cycle
// before: |dx| < P and |dy| < P of their first pixels (docs/microarchitecture.md, M-hazard-3). The record is snapped on
// its way into the register, so the handshake only waits for a subtraction.
`include "fault.svh"

module fastsplat_overlap (
    input  logic                                       clk_i,
    // what comes into the register, if anything does
    input  logic                                       enter_i,
    input  logic                                       ellipse_i,
    input  logic signed [fastsplat_pkg::POS_BITS-1:0]  x_i,
    input  logic signed [fastsplat_pkg::POS_BITS-1:0]  y_i,
    input  logic [fastsplat_pkg::RHO_BITS-1:0]         rho_i,    // of a splat
    input  logic signed [9:0]                          left_i,   // of an ellipse
    input  logic signed [9:0]                          top_i,
    // window of the record in the register: its place in the footprint, pixels
    input  logic [fastsplat_pkg::WINDOW_BITS-1:0]      column_i,
    input  logic [fastsplat_pkg::WINDOW_BITS-1:0]      row_i,
    // of the record in the register, in its first cycle there
    output logic                                       overlap_o
);
  localparam int ORG = fastsplat_pkg::ORG_BITS;
  localparam int LOG2 = fastsplat_pkg::LANE_LOG2;
  localparam logic [fastsplat_pkg::COL_BITS-1:0] NO_COLUMN = '0;

  logic fresh_q;
  always_ff @(posedge clk_i) fresh_q <= enter_i;

  // first pixel of the record in its first cycle in the register
  logic signed [ORG-1:0] circle_x, circle_y, x, y;
  logic [fastsplat_pkg::PHASE_BITS-1:0] phase_x, phase_y;
  logic saturated_x, saturated_y;
  fastsplat_snap u_snap_x (.clk_i, .centre_i(x_i), .rho_i, .column_i(NO_COLUMN), .origin_o(circle_x), .phase_o(phase_x), .saturated_o(saturated_x));
  fastsplat_snap u_snap_y (.clk_i, .centre_i(y_i), .rho_i, .column_i(NO_COLUMN), .origin_o(circle_y), .phase_o(phase_y), .saturated_o(saturated_y));
  logic unused;
  assign unused = &{1'b0, phase_x, phase_y, saturated_x, saturated_y};
  if (fastsplat_pkg::ELLIPSES != 0) begin : gen_ellipse
    logic ellipse_q;
    logic signed [ORG-1:0] ellipse_x_q, ellipse_y_q;
    always_ff @(posedge clk_i) begin
      ellipse_q <= ellipse_i;
      ellipse_x_q <= ORG'(32'(x_i) >>> fastsplat_pkg::POS_FRAC) + ORG'(left_i);
      ellipse_y_q <= ORG'(32'(y_i) >>> fastsplat_pkg::POS_FRAC) + ORG'(top_i);
    end
    assign x = ellipse_q ? ellipse_x_q : circle_x;
    assign y = ellipse_q ? ellipse_y_q : circle_y;
  end else begin : gen_circles
    assign x = circle_x;
    assign y = circle_y;
    logic unused_shape;
    assign unused_shape = &{1'b0, ellipse_i, left_i, top_i};
  end

  // first pixel now and in later cycles; window of the cycle before
  logic signed [ORG-1:0] x_here, y_here, x_held_q, y_held_q, x_last_q, y_last_q;
  assign x_here = fresh_q ? x : x_held_q;
  assign y_here = fresh_q ? y : y_held_q;
  always_ff @(posedge clk_i) begin
    x_held_q <= x_here;
    y_held_q <= y_here;
    x_last_q <= x_here + $signed(ORG'(column_i));
    y_last_q <= y_here + $signed(ORG'(row_i));
  end

  // -P < d < P
  function automatic logic near(input logic signed [ORG:0] d);
    near = d[ORG:LOG2] == '0 || (d[ORG:LOG2] == '1 && d[LOG2-1:0] != '0 && !`FASTSPLAT_FAULT(SAMPLE_LEFT)) ||
           (`FASTSPLAT_FAULT(SAMPLE_BESIDE) && d == (ORG + 1)'(1 << LOG2));
  endfunction
  assign overlap_o = fresh_q && near((ORG + 1)'(x) - (ORG + 1)'(x_last_q)) && near((ORG + 1)'(y) - (ORG + 1)'(y_last_q));
endmodule
