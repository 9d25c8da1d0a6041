// SPDX-License-Identifier: Apache-2.0
// One axis of a window: turns RLUT words from window order into bank order, with each bank's block and validity. Bank g
// (pixel mod P = g) takes window lane (g - origin) mod P. Any window hits every bank exactly once.
// One register, which holds without a window.
`include "fault.svh"

module fastsplat_axis (
    input  logic                                                     clk_i,
    input  logic                                                     valid_i,
    input  logic signed [fastsplat_pkg::ORG_BITS-1:0]                origin_i,  // first pixel of the window
    input  logic [fastsplat_pkg::SIDE_BITS-1:0]                      side_i,    // tile width or height in pixels
    input  logic [fastsplat_pkg::LANES*fastsplat_pkg::RLUT_BITS-1:0] words_i,   // by window lane
    output logic [fastsplat_pkg::LANES*fastsplat_pkg::RLUT_BITS-1:0] words_o,   // by bank
    output logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0]  block_o,   // by bank: block column or row
    output logic [fastsplat_pkg::LANES-1:0]                          inside_o   // by bank: pixel lies in the tile
);
  localparam int P = fastsplat_pkg::LANES;
  localparam int W = fastsplat_pkg::RLUT_BITS;
  localparam int ORG = fastsplat_pkg::ORG_BITS;
  localparam int LOG2 = fastsplat_pkg::LANE_LOG2;
  localparam int BLK = fastsplat_pkg::BLK_BITS;

  // Lanes as a number of at least one bit, also for P = 1.
  localparam int LB = (LOG2 > 0) ? LOG2 : 1;
  logic [LB-1:0] offset;
  assign offset = (P > 1) ? origin_i[LB-1:0] : '0;

  for (genvar g = 0; g < P; g++) begin : gen_bank
    logic [LB-1:0] lane;
    logic signed [ORG-1:0] block, pixel;
    assign lane = `FASTSPLAT_FAULT(BANK_ROTATION) ? LB'(g) + offset : LB'(g) - offset;
    assign block = (origin_i >>> LOG2) + (({1'b0, offset} > (LB + 1)'(g)) ? ORG'(1) : ORG'(0));
    assign pixel = (block <<< LOG2) + ORG'(g);
    always_ff @(posedge clk_i) begin
      if (valid_i) begin
        words_o[g*W+:W] <= words_i[lane*W+:W];
        block_o[g*BLK+:BLK] <= block[BLK-1:0];
        inside_o[g] <= !block[ORG-1] && pixel < $signed(ORG'(side_i));
      end
    end
  end
endmodule
