// SPDX-License-Identifier: Apache-2.0
// Unit "pixel out": the finished tile, row by row, P pixels a beat (docs/numerics.md, section 7;
// cmodel/composite/pixel_out.hpp).
// r0 address -> r1 state -> r2 beat. All stages stand still while a beat waits for ready.
`include "assertions.svh"
`include "fault.svh"
`include "narrow.svh"
module fastsplat_pixel_out (
    input  logic                                 clk_i,
    input  logic                                 rst_ni,
    input  logic                                 start_i,   // pulse; tile registers hold until idle
    input  logic                                 aborted_i, // with it: the tile was cut short
    output logic                                 idle_o,
    input  logic [1:0]                           mode_i,
    input  logic                                 densities_i,  // the picture begins at column and row 1
    input  logic [fastsplat_pkg::SIDE_BITS-1:0]  width_i,
    input  logic [fastsplat_pkg::SIDE_BITS-1:0]  height_i,
    // picture
    output logic                                 picture_re_o,
    output logic [fastsplat_pkg::ADDR_BITS-1:0]  picture_addr_o,
    output logic [fastsplat_pkg::LANES-1:0]      picture_row_o,   // r1: the row of the block, one bit each
    input  logic [fastsplat_pkg::LANES*4*fastsplat_pkg::STATE_BITS-1:0] picture_i,  // r1
    // stream out: P pixels of R, G, B, A, 32 bits each
    output logic                                 valid_o,
    input  logic                                 ready_i,
    output logic                                 last_o,    // of the tile
    output logic                                 aborted_o, // the tile was cut short: on all of its beats
    output logic [fastsplat_pkg::LANES*128-1:0]  data_o,
    output logic [fastsplat_pkg::LANES-1:0]      keep_o,    // pixels inside the tile
    output logic [4*fastsplat_pkg::LANES-1:0]    saturated_o
);
  localparam int P = fastsplat_pkg::LANES;
  localparam int DB = fastsplat_pkg::STATE_BITS;
  localparam int SB = fastsplat_pkg::SHEET_BITS;
  localparam int TB = fastsplat_pkg::TRANS_BITS + fastsplat_pkg::COLOUR_INT;  // of colours; T has zeros above
  localparam int TF = fastsplat_pkg::TRANS_FRAC;
  localparam int PB = fastsplat_pkg::PIXEL_BITS;
  localparam int AB = fastsplat_pkg::ADDR_BITS;
  localparam int SIDE = fastsplat_pkg::SIDE_BITS;
  localparam int LOG2 = fastsplat_pkg::LANE_LOG2;
  localparam int LB = (LOG2 > 0) ? LOG2 : 1;

  logic running_q, valid_r1_q, valid_r2_q, last_r1_q, last_r2_q;
  logic [SIDE-1:0] x_q, y_q, x_r1_q;
  logic [LB-1:0] row_r1_q;
  logic enable, last;
  logic [AB-1:0] address;
  assign enable = !valid_r2_q || ready_i;
  localparam int BXL = $clog2(fastsplat_pkg::BLOCKS_X);
  logic [SIDE-1:0] row;
  assign row = y_q + SIDE'(fastsplat_pkg::DENSITIES != 0 && densities_i);
  assign address = AB'(((SIDE + AB)'(row) >> LOG2) << BXL) | AB'((SIDE + AB)'(x_q) >> LOG2);
  assign last = x_q + SIDE'(P) >= width_i && y_q + SIDE'(1) >= height_i;
  assign picture_re_o = running_q && enable;
  assign picture_addr_o = address;

  always_ff @(posedge clk_i) begin
    if (start_i) begin
      running_q <= 1'b1;
      aborted_o <= aborted_i;
      x_q <= '0;
      y_q <= '0;
    end else if (enable) begin
      if (running_q) begin
        x_q <= x_q + SIDE'(P);
        if (x_q + SIDE'(P) >= width_i) begin
          x_q <= '0;
          y_q <= y_q + SIDE'(1);
        end
        if (last) running_q <= 1'b0;
      end
    end
    if (enable) begin
      valid_r1_q <= running_q;
      last_r1_q <= last;
      x_r1_q <= x_q;
      row_r1_q <= row[LB-1:0];
      valid_r2_q <= valid_r1_q;
      last_r2_q <= last_r1_q;
    end
    if (`FASTSPLAT_FAULT(VALID_DROPPED) && valid_r2_q && !ready_i && x_q[LB]) valid_r2_q <= 1'b0;
    idle_o <= !start_i && !running_q && !valid_r1_q && (!valid_r2_q || ready_i);
    if (!rst_ni) begin
      idle_o <= 1'b1;
      running_q <= 1'b0;
      valid_r1_q <= 1'b0;
      valid_r2_q <= 1'b0;
    end
  end

  assign picture_row_o = valid_r1_q ? P'(1) << row_r1_q : '0;

  // r1: the row narrowed to output words, {overflow, word}
  `FASTSPLAT_NARROW(narrow_composited, TB, PB, PIXEL_OUT)
  `FASTSPLAT_NARROW(narrow_sum, SB, PB, PIXEL_SUM)
  for (genvar g = 0; g < P; g++) begin : gen_pixel
    for (genvar c = 0; c < 4; c++) begin : gen_channel
      logic [DB-1:0] word;
      logic [TB-1:0] composited;
      logic [PB:0] pixel_q;
      assign word = picture_i[(4*g+c)*DB+:DB];
      assign composited = (c == 3) ? (TB'(1) << TF) - word[TB-1:0] : word[TB-1:0];
      always_ff @(posedge clk_i) begin
        if ((enable && valid_r1_q) || (`FASTSPLAT_FAULT(HELD_PAYLOAD) && running_q)) begin
          pixel_q <= (mode_i == 2'd2) ? narrow_sum(word[SB-1:0]) : narrow_composited(composited);
        end
      end
      assign data_o[g*128+c*32+:32] = 32'(pixel_q[PB-1:0]);
      assign saturated_o[4*g+c] = keep_o[g] && pixel_q[PB];
    end
    always_ff @(posedge clk_i) if (enable) keep_o[g] <= x_r1_q + SIDE'(g) < width_i;
  end
  assign valid_o = valid_r2_q;
  assign last_o = last_r2_q;
  `FASTSPLAT_ASSERT_NEXT(pixel_valid_held, valid_o && !ready_i, valid_o)
  `FASTSPLAT_ASSERT_HELD(pixel_payload_held, valid_o && !ready_i, 1'b1, {data_o, keep_o, last_o, aborted_o})
  `FASTSPLAT_ASSERT(pixel_rest_foretold, idle_o == (!running_q && !valid_r1_q && !valid_r2_q))
  `FASTSPLAT_ASSUME(pixel_start_when_idle, !start_i || idle_o)
  `FASTSPLAT_COVER(pixel_back_pressure, valid_o && !ready_i)
endmodule
