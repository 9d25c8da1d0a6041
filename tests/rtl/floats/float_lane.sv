// SPDX-License-Identifier: Apache-2.0
// What a lane adds to a sheet's pixel, as floats: four channels, S = S + w v. The counterpart of fastsplat_lane behind its
// table, and of a sheet bank's adders.
module float_lane #(
    parameter int E = 5,
    parameter int F = 10
) (
    input  logic                 clk_i,
    input  logic [E+F:0]         weight_i,
    input  logic [4*(E+F+1)-1:0] value_i,
    input  logic [4*(E+F+1)-1:0] sums_i,
    output logic [4*(E+F+1)-1:0] sums_o
);
  localparam int B = E + F + 1;
  for (genvar c = 0; c < 4; c++) begin : gen_channel
    logic [E+F:0] product, product_q, sum, sum_q;
    float_mul #(.E(E), .F(F)) u_product (.a_i(weight_i), .b_i(value_i[c*B+:B]), .product_o(product));
    float_add #(.E(E), .F(F)) u_sum (.a_i(product_q), .b_i(sums_i[c*B+:B]), .sum_o(sum));
    always_ff @(posedge clk_i) begin
      product_q <= product;
      sum_q <= sum;
    end
    assign sums_o[c*B+:B] = sum_q;
  end
endmodule
