// SPDX-License-Identifier: Apache-2.0
// One lane of the splat array: q, radial table, four products (docs/numerics.md, sections 4 and 5;
// cmodel/splat/footprint.hpp, cmodel/splat/lane.hpp).
// Registers: c4 (q), c5 (table read), c6 (products); with interpolation two more behind c5. Outputs follow their inputs
// by three cycles, or five, and hold while the stage before has no window.
`include "fault.svh"
`include "narrow.svh"

module fastsplat_lane (
    input  logic                                    clk_i,
    // radial table load
    input  logic                                    we_i,
    input  logic [fastsplat_pkg::RADIAL_LOG2-1:0]   waddr_i,
    input  logic [fastsplat_pkg::RADIAL_BITS-1:0]   wdata_i,   // an entry; with interpolation {entry, the next one}
    // stages that hold a window: c3, c4, c5 (with interpolation c5, i1, i2)
    input  logic [5+fastsplat_pkg::WEIGHT_DELAY:3]  valid_i,
    // c3
    input  logic [fastsplat_pkg::RLUT_BITS-1:0]     column_i,  // RLUT word of this lane's column
    input  logic [fastsplat_pkg::RLUT_BITS-1:0]     row_i,     // and row
    input  logic                                    ellipse_i,  // or, of an ellipse, three words whose sum is q
    input  logic [fastsplat_pkg::ELLIPSE_BITS-1:0]  ellipse_column_i,
    input  logic [fastsplat_pkg::ELLIPSE_BITS-1:0]  ellipse_row_i,
    input  logic [fastsplat_pkg::ELLIPSE_BITS-1:0]  ellipse_cross_i,
    // with the weight (c5, or i2): the splat's colour
    input  logic [4*fastsplat_pkg::COLOUR_BITS-1:0] colour_i,
    output logic [fastsplat_pkg::WEIGHT_BITS-1:0]   weight_o,   // with products_o
    output logic [4*fastsplat_pkg::SHEET_BITS-1:0]  products_o,
    output logic [3:0]                              saturated_o
);
  localparam int QW = fastsplat_pkg::RLUT_BITS + 1;
  localparam int CB = fastsplat_pkg::COLOUR_BITS;
  localparam int SB = fastsplat_pkg::SHEET_BITS;
  localparam int WB = fastsplat_pkg::WEIGHT_BITS;
  localparam int GB = fastsplat_pkg::GUARD;
  localparam int LAST = 5 + fastsplat_pkg::WEIGHT_DELAY;  // the stage that holds the weight
  `FASTSPLAT_NARROW(narrow_product, CB + WB, SB, PRODUCT)

  // c4: the edge of the support and everything beyond read as weight 0
  logic [QW-1:0] q;
  logic [fastsplat_pkg::RADIAL_LOG2-1:0] index_q;
  logic outside_q, outside_q2;
  assign q = {1'b0, column_i} + {1'b0, row_i};
  logic [fastsplat_pkg::RADIAL_LOG2-1:0] ellipse_index;
  logic ellipse_outside;
  logic [(GB>0?GB:1)-1:0] ellipse_rest;  // bits of q below the index
  if (fastsplat_pkg::ELLIPSES != 0) begin : gen_ellipse
    localparam int QB = fastsplat_pkg::ELLIPSE_BITS;
    localparam int BELOW = fastsplat_pkg::GUARD + fastsplat_pkg::ELLIPSE_FRAC;
    logic [QB-1:0] sum;
    logic below;
    assign sum = ellipse_column_i + ellipse_row_i + ellipse_cross_i;
    // q at a centre may be slightly below 0.
    assign below = sum[QB-1] && !`FASTSPLAT_FAULT(ELLIPSE_BELOW);
    assign ellipse_index = below ? '0 : sum[BELOW+:fastsplat_pkg::RADIAL_LOG2];
    assign ellipse_outside = !below && sum[QB-2:BELOW+fastsplat_pkg::RADIAL_LOG2] != '0;
    if (GB > 0) begin : gen_rest
      assign ellipse_rest = below ? '0 : sum[fastsplat_pkg::ELLIPSE_FRAC+:GB];
    end else begin : gen_no_rest
      assign ellipse_rest = '0;
    end
    logic unused_bits;
    assign unused_bits = &{1'b0, sum[BELOW-1:0]};
  end else begin : gen_circles
    assign ellipse_index = '0;
    assign ellipse_outside = 1'b0;
    assign ellipse_rest = '0;
    logic unused_words;
    assign unused_words = &{1'b0, ellipse_column_i, ellipse_row_i, ellipse_cross_i};
  end
  always_ff @(posedge clk_i) begin
    if (valid_i[3]) begin
      index_q <= ellipse_i ? ellipse_index : q[fastsplat_pkg::GUARD+:fastsplat_pkg::RADIAL_LOG2];
      outside_q <= ellipse_i ? ellipse_outside : |q[QW-1:fastsplat_pkg::GUARD+fastsplat_pkg::RADIAL_LOG2];
    end
    if (valid_i[4]) outside_q2 <= outside_q;
  end

  logic unused;
  assign unused = &{1'b0, q, ellipse_rest};

  // c5
  logic [fastsplat_pkg::RADIAL_BITS-1:0] table_word;
  logic [WB-1:0] weight;
  fastsplat_ram_1r1w #(.BITS(fastsplat_pkg::RADIAL_BITS), .WORDS(fastsplat_pkg::RADIAL_ENTRIES), .ADDR(fastsplat_pkg::RADIAL_LOG2)) u_radial (
      .clk_i,
      .re_i(valid_i[4]),
      .raddr_i(index_q),
      .rdata_o(table_word),
      .we_i,
      .waddr_i,
      .wdata_i
  );

  // i1: difference of the entries times the rest; i2: the interpolated weight (docs/numerics.md, N-4.7-3).
  if (fastsplat_pkg::INTERPOLATE != 0) begin : gen_line
    localparam int FALL = WB + 1 + GB + 1;  // of the product, two's complement
    localparam int SHIFT = fastsplat_pkg::SHIFT_RADIAL_FALL;
    localparam logic signed [FALL-1:0] HALF = (fastsplat_pkg::ROUND_RADIAL_FALL != 0) ? FALL'(1) << (SHIFT - 1) : '0;
    logic [GB-1:0] rest_q, rest_q2;
    logic outside_i1_q;
    logic [WB-1:0] entry_q, weight_q;
    logic signed [WB:0] difference;
    logic signed [FALL-1:0] fall_q;
    assign difference = $signed({1'b0, table_word[WB+:WB]}) - $signed({1'b0, table_word[WB-1:0]});
    always_ff @(posedge clk_i) begin
      if (valid_i[3]) rest_q <= ellipse_i ? ellipse_rest : q[GB-1:0];
      if (valid_i[4]) rest_q2 <= rest_q;
      if (valid_i[5]) begin
        outside_i1_q <= outside_q2;
        entry_q <= table_word[WB+:WB];
        fall_q <= FALL'(difference) * $signed(FALL'({1'b0, `FASTSPLAT_FAULT(POST_STEPS) ? GB'(0) : `FASTSPLAT_FAULT(POST_REST) ? rest_q : rest_q2}));
      end
      if (valid_i[6]) weight_q <= outside_i1_q ? '0 : entry_q - WB'((fall_q + HALF) >>> SHIFT);
    end
    assign weight = weight_q;
  end else begin : gen_step
    assign weight = outside_q2 ? '0 : table_word;
  end

  // c6: {overflow, word} by channel
  for (genvar c = 0; c < 4; c++) begin : gen_channel
    logic [SB:0] product_q;
    always_ff @(posedge clk_i) begin
      if (valid_i[LAST]) product_q <= narrow_product((CB + WB)'(colour_i[c*CB+:CB]) * (CB + WB)'(weight));
    end
    assign products_o[c*SB+:SB] = product_q[SB-1:0];
    assign saturated_o[c] = product_q[SB];
  end
  always_ff @(posedge clk_i) if (valid_i[LAST]) weight_o <= weight;
endmodule
