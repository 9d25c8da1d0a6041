// SPDX-License-Identifier: Apache-2.0
// Rounding for the oracle of the mixtures: docs/numerics.md, section 1, for numbers that need not be words.
#pragma once

#include "analysis/pipeline/step.hpp"
#include "cmodel/numbers/narrow.hpp"

namespace fastsplat::stages::oracle {

/// Whether a value decides something (a rounding, a comparison) so closely that another order of the same operations
/// may decide otherwise. Words exactly on the edge (half a step is a tie) are not close: they are exact.
struct Closeness {
  bool close = false;
  void operator|=(const Closeness& other) { close = close || other.close; }
};

/// Records that `value` is nearer to `edge` than its own last bits, in units of 2^-bits, can be trusted.
void compare(double value, double edge, int bits, Closeness& closeness);

/// floor(v 2^bits + 1/2) 2^-bits.
double rnd(double value, int bits, Closeness& closeness);
/// floor(v 2^bits) 2^-bits.
double trn(double value, int bits, Closeness& closeness);
/// One of section 1's roundings: an int as the configuration keeps it. No range.
double round_by(int rounding, double value, int bits, Closeness& closeness);

/// The nearest number of a floating-point format, ties to even (docs/floats.md).
double to_float(const FloatFormat& format, bool subnormals, double value, Closeness& closeness);
/// The same if `step` is floats, else the value; `as_sum`: in the format of sums.
double narrow(const Mixture& mixture, Step step, double value, Closeness& closeness, bool as_sum = false);

double cut(double value, double low, double high);
/// Largest value of U i.f.
double largest(int int_bits, int frac_bits);
/// Rounded, then the nearer end of U i.f.
double to_unsigned(int rounding, double value, int int_bits, int frac_bits, Closeness& closeness);
/// Rounded, then the nearer end of One.f.
double to_unit(int rounding, double value, int frac_bits, Closeness& closeness);

}  // namespace fastsplat::stages::oracle
