// SPDX-License-Identifier: Apache-2.0
// One lane of the pixel stage: classifies and shades one pixel from its density and its neighbours'. Returns the sums
// of a sheet of colours (docs/numerics.md, section 6.2; cmodel/classify/classify_unit.hpp).
// Registers: d1 words -> d2 differences, place in CLASSIFY -> d5 colour and depth; beside these normal and shading to
// d23.
`include "fault.svh"
module fastsplat_classify_lane (
    input  logic clk_i,
    // load of the tables' segments
    input  logic [5:0] segment_we_i,
    input  logic [fastsplat_pkg::DENSITY_ADDR-1:0]   segment_i,
    input  logic [2*fastsplat_pkg::DENSITY_WORD-1:0] segment_word_i,
    input  logic [13*32-1:0] lighting_i,
    input  logic [15:0] image_width_i,
    input  logic [15:0] image_height_i,
    // the sheet's words of SHEETS: at d2 and at d14
    input  logic [31:0] scales_i,
    input  logic [31:0] floor_i,
    // d0
    input  logic [fastsplat_pkg::SHEET_BITS-1:0] here_i,
    input  logic [fastsplat_pkg::SHEET_BITS-1:0] left_i,
    input  logic [fastsplat_pkg::SHEET_BITS-1:0] right_i,
    input  logic [fastsplat_pkg::SHEET_BITS-1:0] above_i,
    input  logic [fastsplat_pkg::SHEET_BITS-1:0] below_i,
    input  logic [fastsplat_pkg::SHEET_BITS-1:0] before_i,
    input  logic [fastsplat_pkg::SHEET_BITS-1:0] behind_i,
    input  logic [15:0] x_i,  // of the image
    input  logic [15:0] y_i,
    // d23
    output logic [4*fastsplat_pkg::SHEET_BITS-1:0] sums_o
);
  localparam int SB = fastsplat_pkg::SHEET_BITS;
  localparam int SF = fastsplat_pkg::SHEET_FRAC;
  localparam int WORD = fastsplat_pkg::DENSITY_WORD;
  localparam int Q = fastsplat_pkg::CLASSIFY_LOG2;
  localparam int REST = SF - Q;

  // d1, d2: at the image's edges the difference is one-sided and doubled (N-6.2-9)
  logic [SB-1:0] here_q, left_q, right_q, above_q, below_q, before_q, behind_q;
  logic [15:0] x_q, y_q, x_q2, y_q2;
  logic first_x_q, last_x_q, first_y_q, last_y_q;
  logic signed [SB:0] dx, dy, dz_q;
  logic signed [SB+1:0] dx_q, dy_q;
  logic full;
  logic [Q-1:0] index_q;
  logic [REST:0] rest_q;
  assign dx = $signed({1'b0, last_x_q ? here_q : right_q}) - $signed({1'b0, first_x_q ? here_q : left_q});
  assign dy = $signed({1'b0, last_y_q ? here_q : below_q}) - $signed({1'b0, first_y_q ? here_q : above_q});
  assign full = here_q >= SB'(1 << SF);  // 1.0 is the end of the last segment
  always_ff @(posedge clk_i) begin
    here_q <= here_i;
    left_q <= left_i;
    right_q <= right_i;
    above_q <= above_i;
    below_q <= below_i;
    before_q <= before_i;
    behind_q <= behind_i;
    x_q <= x_i;
    y_q <= y_i;
    first_x_q <= x_i == '0 && !`FASTSPLAT_FAULT(POST_EDGE);
    last_x_q <= x_i + 16'd1 == image_width_i && !`FASTSPLAT_FAULT(POST_EDGE);
    first_y_q <= y_i == '0 && !`FASTSPLAT_FAULT(POST_EDGE);
    last_y_q <= y_i + 16'd1 == image_height_i && !`FASTSPLAT_FAULT(POST_EDGE);
    dx_q <= (first_x_q || last_x_q) ? {dx, 1'b0} : (SB + 2)'(dx);
    dy_q <= (first_y_q || last_y_q) ? {dy, 1'b0} : (SB + 2)'(dy);
    dz_q <= $signed({1'b0, behind_q}) - $signed({1'b0, before_q});
    x_q2 <= x_q;
    y_q2 <= y_q;
    index_q <= full ? '1 : here_q[REST+:Q];
    rest_q <= full ? (REST + 1)'(1) << REST : (REST + 1)'(here_q & SB'((1 << REST) - 1));
  end

  // d5
  logic [44:0] colour;
  logic [SB-1:0] tau;
  for (genvar c = 0; c < 4; c++) begin : gen_channel
    localparam int BITS = (c == 3) ? SB : 15;
    logic [BITS-1:0] value;
    fastsplat_classify_line #(.BITS(BITS), .WORDS(1 << Q), .ADDR(Q), .REST(REST)) u_line (
        .clk_i,
        .we_i(segment_we_i[c]),
        .waddr_i(segment_i[Q-1:0]),
        .wdata_i({segment_word_i[WORD+:BITS], segment_word_i[0+:BITS]}),
        .index_i(index_q),
        .rest_i(rest_q),
        .value_o(value)
    );
    if (c == 3) begin : gen_tau
      assign tau = value;
    end else begin : gen_colour
      assign colour[15*c+:15] = value;
    end
  end

  logic sloped;
  logic [28:0] length;
  logic [14:0] light, half;
  fastsplat_classify_normal u_normal (
      .clk_i,
      .we_i(segment_we_i[4]),
      .waddr_i(segment_i[6:0]),
      .wdata_i({segment_word_i[WORD+:15], segment_word_i[0+:15]}),
      .lighting_i,
      .across_scale_i(scales_i[12:0]),
      .along_scale_i(scales_i[28:16]),
      .dx_i(dx_q),
      .dy_i(dy_q),
      .dz_i(dz_q),
      .x_i(x_q2),
      .y_i(y_q2),
      .sloped_o(sloped),
      .length_o(length),
      .light_o(light),
      .half_o(half)
  );
  fastsplat_classify_shade u_shade (
      .clk_i,
      .we_i(segment_we_i[5]),
      .waddr_i(segment_i[6:0]),
      .wdata_i({segment_word_i[WORD+:13], segment_word_i[0+:13]}),
      .lighting_i,
      .colour_i(colour),
      .tau_i(tau),
      .sloped_i(sloped),
      .floor_i,
      .length_i(length),
      .light_i(light),
      .half_i(half),
      .sums_o
  );
  logic unused;
  assign unused = &{1'b0, scales_i, segment_i, segment_word_i};
endmodule
