// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/oracle/number.hpp"

#include <cassert>

namespace fastsplat::oracle {

Wide power_of_two(int n) {
  assert(n >= 0 && n < 127);
  return Wide{1} << n;
}

Wide floor_divide(Wide numerator, Wide denominator) {
  assert(denominator > 0);
  const Wide quotient = numerator / denominator;  // C++ rounds towards zero
  return numerator % denominator < 0 ? quotient - 1 : quotient;
}

Wide remainder(Wide numerator, Wide denominator) {
  return numerator - floor_divide(numerator, denominator) * denominator;
}

Wide ceil_divide(Wide numerator, Wide denominator) { return -floor_divide(-numerator, denominator); }

int log2_of(Wide power) {
  int n = 0;
  while (power_of_two(n) < power) ++n;
  assert(power_of_two(n) == power);
  return n;
}

// N-1-1: the formats.
Words u(int i, int f) { return {0, power_of_two(i + f) - 1, f}; }
Words s(int i, int f) { return {-power_of_two(i + f - 1), power_of_two(i + f - 1) - 1, f}; }
Words one(int f) { return {0, power_of_two(f), f}; }

Narrowed narrow(Rounding rounding, Overflow overflow, Wide value, int from_f, const Words& words) {
  // The result is value / 2^from_f in units of 2^-f: the fraction n / d.
  const int dropped = from_f - words.f;
  const Wide n = dropped < 0 ? value * power_of_two(-dropped) : value;
  const Wide d = dropped > 0 ? power_of_two(dropped) : 1;
  const Wide below = floor_divide(n, d);
  const Wide rest = n - below * d;  // the fraction lies rest/d above `below`

  // N-1-3: rounding.
  Wide word = below;
  switch (rounding) {
    case Rounding::Trn:
      break;
    case Rounding::Rnd:
      if (2 * rest >= d) word = below + 1;
      break;
    case Rounding::RndConv:
      if (2 * rest > d || (2 * rest == d && remainder(below, 2) == 1)) word = below + 1;
      break;
  }

  // N-1-4: the range; N-1-5: the reports.
  const bool outside = word < words.smallest || word > words.largest;
  if (outside && overflow == Overflow::Sat) word = word < words.smallest ? words.smallest : words.largest;
  if (outside && overflow == Overflow::Wrap)
    word = words.smallest + remainder(word - words.smallest, words.largest - words.smallest + 1);
  return {word, rest != 0, outside};
}

}  // namespace fastsplat::oracle
