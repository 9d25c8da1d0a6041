// SPDX-License-Identifier: Apache-2.0
#include "tests/pipeline/oracle/rounding.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace fastsplat::stages::oracle {

namespace {

double power_of_two(int exponent) {
  return exponent < 0 ? 1.0 / static_cast<double>(std::int64_t{1} << -exponent)
                      : static_cast<double>(std::int64_t{1} << exponent);
}

/// A number of this page is some ten operations old, a sum of n of them n 2^-53 more. Fewer than a thousand splats at a
/// pixel never reach 1024 of a double's last bits, of the value or of 1 where a difference made it small. 10^-9 of a
/// step is added, for words so short that it is negligible.
double doubt(double value, int bits) { return 1e-9 + std::max(1.0, std::abs(value)) * power_of_two(bits - 53 + 10); }

}  // namespace

void compare(double value, double edge, int bits, Closeness& closeness) {
  const double apart = std::abs(value - edge) * power_of_two(bits);
  // Values on words are exact: their decisions do not depend on the order of operations.
  if (apart != 0.0 && apart < doubt(value, bits)) closeness.close = true;
}

double rnd(double value, int bits, Closeness& closeness) {
  const double steps = value * power_of_two(bits);
  compare(value, (std::floor(steps) + 0.5) * power_of_two(-bits), bits, closeness);
  return std::floor(steps + 0.5) * power_of_two(-bits);
}

double trn(double value, int bits, Closeness& closeness) {
  const double steps = value * power_of_two(bits);
  compare(value, std::round(steps) * power_of_two(-bits), bits, closeness);
  return std::floor(steps) * power_of_two(-bits);
}

double round_by(int rounding, double value, int bits, Closeness& closeness) {
  switch (static_cast<cmodel::Rounding>(rounding)) {
    case cmodel::Rounding::TRN:
      return trn(value, bits, closeness);
    case cmodel::Rounding::RND:
      return rnd(value, bits, closeness);
    case cmodel::Rounding::RND_CONV:
      break;
  }
  const double steps = value * power_of_two(bits);
  const double below = std::floor(steps);
  const double rest = steps - below;
  compare(value, (below + 0.5) * power_of_two(-bits), bits, closeness);
  const bool below_is_even = std::fmod(below, 2.0) == 0.0;
  const bool down = rest < 0.5 || (rest == 0.5 && below_is_even);
  return (down ? below : below + 1.0) * power_of_two(-bits);
}

double to_float(const FloatFormat& format, bool subnormals, double value, Closeness& closeness) {
  if (value == 0.0 || std::isnan(value)) return value;
  const int bias = (1 << (format.exponent_bits - 1)) - 1, least = 1 - bias, most = format.infinite ? bias : bias + 1;
  // The unit in the last place, as the exponent were unbounded above.
  int exponent = 0;
  std::frexp(std::abs(value), &exponent);
  const int last = std::max(exponent - 1, least) - format.fraction_bits;
  const double steps = std::ldexp(std::abs(value), -last), below = std::floor(steps), rest = steps - below;
  const double apart = std::abs(rest - 0.5);
  if (apart != 0.0 && apart < steps * std::ldexp(1.0, -43)) closeness.close = true;
  const bool up = rest > 0.5 || (rest == 0.5 && std::fmod(below, 2.0) == 1.0);
  const double size = std::ldexp(up ? below + 1.0 : below, last);
  // With infinities the largest exponent holds no numbers; else all but its last word.
  const double greatest =
      std::ldexp(std::ldexp(2.0, format.fraction_bits) - (format.infinite ? 1.0 : 2.0), most - format.fraction_bits);
  if (size > greatest) return std::copysign(format.infinite ? HUGE_VAL : greatest, value);
  if (!subnormals && size < std::ldexp(1.0, least)) return 0.0;
  return std::copysign(size, value);
}

double narrow(const Mixture& mixture, Step step, double value, Closeness& closeness, bool as_sum) {
  if (!mixture.floats(step)) return value;
  const FloatNumbers& numbers = mixture.numbers();
  return to_float(as_sum ? numbers.sums : numbers.operands, numbers.subnormals, value, closeness);
}

double cut(double value, double low, double high) { return std::min(std::max(value, low), high); }

double largest(int int_bits, int frac_bits) { return power_of_two(int_bits) - power_of_two(-frac_bits); }

double to_unsigned(int rounding, double value, int int_bits, int frac_bits, Closeness& closeness) {
  return cut(round_by(rounding, value, frac_bits, closeness), 0.0, largest(int_bits, frac_bits));
}

double to_unit(int rounding, double value, int frac_bits, Closeness& closeness) {
  return cut(round_by(rounding, value, frac_bits, closeness), 0.0, 1.0);
}

}  // namespace fastsplat::stages::oracle
