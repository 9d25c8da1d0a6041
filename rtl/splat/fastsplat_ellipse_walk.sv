// SPDX-License-Identifier: Apache-2.0
// From a record's first window to its others by additions: the polynomial of q about each window's first pixel
// (docs/numerics.md, section 4.6; docs/microarchitecture.md, "Ellipses").
// One register, e9. The windows of a record follow one another without a gap.
`include "fault.svh"

module fastsplat_ellipse_walk (
    input  logic                                   clk_i,
    // e8: the record's coefficients, the same for all of its windows
    input  logic                                   first_i,    // its first window
    input  logic                                   new_row_i,  // the first of another row of windows
    input  logic [fastsplat_pkg::ELLIPSE_BITS-1:0] u0_i,
    input  logic [fastsplat_pkg::ELLIPSE_BITS-1:0] u1_i,
    input  logic [fastsplat_pkg::ELLIPSE_BITS-1:0] u2_i,
    input  logic [fastsplat_pkg::ELLIPSE_BITS-1:0] v1_i,
    input  logic [fastsplat_pkg::ELLIPSE_BITS-1:0] v2_i,
    input  logic [fastsplat_pkg::ELLIPSE_BITS-1:0] e_i,
    // e9: of the window
    output logic [fastsplat_pkg::ELLIPSE_BITS-1:0] u0_o,
    output logic [fastsplat_pkg::ELLIPSE_BITS-1:0] u1_o,
    output logic [fastsplat_pkg::ELLIPSE_BITS-1:0] u2_o,
    output logic [fastsplat_pkg::ELLIPSE_BITS-1:0] v1_o,
    output logic [fastsplat_pkg::ELLIPSE_BITS-1:0] v2_o,
    output logic [fastsplat_pkg::ELLIPSE_BITS-1:0] e_o
);
  localparam int QB = fastsplat_pkg::ELLIPSE_BITS;
  localparam int LOG2 = fastsplat_pkg::LANE_LOG2;

  // The row of windows in flight, at its first window.
  logic [QB-1:0] row_u0_q, row_u1_q, row_v1_q, row_u0, row_u1, row_v1;
  assign row_u0 = first_i ? u0_i : new_row_i ? row_u0_q + (row_v1_q << LOG2) + (v2_i << (2 * LOG2)) : row_u0_q;
  assign row_u1 = first_i ? u1_i : new_row_i ? row_u1_q + (e_i << LOG2) : row_u1_q;
  assign row_v1 = first_i ? v1_i : new_row_i ? row_v1_q + (v2_i << (LOG2 + 1)) : row_v1_q;

  logic right;  // P pixels to the right of the window before
  assign right = !first_i && (!new_row_i || `FASTSPLAT_FAULT(ELLIPSE_ROW));
  always_ff @(posedge clk_i) begin
    row_u0_q <= row_u0;
    row_u1_q <= row_u1;
    row_v1_q <= row_v1;
    u0_o <= right ? u0_o + (u1_o << LOG2) + (u2_i << (2 * LOG2)) : row_u0;
    u1_o <= right ? u1_o + (u2_i << (LOG2 + 1)) : row_u1;
    v1_o <= right ? v1_o + (e_i << LOG2) : row_v1;
    u2_o <= u2_i;
    v2_o <= v2_i;
    e_o <= e_i;
  end
endmodule
