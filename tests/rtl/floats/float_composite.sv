// SPDX-License-Identifier: Apache-2.0
// A slab over a pixel, as floats: C = C + T c in three channels, T = T (1 - a). The counterpart of fastsplat_composite_lane.
module float_composite #(
    parameter int E = 5,
    parameter int F = 10
) (
    input  logic                 clk_i,
    input  logic [4*(E+F+1)-1:0] slab_i,   // R, G, B, opacity
    input  logic [4*(E+F+1)-1:0] pixel_i,  // R, G, B, transmittance
    output logic [4*(E+F+1)-1:0] pixel_o
);
  localparam logic [E+F:0] ONE = {2'b00, {E - 1{1'b1}}, F'(0)};
  localparam int B = E + F + 1;
  logic [B-1:0] clear, clear_q, before_q, after;
  for (genvar c = 0; c < 3; c++) begin : gen_channel
    logic [B-1:0] light, light_q, colour_q, colour;
    float_mul #(.E(E), .F(F)) u_light (.a_i(pixel_i[3*B+:B]), .b_i(slab_i[c*B+:B]), .product_o(light));
    float_add #(.E(E), .F(F)) u_colour (.a_i(light_q), .b_i(colour_q), .sum_o(colour));
    always_ff @(posedge clk_i) begin
      light_q <= light;
      colour_q <= pixel_i[c*B+:B];
      pixel_o[c*B+:B] <= colour;
    end
  end
  float_add #(.E(E), .F(F)) u_clear (.a_i(ONE), .b_i({~slab_i[4*B-1], slab_i[3*B+:B-1]}), .sum_o(clear));
  float_mul #(.E(E), .F(F)) u_after (.a_i(before_q), .b_i(clear_q), .product_o(after));
  always_ff @(posedge clk_i) begin
    clear_q <= clear;
    before_q <= pixel_i[3*B+:B];
    pixel_o[3*B+:B] <= after;
  end
endmodule
