// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/oracle/ellipse.hpp"

namespace fastsplat::oracle {
namespace {

/// N-4.6-5: the words of the coefficients and of q.
Words form_words(const Symbols& c) { return s(log2_of(c.N) + c.g + 2 * log2_of(c.P) + 10, c.f); }

}  // namespace

// N-4.6-3: the first pixel.
FirstPixel first_pixel(const Symbols& c, const Ellipse& e) {
  const Wide pixel = power_of_two(c.pf);
  const Wide x0 = floor_divide(e.x, pixel) + e.left, y0 = floor_divide(e.y, pixel) + e.top;
  return {x0, y0, x0 * pixel - e.x, y0 * pixel - e.y};
}

const char* broken_shape(const Symbols& c, const Ellipse& e) {
  // S-ellipse-4.
  if (4 * Wide{e.A} * e.C < Wide{e.B} * e.B) return "no ellipse";
  // S-ellipse-5.
  if (e.left + e.nx * c.P > 510) return "windows too far right";
  if (e.top + e.ny * c.P > 510) return "windows too far down";
  // S-ellipse-6.
  const Wide largest = 256 * Wide{c.P} * c.P * c.N * power_of_two(c.g);
  const FirstPixel first = first_pixel(c, e);
  for (const int j : {0, e.ny * c.P - 1})
    for (const int i : {0, e.nx * c.P - 1}) {
      const Wide dx = first.X + i * power_of_two(c.pf), dy = first.Y + j * power_of_two(c.pf);
      const Wide q = e.A * dx * dx + e.B * dx * dy + e.C * dy * dy;
      if (floor_divide(q, power_of_two(e.h)) >= largest) return "q at a corner";
    }
  return nullptr;
}

// N-4.6-5: the six coefficients.
EllipseForm::EllipseForm(const Symbols& c, const Ellipse& r) : words(form_words(c)), step(power_of_two(c.f)) {
  const auto n = [&](Wide value) {
    const Narrowed narrowed = narrow(Rounding::Rnd, Overflow::Wrap, value, r.h, words);
    wrapped_ = wrapped_ || narrowed.overflow;
    return narrowed.word;
  };
  const FirstPixel first = first_pixel(c, r);
  const Wide X = first.X, Y = first.Y, pixel = power_of_two(c.pf);
  u0 = n(r.A * X * X + r.B * X * Y + r.C * Y * Y);
  u1 = n(pixel * (2 * r.A * X + r.B * Y));
  u2 = n(pixel * pixel * r.A);
  v1 = n(pixel * (2 * r.C * Y + r.B * X));
  v2 = n(pixel * pixel * r.C);
  e = n(pixel * pixel * r.B);
}

// N-4.6-6: q; N-4.6-7: below 0 it counts as 0.
Wide EllipseForm::steps(std::int64_t i, std::int64_t j) const {
  const Wide exact = u0 + i * u1 + Wide{i} * i * u2 + j * v1 + Wide{j} * j * v2 + Wide{i} * j * e;
  const Wide q = narrow(Rounding::Trn, Overflow::Wrap, exact, words.f, words).word;
  return q < 0 ? 0 : floor_divide(q, step);
}

}  // namespace fastsplat::oracle
