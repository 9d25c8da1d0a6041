// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/random_ellipse_helper.hpp"

#include <algorithm>
#include <cmath>

namespace fastsplat::test {
namespace {

constexpr std::int64_t kTerm = (std::int64_t{1} << 22) - 1, kMixed = (std::int64_t{1} << 23) - 1;
constexpr int kMostWindows = 32, kReach = 510, kLeast = -512, kMost = 511, kMostShift = 63;

double part(Random& r) { return static_cast<double>(r.between(0, 1 << 20)) / (1 << 20); }

/// The largest |B| of an ellipse.
std::int64_t thinnest(std::int64_t A, std::int64_t C) {
  std::int64_t B = 0;
  for (std::int64_t bit = std::int64_t{1} << 22; bit > 0; bit /= 2)
    if ((B + bit) * (B + bit) <= 4 * A * C) B += bit;
  return B;
}

/// Pixels around the centre that the shape reaches.
struct Reach {
  double x = 1, y = 1;
};

/// From two half axes and a direction, in words of 22 bits.
Reach drawn_shape(const oracle::Symbols& c, Random& r, oracle::Ellipse& e) {
  const double widest = c.columns / 2.0, thin = 0.125;
  const double l = r.once_in(4) ? widest : thin * std::pow(widest / thin, part(r));
  const double s = r.once_in(4) ? l : r.once_in(4) ? thin : thin * std::pow(std::max(l / thin, 1.0), part(r));
  const double turn = r.once_in(4) ? static_cast<double>(r.between(0, 4)) * 0.78539816339744831 : 3.1416 * part(r);
  const double cs = std::cos(turn), sn = std::sin(turn), ll = l * l, ss = s * s;
  const double m = std::ldexp(static_cast<double>(c.N), c.g - 2 * c.pf);
  const double a = m * (cs * cs / ll + sn * sn / ss), d = m * (sn * sn / ll + cs * cs / ss);
  const double b = 2 * m * cs * sn * (1 / ll - 1 / ss);
  e.h = std::clamp(21 - static_cast<int>(std::floor(std::log2(std::max(a, d)))), 0, kMostShift);
  const auto term = [&](double value) {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::ceil(std::ldexp(value, e.h))), 0, kTerm);
  };
  e.A = term(a), e.C = term(d);
  const std::int64_t B =
      std::min(thinnest(e.A, e.C), static_cast<std::int64_t>(std::floor(std::ldexp(std::abs(b), e.h))));
  e.B = b < 0 ? -B : B;
  return {std::sqrt(ll * cs * cs + ss * sn * sn), std::sqrt(ll * sn * sn + ss * cs * cs)};
}

/// Arbitrary legal words: ends, strips, and shifts that put the rim anywhere or nowhere.
Reach drawn_words(const oracle::Symbols& c, Random& r, oracle::Ellipse& e) {
  const auto term = [&]() -> std::int64_t {
    if (r.once_in(3)) return r.one_of({0, 1, 2, kTerm / 2, kTerm - 1, kTerm});
    return r.between(0, kTerm) >> r.between(0, 21);
  };
  e.A = term(), e.C = r.once_in(3) ? e.A : term();
  e.B = std::min(thinnest(e.A, e.C), kMixed);
  if (!r.once_in(3)) e.B = r.between(0, e.B);
  if (r.once_in(2)) e.B = -e.B;
  // Where the rim would be r pixels away along the larger term.
  const double pixels = std::ldexp(1.0, static_cast<int>(r.between(-2, 5)));
  const auto rim = static_cast<double>(c.N) * std::ldexp(1.0, c.g);
  const double scale =
      static_cast<double>(std::max<std::int64_t>({e.A, e.C, 1})) * std::ldexp(pixels * pixels, 2 * c.pf);
  e.h = std::clamp(static_cast<int>(std::lround(std::log2(scale / rim))), 0, kMostShift);
  if (r.once_in(6)) e.h = static_cast<int>(r.one_of({0, kMostShift, r.between(0, kMostShift)}));
  return {pixels, pixels};
}

/// Windows along one axis: over the shape, over a part of it, or anywhere.
void span(const oracle::Symbols& c, Random& r, double reach, int& begin, int& count) {
  const auto ceil = static_cast<std::int64_t>(std::ceil(std::min(reach, 512.0)));
  const std::int64_t most = r.once_in(8) ? kMostWindows : r.between(1, std::max(4, 32 / c.P));
  switch (r.between(0, 7)) {
    case 0:  // beside it
      begin = static_cast<int>(r.between(-2 * ceil - c.P, 2 * ceil + 1));
      count = static_cast<int>(r.between(1, 3));
      break;
    case 1:  // the ends of the words
      begin = static_cast<int>(r.one_of({kLeast, kLeast + 1, kMost - c.P, kReach - c.P, -c.P, -1, 0, 1}));
      count = static_cast<int>(r.once_in(6) ? r.between(1, kMostWindows) : r.between(1, 2));
      break;
    default: {  // over it, as far as the windows go
      begin = static_cast<int>(-ceil + r.between(-1, 1));
      count = static_cast<int>(std::min((2 * ceil + c.P) / c.P, most));
      if (2 * ceil > count * c.P && r.once_in(2)) begin = static_cast<int>(-count * c.P / 2);
    }
  }
  begin = std::clamp(begin, kLeast, kMost);
  count = std::clamp(count, 1, kMostWindows);
}

}  // namespace

void random_shape(const oracle::Symbols& c, Random& r, oracle::Ellipse& e) {
  const Reach reach = r.once_in(3) ? drawn_words(c, r, e) : drawn_shape(c, r, e);
  span(c, r, reach.x, e.left, e.nx);
  span(c, r, reach.y, e.top, e.ny);
  // Large ones are rare: they cost as much as all the others.
  const int most = r.once_in(60) ? 1024 : std::max(24, 800 / (c.P * c.P));
  while (e.nx * e.ny > most) (e.nx > e.ny ? e.nx : e.ny) /= 2;
  const bool steep = r.once_in(5);
  if (steep && r.once_in(2)) {  // in the middle of few pixels
    e.nx = static_cast<int>(r.between(1, 2)), e.ny = static_cast<int>(r.between(1, 2));
    e.left = static_cast<int>(r.between(0, 1)) - e.nx * c.P / 2,
    e.top = static_cast<int>(r.between(0, 1)) - e.ny * c.P / 2;
  }
  // Until the rule holds: fewer windows, then windows nearer to the centre, finally a wider shape.
  while (oracle::broken_shape(c, e) != nullptr) {
    if (e.nx > 1 || e.ny > 1)
      (e.nx > e.ny ? e.nx : e.ny) /= 2;
    else if (e.left + c.P > kReach || e.top + c.P > kReach || r.once_in(2))
      e.left /= 2, e.top /= 2;
    else
      e.h = std::min(e.h + 1, kMostShift);
  }
  // The steepest q that the rule allows: its coefficients may leave their words.
  while (steep && e.h > 0) {
    --e.h;
    if (oracle::broken_shape(c, e) == nullptr) continue;
    ++e.h;
    break;
  }
}

}  // namespace fastsplat::test
