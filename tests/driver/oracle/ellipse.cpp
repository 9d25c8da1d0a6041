// SPDX-License-Identifier: Apache-2.0
#include "tests/driver/oracle/ellipse.hpp"

#include <algorithm>
#include <cmath>

namespace fastsplat::scene_oracle {
namespace {

/// F (N-8-44), at least a quarter of a pixel across (N-8-45).
Shape footprint(const Given& given, const Shape& s, EllipseWords& words) {
  Shape F{given.R * given.R * s.xx, given.R * given.R * s.xy, given.R * given.R * s.yy};
  const double half = (F.xx - F.yy) / 2, apart = std::hypot(half, F.xy);
  const double least = (F.xx + F.yy) / 2 - apart;
  if (least >= 1.0 / 16) return F;
  // N-8-45: across, that is, along the direction of the lesser root; if both are less, both ways.
  words.thin = true;
  const double more = 1.0 / 16 - least;
  const double before = F.xx * F.yy - F.xy * F.xy;
  const double cos = apart > 0.0 ? half / apart : 1.0, sin = apart > 0.0 ? F.xy / apart : 0.0;  // of twice the angle
  if ((F.xx + F.yy) / 2 + apart <= 1.0 / 16) {
    F = {1.0 / 16, 0.0, 1.0 / 16};
  } else {
    F.xx += more * (1 - cos) / 2;
    F.yy += more * (1 + cos) / 2;
    F.xy -= more * sin / 2;
  }
  // N-8-46.
  words.factor = std::sqrt(before / (F.xx * F.yy - F.xy * F.xy));
  return F;
}

std::int64_t pixel_after(double at, double one) { return static_cast<std::int64_t>(std::floor(at / one)) + 1; }
std::int64_t pixel_before(double at, double one) { return static_cast<std::int64_t>(std::ceil(at / one)) - 1; }

}  // namespace

/// N-8-39.
bool shaped(const Given& given) { return given.symbols.f > 0 && given.shapes; }

/// N-8-43.
bool is_circle_of(const Given& given, const Shape& shape, double r_max) {
  if (shape.xx != shape.yy || shape.xy != 0.0) return false;
  const double r = given.R * std::sqrt(shape.xx);
  return std::abs(r - r_max) <= 1e-9 * r;
}

EllipseWords ellipse_words(const Given& given, const Shape& shape, std::int64_t xq, std::int64_t yq) {
  const oracle::Symbols& c = given.symbols;
  EllipseWords out;
  const Shape F = footprint(given, shape, out);
  // N-8-47.
  const double m = (1.0 - std::ldexp(1.0, -40)) * c.N * std::ldexp(1.0, c.g) / std::ldexp(1.0, 2 * c.pf);
  const double a = m / (F.xx - F.xy * (F.xy / F.yy)), d = m / (F.yy - F.xy * (F.xy / F.xx));
  const double b = -2 * (a * (F.xy / F.yy));
  // N-8-48.
  int h = std::clamp(21 - static_cast<int>(std::floor(std::log2(std::max(a, d)))), 0, 63);
  if (std::ceil(std::ldexp(std::max(a, d), h)) == 4194304.0) --h;
  out.h = h;
  out.A = static_cast<std::int64_t>(std::ceil(std::ldexp(a, h)));
  out.C = static_cast<std::int64_t>(std::ceil(std::ldexp(d, h)));
  out.B = std::min(static_cast<std::int64_t>(std::floor(std::ldexp(std::abs(b), h))),
                   static_cast<std::int64_t>(std::floor(std::sqrt(4.0 * static_cast<double>(out.A * out.C)))));
  if (b < 0.0) out.B = -out.B;

  const double one = std::ldexp(1.0, c.pf);
  const auto pixel = static_cast<std::int64_t>(one);
  const auto within = [&](std::int64_t q) { return static_cast<double>(((q % pixel) + pixel) % pixel); };
  const double x = within(xq), y = within(yq);
  const double r2 = std::ldexp(c.N * std::ldexp(1.0, c.g), h);
  const auto A = static_cast<double>(out.A), B = static_cast<double>(out.B), C = static_cast<double>(out.C);
  const auto det = static_cast<double>(4 * out.A * out.C - out.B * out.B);
  // N-8-50: the rows. N-8-54: the half sides.
  const double H = std::sqrt(4 * A * r2 / det), widest = std::sqrt(4 * C * r2 / det);
  const double p = -B * widest / (2 * C);
  const std::int64_t first = pixel_after(y - H, one), last = pixel_before(y + H, one);
  out.too_large = std::max(H, widest) / one > c.columns / 2.0;
  for (std::int64_t row = first; row <= last; row += c.P) {
    // N-8-51: the columns.
    const double top = std::max(static_cast<double>(row) * one - y, -H);
    const std::int64_t last_row = std::min(row + c.P - 1, last);  // of the footprint's rows
    const double bottom = std::min(static_cast<double>(last_row) * one - y, H);
    const auto s = [&](double at) { return std::sqrt(std::max((r2 - at * at * (det / (4 * A))) / A, 0.0)); };
    const double on_left = std::clamp(-p, top, bottom), on_right = std::clamp(p, top, bottom);
    const std::int64_t left = pixel_after(x + (-B * on_left / (2 * A) - s(on_left)), one);
    const std::int64_t right = pixel_before(x + (-B * on_right / (2 * A) + s(on_right)), one);
    // N-8-52: windows and records.
    if (right < left) continue;
    const std::int64_t nx = (right - left + c.P) / c.P;
    Span* before = out.spans.empty() ? nullptr : &out.spans.back();
    if (before != nullptr && before->top + before->ny * c.P == row && before->left == left && before->nx == nx) {
      ++before->ny;
      before->last_row = last_row;
      before->last_column = std::max(before->last_column, right);
      continue;
    }
    out.spans.push_back({left, row, nx, 1, right, last_row});
  }
  return out;
}

}  // namespace fastsplat::scene_oracle
