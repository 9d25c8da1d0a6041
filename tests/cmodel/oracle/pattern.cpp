// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/oracle/pattern.hpp"

namespace fastsplat::oracle {
namespace {

/// narrow<RND, SAT>; no counter records a cut (N-6.3-14).
Wide rounded(Wide value, int from_f, const Words& to) {
  return narrow(Rounding::Rnd, Overflow::Sat, value, from_f, to).word;
}

/// The upper or lower 16 bits of a word; as two's complement if they are signed.
Wide half(std::uint32_t word, bool upper, bool is_signed) {
  const Wide bits = upper ? word / 65536 : word % 65536;
  return is_signed && bits >= 32768 ? bits - 65536 : bits;
}

}  // namespace

// N-6.3-2, N-6.3-3: the number of words of a table, and the range of each.
std::int64_t pattern_table_words(const Symbols& c, int table) {
  const std::int64_t M = std::int64_t{1} << c.node_bits;
  return table == 8 ? 2 * M * M * M : 13;
}

bool pattern_word_fits(int table, std::size_t at, std::uint32_t word) {
  if (table == 8 || (at >= 3 && at < 6)) return true;
  return word <= (at < 3 ? 65535 : at < 12 ? one(16).largest : u(10, 16).largest);
}

Solid solid_at(const Symbols& c, const PatternTables& tables, Wide X, Wide Y, Wide sheet) {
  const Wide M = power_of_two(c.node_bits);
  const Wide places[3] = {X, Y, sheet};
  Wide i[3], rest[3];  // N-6.3-4
  for (int axis = 0; axis < 3; ++axis) {
    Wide away = places[axis] - tables.pattern[static_cast<std::size_t>(axis)];
    if (away < 0) away = 0;
    if (away > 65535) away = 65535;
    const Words all{0, (M - 1) * 4096, 12};
    const Wide at = rounded(away * tables.pattern[static_cast<std::size_t>(3 + axis)], 24, all);
    i[axis] = floor_divide(at, 4096);
    rest[axis] = remainder(at, 4096);
  }
  // Channel 0 is v, 1 to 3 are B (N-6.3-2). `axis` counts down from 2: each level interpolates two values of the level
  // below (N-6.3-5, N-6.3-6).
  const auto word = [&](int channel, Wide x, Wide y, Wide z) {
    const auto node = static_cast<std::size_t>(2 * (x + M * (y + M * z)));
    return half(tables.nodes[node + static_cast<std::size_t>(channel / 2)], channel % 2 == 1, channel > 0);
  };
  const auto line = [](Wide a, Wide b, Wide part) { return a + rounded((b - a) * part, 28, s(2, 16)); };
  const auto along_x = [&](int channel, Wide y, Wide z) {
    const Wide a = word(channel, i[0], y, z);
    return rest[0] == 0 ? a : line(a, word(channel, i[0] + 1, y, z), rest[0]);
  };
  const auto along_y = [&](int channel, Wide z) {
    const Wide a = along_x(channel, i[1], z);
    return rest[1] == 0 ? a : line(a, along_x(channel, i[1] + 1, z), rest[1]);
  };
  const auto value = [&](int channel) {
    const Wide a = along_y(channel, i[2]);
    return rest[2] == 0 ? a : line(a, along_y(channel, i[2] + 1), rest[2]);
  };
  Solid out;
  const Wide v = value(0);
  for (std::size_t ch = 0; ch < 3; ++ch) {
    const Wide lo = tables.pattern[6 + ch], hi = tables.pattern[9 + ch];
    // N-6.3-7 and the b of N-6.3-11
    out.tint[ch] = lo + rounded((hi - lo) * v, 32, s(2, 16));
    out.lean[ch] = rounded(value(static_cast<int>(ch) + 1) * Wide{tables.pattern[12]}, 31, s(10, 16));
  }
  return out;
}

}  // namespace fastsplat::oracle
