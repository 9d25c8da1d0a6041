// SPDX-License-Identifier: Apache-2.0
// Unit "ellipse": from a record's shape to words by bank column and bank row, at c3 of the splat path
// (docs/numerics.md, section 4.6; docs/microarchitecture.md, "Ellipses"; cmodel/splat/ellipse_unit.hpp). Results for
// circles are ignored.
// 13 registers, e1 to e13, parallel to the 10 cycles by which decode's windows are delayed and to c1 to c3.
module fastsplat_ellipse (
    input  logic                                      clk_i,
    // c0 as decode issues it
    input  logic                                      first_i,
    input  logic                                      new_row_i,
    input  logic                                      densities_i,  // the tile's memory begins a pixel earlier
    input  logic signed [fastsplat_pkg::POS_BITS-1:0] x_i,
    input  logic signed [fastsplat_pkg::POS_BITS-1:0] y_i,
    input  logic [fastsplat_pkg::SHAPE_BITS-1:0]      shape_i,
    // c3
    output logic [2*fastsplat_pkg::LANES*fastsplat_pkg::ELLIPSE_BITS-1:0] columns_o,
    output logic [2*fastsplat_pkg::LANES*fastsplat_pkg::ELLIPSE_BITS-1:0] rows_o,
    output logic [fastsplat_pkg::BANKS*fastsplat_pkg::ELLIPSE_BITS-1:0]   cross_o,
    output logic [fastsplat_pkg::LANES-1:0]                               second_x_o,
    output logic [fastsplat_pkg::LANES-1:0]                               second_y_o
);
  localparam int QB = fastsplat_pkg::ELLIPSE_BITS;
  localparam int LOG2 = fastsplat_pkg::LANE_LOG2;
  localparam int PF = fastsplat_pkg::POS_FRAC;

  // The first pixel modulo P, at every window of a record; and where in the record a window is.
  logic [LOG2-1:0] offset_x, offset_y, offset_x_e9, offset_y_e9;
  logic first_e8, new_row_e8;
  assign offset_x = x_i[PF+:LOG2] + shape_i[74+:LOG2] + LOG2'(fastsplat_pkg::DENSITIES != 0 && densities_i);  // left
  assign offset_y = y_i[PF+:LOG2] + shape_i[84+:LOG2] + LOG2'(fastsplat_pkg::DENSITIES != 0 && densities_i);  // top
  fastsplat_delay #(.BITS(2 * LOG2), .STAGES(9)) u_offsets (
      .clk_i, .rst_ni(1'b1), .data_i({offset_y, offset_x}), .data_o({offset_y_e9, offset_x_e9})
  );
  fastsplat_delay #(.BITS(2), .STAGES(8)) u_place (
      .clk_i, .rst_ni(1'b1), .data_i({new_row_i, first_i}), .data_o({new_row_e8, first_e8})
  );

  logic [QB-1:0] u0, u1, u2, v1, v2, e, window_u0, window_u1, window_u2, window_v1, window_v2, window_e;
  fastsplat_ellipse_setup u_setup (
      .clk_i, .x_i, .y_i, .shape_i, .u0_o(u0), .u1_o(u1), .u2_o(u2), .v1_o(v1), .v2_o(v2), .e_o(e)
  );
  fastsplat_ellipse_walk u_walk (
      .clk_i,
      .first_i(first_e8),
      .new_row_i(new_row_e8),
      .u0_i(u0),
      .u1_i(u1),
      .u2_i(u2),
      .v1_i(v1),
      .v2_i(v2),
      .e_i(e),
      .u0_o(window_u0),
      .u1_o(window_u1),
      .u2_o(window_u2),
      .v1_o(window_v1),
      .v2_o(window_v2),
      .e_o(window_e)
  );
  fastsplat_ellipse_lanes u_lanes (
      .clk_i,
      .offset_x_i(offset_x_e9),
      .offset_y_i(offset_y_e9),
      .u0_i(window_u0),
      .u1_i(window_u1),
      .u2_i(window_u2),
      .v1_i(window_v1),
      .v2_i(window_v2),
      .e_i(window_e),
      .columns_o,
      .rows_o,
      .cross_o,
      .second_x_o,
      .second_y_o
  );
endmodule
