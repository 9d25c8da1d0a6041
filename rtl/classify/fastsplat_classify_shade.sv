// SPDX-License-Identifier: Apache-2.0
// Shades a pixel's colour and multiplies it by its optical depth (docs/numerics.md, N-6.2-11 to N-6.2-13;
// cmodel/classify/classify_unit.cpp).
// Registers: d15 share and matt, not rounded -> d16 -> d17 GLINT, colour times matt -> d18 -> d19 shaded minus unshaded
// -> d20 share of it -> d21 colour -> d22 -> d23 sums.
module fastsplat_classify_shade (
    input  logic clk_i,
    // GLINT
    input  logic        we_i,
    input  logic [6:0]  waddr_i,
    input  logic [25:0] wdata_i,
    input  logic [13*32-1:0] lighting_i,
    // d5
    input  logic [44:0] colour_i,  // B, G, R, One.14
    input  logic [fastsplat_pkg::SHEET_BITS-1:0] tau_i,
    // d9
    input  logic        sloped_i,
    // d14
    input  logic [31:0] floor_i,   // 1/floor of the slope, U 24.8
    input  logic [28:0] length_i,
    input  logic [14:0] light_i,
    input  logic [14:0] half_i,
    // d23
    output logic [4*fastsplat_pkg::SHEET_BITS-1:0] sums_o
);
  localparam int SB = fastsplat_pkg::SHEET_BITS;
  logic [15:0] ambient, diffuse, specular;
  assign ambient = lighting_i[32*6+:16];
  assign diffuse = lighting_i[32*7+:16];
  assign specular = lighting_i[32*8+:16];

  // d15, d16: the share of shading, matt light
  logic sloped_d15;
  fastsplat_delay #(.BITS(1), .STAGES(6)) u_sloped (.clk_i, .rst_ni(1'b1), .data_i(sloped_i), .data_o(sloped_d15));
  logic [60:0] lengths_q;
  logic signed [62:0] above;
  logic [30:0] matt_sum_q;
  logic [16:0] matt_q;
  logic [8:0] share_q, share_d19;
  assign above = ($signed({2'b00, lengths_q}) - 63'sh1_0000_0000 + 63'sh80_0000) >>> 24;
  always_ff @(posedge clk_i) begin
    lengths_q <= 61'(length_i) * 61'(floor_i);
    matt_sum_q <= {1'b0, ambient, 14'b0} + 31'(diffuse) * 31'(light_i);
    share_q <= (!sloped_d15 || above < 0) ? '0 : (above > 63'sd256) ? 9'd256 : above[8:0];
    matt_q <= 17'((32'(matt_sum_q) + 32'd8192) >> 14);
  end
  fastsplat_delay #(.BITS(9), .STAGES(3)) u_share (.clk_i, .rst_ni(1'b1), .data_i(share_q), .data_o(share_d19));

  // d17: GLINT; 1.0 is the end of its last segment. d18: the glint's light
  logic full;
  logic [6:0] index;
  logic [7:0] rest;
  logic [12:0] glint;
  logic [28:0] glint_q;
  assign full = half_i[14];
  assign index = full ? '1 : half_i[13:7];
  assign rest = full ? 8'd128 : {1'b0, half_i[6:0]};
  fastsplat_classify_line #(.BITS(13), .WORDS(128), .ADDR(7), .REST(7)) u_glint (
      .clk_i, .we_i, .waddr_i, .wdata_i, .index_i(index), .rest_i(rest), .value_o(glint)
  );
  always_ff @(posedge clk_i) glint_q <= 29'(glint) * 29'(specular);

  logic [44:0] colour_d16, colour_d18, colour_d20;
  fastsplat_delay #(.BITS(45), .STAGES(11)) u_colour_d16 (.clk_i, .rst_ni(1'b1), .data_i(colour_i), .data_o(colour_d16));
  fastsplat_delay #(.BITS(45), .STAGES(2)) u_colour_d18 (.clk_i, .rst_ni(1'b1), .data_i(colour_d16), .data_o(colour_d18));
  fastsplat_delay #(.BITS(45), .STAGES(2)) u_colour_d20 (.clk_i, .rst_ni(1'b1), .data_i(colour_d18), .data_o(colour_d20));
  logic [SB-1:0] tau_d21, tau_d23;
  fastsplat_delay #(.BITS(SB), .STAGES(16)) u_tau_d21 (.clk_i, .rst_ni(1'b1), .data_i(tau_i), .data_o(tau_d21));
  fastsplat_delay #(.BITS(SB), .STAGES(2)) u_tau_d23 (.clk_i, .rst_ni(1'b1), .data_i(tau_d21), .data_o(tau_d23));

  for (genvar c = 0; c < 3; c++) begin : gen_channel
    logic [31:0] matt_d17_q, matt_d18_q;
    logic signed [33:0] more_q;       // shaded minus unshaded
    logic signed [42:0] more_share_q;
    logic signed [43:0] lit;
    logic [16:0] lit_q;               // One.16
    logic [SB+16:0] product_q;
    logic [SB-1:0] sum_q;
    assign lit = ($signed(44'({colour_d20[15*c+:15], 20'b0})) + 44'(more_share_q) + 44'sd131072) >>> 18;
    always_ff @(posedge clk_i) begin
      matt_d17_q <= 32'(colour_d16[15*c+:15]) * 32'(matt_q);
      matt_d18_q <= matt_d17_q;
      more_q <= $signed(34'(matt_d18_q)) + $signed(34'({glint_q, 2'b00})) - $signed(34'({colour_d18[15*c+:15], 12'b0}));
      more_share_q <= 43'(more_q) * $signed(43'(share_d19));
      lit_q <= (lit < 0) ? '0 : (lit > 44'sd65536) ? 17'd65536 : lit[16:0];
      product_q <= (SB + 17)'(lit_q) * (SB + 17)'(tau_d21);
      sum_q <= SB'(((SB + 18)'(product_q) + (SB + 18)'(32768)) >> 16);
    end
    assign sums_o[c*SB+:SB] = sum_q;
  end
  assign sums_o[3*SB+:SB] = tau_d23;
  logic unused;
  assign unused = &{1'b0, lighting_i};
endmodule
