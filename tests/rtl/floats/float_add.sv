// SPDX-License-Identifier: Apache-2.0
// a + b of IEEE 754 numbers, to nearest, ties to even, with subnormals. Not part of the device: docs/floats.md compares
// its size.
module float_add #(
    parameter int E = 5,  // exponent bits
    parameter int F = 10  // fraction bits
) (
    input  logic [E+F:0] a_i,
    input  logic [E+F:0] b_i,
    output logic [E+F:0] sum_o
);
  localparam int S = F + 5;  // carry, hidden bit, fraction, guard, round, sticky
  localparam logic [E+F-1:0] INFINITY = {{E{1'b1}}, F'(0)};

  logic swap, minus, nan, infinite, up;
  logic sign;
  logic [E+F-1:0] greater, lesser;  // magnitudes
  logic [E-1:0] of_greater, of_lesser, apart;  // biased exponents of at least 1
  logic [S-1:0] first, second, lost, sum;
  logic [$clog2(S+1)-1:0] zeros;
  logic [E-1:0] left;     // places to the left
  logic [E:0] exponent;   // of the result, biased
  logic [E+F:0] rounded;  // with room for a carry

  always_comb begin
    swap = b_i[E+F-1:0] > a_i[E+F-1:0];
    sign = swap ? b_i[E+F] : a_i[E+F];
    greater = swap ? b_i[E+F-1:0] : a_i[E+F-1:0];
    lesser = swap ? a_i[E+F-1:0] : b_i[E+F-1:0];
    minus = a_i[E+F] ^ b_i[E+F];
    infinite = greater == INFINITY;
    nan = greater > INFINITY || (infinite && minus && lesser == INFINITY);
    of_greater = greater[E+F-1:F] | E'(!(|greater[E+F-1:F]));
    of_lesser = lesser[E+F-1:F] | E'(!(|lesser[E+F-1:F]));
    apart = of_greater - of_lesser;
    first = {1'b0, |greater[E+F-1:F], greater[F-1:0], 3'b0};
    second = {1'b0, |lesser[E+F-1:F], lesser[F-1:0], 3'b0};
    lost = (32'(apart) >= S) ? second : second & ~({S{1'b1}} << apart);
    second = ((32'(apart) >= S) ? '0 : second >> apart) | S'(|lost);
    sum = minus ? first - second : first + second;
    // The leading bit to its place, not farther than subnormal numbers have it.
    zeros = '0;
    for (int i = 0; i < S - 1; i++) if (sum[i]) zeros = $bits(zeros)'(S - 2 - i);
    left = (32'(zeros) >= 32'(of_greater)) ? of_greater - E'(1) : E'(zeros);
    exponent = (E + 1)'(of_greater) - (E + 1)'(left);
    if (sum[S-1]) begin
      sum = (sum >> 1) | S'(sum[0]);
      exponent = (E + 1)'(of_greater) + (E + 1)'(1);
    end else begin
      sum = sum << left;
    end
    up = sum[2] && (sum[3] || |sum[1:0]);
    // The hidden bit adds 1 to the exponent.
    rounded = {exponent - (E + 1)'(1), F'(0)} + (E + F + 1)'(sum[S-2:3]) + (E + F + 1)'(up);
    if (nan) sum_o = {1'b0, INFINITY | ((E + F)'(1) << (F - 1))};
    else if (infinite || rounded >= (E + F + 1)'(INFINITY)) sum_o = {sign, INFINITY};
    else if (sum == '0) sum_o = {a_i[E+F] && b_i[E+F], (E + F)'(0)};
    else sum_o = {sign, rounded[E+F-1:0]};
  end
endmodule
