// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/oracle/classify.hpp"

namespace fastsplat::oracle {
namespace {

/// narrow<RND, SAT>; no counter records a cut (N-6.2-7, N-6.2-14).
Wide rnd(Wide value, int from_f, const Words& to) {
  return narrow(Rounding::Rnd, Overflow::Sat, value, from_f, to).word;
}

/// Between two entries of f fraction bits, at fraction `rest` / 2^n (N-6.2-7).
Wide line(Wide here, Wide next, Wide rest, int n, int f) { return here - rnd((here - next) * rest, f + n, s(8, f)); }

Wide two_complement(std::uint32_t word) { return static_cast<std::int32_t>(word); }

Wide magnitude(Wide value) { return value < 0 ? -value : value; }

}  // namespace

// N-6.2-6: the number of words of a table, and the range of each.
std::int64_t density_table_words(const Symbols& c, int table) {
  const std::int64_t words[] = {4 * ((std::int64_t{1} << c.segment_bits) + 1), 97, 129, 13};
  return table >= 3 && table <= 6 ? words[table - 3] : 0;
}

bool density_word_fits(const Symbols& c, int table, std::size_t at, std::uint32_t word) {
  const auto within = [&](Wide low, Wide high) { return two_complement(word) >= low && two_complement(word) <= high; };
  if (table == 3) return word <= (at % 4 == 3 ? u(c.si, c.sf).largest : one(14).largest);
  if (table == 4) return word <= one(14).largest;
  if (table == 5) return word <= one(12).largest;
  if (table == 6) return at < 6 ? within(-16384, 16384) : at < 9 ? word <= u(4, 12).largest : true;
  return at % 2 == 1 || (word % 65536 <= one(12).largest && word / 65536 <= one(12).largest);
}

std::array<Wide, 4> classify(const Symbols& c, const DensityTables& tables, const PatternTables& patterns,
                             const DensityPixel& pixel) {
  const auto table = [&](int number, Wide at) { return Wide{tables.at(number)[static_cast<std::size_t>(at)]}; };
  const auto light = [&](int at) { return two_complement(tables.at(6)[static_cast<std::size_t>(at)]); };

  // N-6.2-8
  const int b = c.sf - c.segment_bits;
  const Wide d = pixel.density < power_of_two(c.sf) ? pixel.density : power_of_two(c.sf);
  const Wide i = floor_divide(d, power_of_two(b)), rest = remainder(d, power_of_two(b));
  const auto classified = [&](int channel, int f) {
    const Wide here = table(3, 4 * i + channel);
    return rest == 0 ? here : line(here, table(3, 4 * i + 4 + channel), rest, b, f);
  };
  const Wide tau = classified(3, c.sf);
  if (tau == 0) return {};

  // N-6.2-10
  const Wide scales = table(7, 2 * Wide{pixel.sheet}), per_floor = table(7, 2 * Wide{pixel.sheet} + 1);
  const Wide across = remainder(scales, 65536), along = floor_divide(scales, 65536);
  const Words slope = s(4, 16);
  const Wide tx = rnd(light(9) + light(10) * pixel.X, 28, s(4, 12)),
             ty = rnd(light(11) + light(12) * pixel.Y, 28, s(4, 12));
  Wide g[3];
  g[0] = rnd(pixel.dx * across, c.sf + 12, slope);
  g[1] = rnd(pixel.dy * across, c.sf + 12, slope);
  g[2] = rnd(pixel.dz * along * power_of_two(16 - c.sf) - tx * g[0] - ty * g[1], 28, slope);

  // m2, e, m, r and len of g as it is (N-6.2-10, N-6.2-11).
  Wide n = 0, m = 0, root = 0, length = 0;
  int e = 0;
  const auto measure = [&] {
    n = g[0] * g[0] + g[1] * g[1] + g[2] * g[2];
    if (n == 0) return;
    for (e = 0; power_of_two(e + 2) <= n;) e += 2;
    m = floor_divide(n * power_of_two(16), power_of_two(e));
    const Wide at = floor_divide(m - 65536, 2048), left = remainder(m - 65536, 2048);
    root = left == 0 ? table(4, at) : line(table(4, at), table(4, at + 1), left, 11, 14);
    length = rnd(m * root * power_of_two(e / 2), 46, u(5, 24));
  };
  measure();
  Solid solid{};
  if (patterns.loaded()) {
    solid = solid_at(c, patterns, pixel.X, pixel.Y, pixel.sheet);
    // N-6.3-11; all values from m2 on are recomputed from the tilted g (N-6.3-12).
    if (n > 0) {
      const auto& lean = solid.lean;
      const Wide p = rnd((g[0] * lean[0] + g[1] * lean[1] + g[2] * lean[2]) * root, 30 + e / 2, s(10, 16));
      for (std::size_t axis = 0; axis < 3; ++axis)
        g[axis] = rnd(g[axis] * power_of_two(24) + length * lean[axis] - p * g[axis] * power_of_two(8), 40, s(14, 16));
      measure();
    }
  }
  Wide share = 0, matt = 0, glint = 0;
  if (n > 0) {
    // N-6.2-11, N-6.2-12
    share = rnd(length * per_floor - power_of_two(32), 32, one(8));
    const auto facing = [&](int vector) {
      const Wide dot = g[0] * light(vector) + g[1] * light(vector + 1) + g[2] * light(vector + 2);
      return rnd(magnitude(dot) * root, 28 + e / 2, one(14));
    };
    matt = rnd(light(6) * power_of_two(14) + light(7) * facing(0), 26, u(5, 12));
    const Wide h = facing(3), k = floor_divide(h, 128), part = remainder(h, 128);
    glint = light(8) * (part == 0 ? table(5, k) : line(table(5, k), table(5, k + 1), part, 7, 12));
  }
  std::array<Wide, 4> out;  // N-6.2-13
  for (int channel = 0; channel < 3; ++channel) {
    Wide E = classified(channel, 14);
    // N-6.3-9
    if (patterns.loaded()) E = rnd(E * solid.tint[static_cast<std::size_t>(channel)], 30, one(14));
    const Wide shaded = E * matt + 4 * glint;
    const Wide lit = rnd(E * power_of_two(20) + share * (shaded - E * power_of_two(12)), 34, one(16));
    out[static_cast<std::size_t>(channel)] = rnd(lit * tau, 16 + c.sf, u(c.si, c.sf));
  }
  out[3] = tau;
  return out;
}

}  // namespace fastsplat::oracle
