// SPDX-License-Identifier: Apache-2.0
// a * b of IEEE 754 numbers, to nearest, ties to even, with subnormals. Not part of the device: docs/floats.md compares
// its size.
module float_mul #(
    parameter int E = 5,  // exponent bits
    parameter int F = 10  // fraction bits
) (
    input  logic [E+F:0] a_i,
    input  logic [E+F:0] b_i,
    output logic [E+F:0] product_o
);
  localparam int W = E + 3;
  localparam int BIAS = 2 ** (E - 1) - 1;
  localparam int P = 2 * F + 2;  // bits of a product of significands
  localparam logic [E+F-1:0] INFINITY = {{E{1'b1}}, F'(0)};

  logic sign, nan, infinite, zero, up, sticky;
  logic [P-1:0] product, shifted;
  logic signed [W-1:0] exponent, right;  // biased; places to the right of a subnormal number
  logic [$clog2(P+1)-1:0] zeros;
  logic [E+F:0] rounded;  // with room for a carry

  always_comb begin
    sign = a_i[E+F] ^ b_i[E+F];
    zero = a_i[E+F-1:0] == '0 || b_i[E+F-1:0] == '0;
    infinite = a_i[E+F-1:0] == INFINITY || b_i[E+F-1:0] == INFINITY;
    nan = a_i[E+F-1:0] > INFINITY || b_i[E+F-1:0] > INFINITY || (infinite && zero);
    product = P'({|a_i[E+F-1:F], a_i[F-1:0]}) * P'({|b_i[E+F-1:F], b_i[F-1:0]});
    // The leading bit to the top.
    zeros = '0;
    for (int i = 0; i < P; i++) if (product[i]) zeros = $bits(zeros)'(P - 1 - i);
    exponent = W'({1'b0, a_i[E+F-1:F]}) + W'({1'b0, b_i[E+F-1:F]}) + W'(!(|a_i[E+F-1:F])) +
               W'(!(|b_i[E+F-1:F])) - W'(BIAS - 1) - W'(zeros);
    shifted = product << zeros;
    right = (exponent >= W'(1)) ? '0 : W'(1) - exponent;
    sticky = (right > W'(P)) ? 1'b1 : |(shifted & ~({P{1'b1}} << right));
    shifted = (right > W'(P)) ? '0 : shifted >> right;
    up = shifted[F] && (shifted[F+1] || sticky || |shifted[F-1:0]);
    // The hidden bit adds 1 to the exponent.
    rounded = {(exponent < W'(1)) ? (E + 1)'(0) : (E + 1)'(exponent - W'(1)), F'(0)} + (E + F + 1)'(shifted[P-1:F+1]) + (E + F + 1)'(up);
    if (nan) product_o = {1'b0, INFINITY | ((E + F)'(1) << (F - 1))};
    else if (infinite || rounded >= (E + F + 1)'(INFINITY)) product_o = {sign, zero ? (E + F)'(0) : INFINITY};
    else product_o = {sign, zero ? (E + F)'(0) : rounded[E+F-1:0]};
  end
endmodule
