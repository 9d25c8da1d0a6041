// SPDX-License-Identifier: Apache-2.0
// Both operators, for an exhaustive comparison.
module operators #(
    parameter int E = 5,
    parameter int F = 10
) (
    input  logic [E+F:0] a_i,
    input  logic [E+F:0] b_i,
    output logic [E+F:0] sum_o,
    output logic [E+F:0] product_o
);
  float_add #(.E(E), .F(F)) u_add (.a_i, .b_i, .sum_o);
  float_mul #(.E(E), .F(F)) u_mul (.a_i, .b_i, .product_o);
endmodule
