// SPDX-License-Identifier: Apache-2.0
// Unit "snap", one axis: centre onto the 1/k grid, window origin and phase (docs/numerics.md, section 3;
// cmodel/splat/snap.hpp). One register: outputs belong to the inputs of the cycle before.
`include "fault.svh"

module fastsplat_snap (
    input  logic                                     clk_i,
    input  logic signed [ fastsplat_pkg::POS_BITS-1:0] centre_i,  // S pi.pf, tile-relative
    input  logic        [fastsplat_pkg::RHO_BITS-1:0] rho_i,      // support radius, 1/k pixel
    input  logic        [fastsplat_pkg::COL_BITS-1:0] column_i,   // first column of the window within the footprint
    output logic signed [fastsplat_pkg::ORG_BITS-1:0] origin_o,   // first pixel of the window, tile-relative
    output logic        [fastsplat_pkg::PHASE_BITS-1:0] phase_o,  // RLUT row
    output logic                                     saturated_o
);
  localparam int DROP = fastsplat_pkg::SHIFT_SNAP;
  localparam int GRID_BITS = fastsplat_pkg::POS_INT + fastsplat_pkg::PHASE_LOG2;
  // Wide enough for centre + BIAS + 1, for grid position minus rho, and for an origin, which may be an ellipse's.
  localparam int NEEDED = ((fastsplat_pkg::POS_BITS > GRID_BITS + 2) ? fastsplat_pkg::POS_BITS : GRID_BITS + 2) + 2;
  localparam int WIDE = (NEEDED > fastsplat_pkg::ORG_BITS) ? NEEDED : fastsplat_pkg::ORG_BITS + 1;
  localparam logic signed [WIDE-1:0] EVEN = (fastsplat_pkg::ROUND_SNAP == 2 && DROP > 0) ? WIDE'(1) : '0;
  localparam logic signed [WIDE-1:0] BIAS = (fastsplat_pkg::ROUND_SNAP != 0 && DROP > 0) ? (WIDE'(1) << (DROP > 0 ? DROP - 1 : 0)) - EVEN : '0;
  localparam logic signed [WIDE-1:0] LARGEST = (WIDE'(1) << (GRID_BITS - 1)) - WIDE'(1);

  logic signed [WIDE-1:0] centre, rounded, on_grid, rim, first;
  logic overflow;
  always_comb begin
    // As in narrow.svh, but signed.
    centre = WIDE'(centre_i);
    rounded = (centre + (`FASTSPLAT_FAULT(SNAP_TRN) ? WIDE'(0) : BIAS + ((centre >>> DROP) & EVEN))) >>> DROP;
    // Rounding up can only leave the range at its upper end.
    overflow = rounded > LARGEST;
    on_grid = overflow ? LARGEST : rounded;
    rim = on_grid - $signed(WIDE'(rho_i));
    first = (rim >>> fastsplat_pkg::PHASE_LOG2) + (`FASTSPLAT_FAULT(SNAP_OFF_BY_ONE) ? WIDE'(0) : WIDE'(1)) +
            $signed(WIDE'(column_i));
  end
  always_ff @(posedge clk_i) begin
    origin_o <= first[fastsplat_pkg::ORG_BITS-1:0];
    phase_o <= rim[fastsplat_pkg::PHASE_BITS-1:0];
    saturated_o <= overflow;
  end
  logic unused;
  assign unused = &{1'b0, first[WIDE-1:fastsplat_pkg::ORG_BITS], rim[WIDE-1]};
endmodule
