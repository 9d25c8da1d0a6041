// SPDX-License-Identifier: Apache-2.0
// Exact numbers and formats of docs/numerics.md, section 1, by the definition: a word is a fraction, rounding is an
// exact division. Slow on purpose; shares nothing with the model.
#pragma once

#include <cstdint>

namespace fastsplat::oracle {

/// Products and sums are exact (N-1-2).
__extension__ typedef __int128 Wide;

/// 2^n, 0 <= n < 127.
Wide power_of_two(int n);
/// floor(numerator / denominator) and its remainder in 0..denominator-1; denominator > 0.
Wide floor_divide(Wide numerator, Wide denominator);
Wide remainder(Wide numerator, Wide denominator);
/// ceil(numerator / denominator), denominator > 0.
Wide ceil_divide(Wide numerator, Wide denominator);
/// log2 of a power of two.
int log2_of(Wide power);

enum class Rounding { Trn, Rnd, RndConv };
enum class Overflow { Sat, Wrap };

/// Words smallest..largest in steps of 2^-f (N-1-1).
struct Words {
  Wide smallest;
  Wide largest;
  int f;
};
Words u(int i, int f);
Words s(int i, int f);
Words one(int f);

struct Narrowed {
  Wide word;
  bool inexact;   ///< the rounded word is not the value
  bool overflow;  ///< the rounded word is outside the format
};
Narrowed narrow(Rounding rounding, Overflow overflow, Wide value, int from_f, const Words& words);

}  // namespace fastsplat::oracle
