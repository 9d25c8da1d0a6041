// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/oracle/stream.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

#include "tests/cmodel/oracle/classify.hpp"
#include "tests/cmodel/oracle/number.hpp"
#include "tests/cmodel/oracle/pattern.hpp"

namespace fastsplat::oracle {
namespace {

// A field of a beat.
constexpr std::size_t kWords = 8, kBytes = 4 * kWords;

struct Reader {
  const Symbols& c;
  std::span<const std::uint8_t> bytes;
  std::uint64_t beat = 0;  // next to read
  std::array<std::uint32_t, kWords> w{};

  void rule(bool holds, const char* text) const {
    if (!holds) throw Refusal(beat - 1, text);
  }
  std::uint64_t beats() const { return bytes.size() / kBytes; }

  /// The next beat into w (S-record-1); false at the end.
  bool next() {
    if (beat >= beats()) return false;
    for (std::size_t i = 0; i < kWords; ++i) {
      const std::size_t at = beat * kBytes + i * 4;
      w[i] = std::uint32_t{bytes[at]} + std::uint32_t{bytes[at + 1]} * 256 + std::uint32_t{bytes[at + 2]} * 65536 +
             std::uint32_t{bytes[at + 3]} * 16777216;
    }
    ++beat;
    return true;
  }
  /// S-reader-2: the missing beat is the one refused.
  void need() {
    if (!next()) throw Refusal(beats(), "the stream ends early");
  }
  std::uint32_t low(std::size_t i) const { return w[i] % 65536; }
  std::uint32_t high(std::size_t i) const { return w[i] / 65536; }
  /// The field of n bits from bit `first` of a word on.
  std::int64_t bits(std::size_t i, int first, int n) const {
    return static_cast<std::int64_t>(remainder(w[i] / power_of_two(first), power_of_two(n)));
  }
  /// S-record-5.
  std::int64_t two_complement(std::size_t i, int first, int n) const {
    const std::int64_t word = bits(i, first, n), half = std::int64_t{1} << (n - 1);
    return word >= half ? word - 2 * half : word;
  }
  /// The words from `first` on are zero (S-record-3).
  void empty_from(std::size_t first) const {
    for (std::size_t i = first; i < kWords; ++i) rule(w[i] == 0, "an unnamed word is not zero");
  }
  void only_opcode() const { rule(w[0] < 256, "an unnamed bit of w0 is not zero"); }
};

/// Number of words of a radius set, and the largest value of each: N-4-1, N-4.1-1, N-4.2-1, N-4.3-1, N-4.4-1, N-4.4-3
/// and N-4.5-1; S-table-5.
std::int64_t set_words(const Symbols& c, std::int64_t Ea) {
  if (c.index == "linear" || c.index == "squared") return 2;
  if (c.index == "squared_elliptic") return 4;
  if (c.index != "blit2d") return c.k * Ea;
  if (c.symmetry == "off") return std::int64_t{c.k} * c.k * Ea * Ea;
  const std::int64_t n = c.k == 1 ? 1 : c.k / 2 + 1;
  return n * (n + 1) / 2 * Ea * Ea;
}
std::int64_t largest_set_word(const Symbols& c, std::size_t i) {
  const std::int64_t scale = 16777216;
  if (c.index == "linear" || c.index == "squared") return i == 0 ? scale : 62;
  if (c.index == "squared_elliptic") return i == 3 ? 62 : scale;  // but B, see below
  const auto weight = static_cast<std::int64_t>(u(c.wi, c.wf).largest);
  if (c.index == "blit2d") return weight;
  if (c.index == "separable") return std::min(weight, std::int64_t{1} << c.wf) << c.g;
  return static_cast<std::int64_t>(c.N) * static_cast<std::int64_t>(power_of_two(c.g));
}

TableLoad table_load(Reader& r) {
  const Symbols& c = r.c;
  TableLoad load;
  r.rule(r.w[0] < 65536, "an unnamed bit of w0 is not zero");
  r.empty_from(5);
  load.table = static_cast<int>(r.w[0] / 256);
  // S-table-1.
  const bool pattern = load.table == 8 || load.table == 9;
  r.rule(pattern ? c.node_bits > 0 : load.table <= (c.segment_bits > 0 ? 7 : 2), "unknown table");
  load.set = r.w[1];
  load.rho = r.w[2];
  const std::int64_t count = r.w[3];
  load.base = r.w[4];
  std::int64_t largest = 0;
  if (load.table == 0) {
    // S-table-3; S-table-4 from the base of a set without columns.
    r.rule(load.set < c.sets, "radius set");
    r.rule(load.rho >= 1, "rho");
    r.rule(load.base % c.P == 0, "base");
    // N-3-3: base, E and Ea; N-4.4-2.
    if (c.index != "rlut" && c.index != "separable") r.rule(load.base == 0, "base of a set without columns");
    const Wide E = ceil_divide(2 * Wide{load.rho}, c.K());
    load.Ea = static_cast<std::int64_t>(ceil_divide(E, c.P)) * c.P;
    r.rule(load.base + load.Ea <= c.columns, "columns");
    r.rule(count == set_words(c, load.Ea), "words");
  } else {
    // S-table-2; the numbers of words: S-table-6, S-table-7, S-table-11, S-table-13.
    r.rule(load.set == 0 && load.rho == 0 && load.base == 0, "a radius set in a table without");
    if (load.table == 7) {
      r.rule(count >= 2 && count <= 2 * 4096 && count % 2 == 0, "words");
    } else {
      r.rule(count == (load.table == 1   ? c.radial_words()
                       : load.table == 2 ? c.G + 1
                       : pattern         ? pattern_table_words(c, load.table)
                                         : density_table_words(c, load.table)),
             "words");
    }
    largest = static_cast<std::int64_t>(load.table == 1 ? u(c.wi, c.wf).largest : one(c.of).largest);
  }
  // S-record-2, S-rule-2: eight words a beat, even if the beat looks like a record.
  for (std::int64_t done = 0; done < count; done += std::int64_t{kWords}) {
    r.need();
    for (std::size_t i = 0; i < kWords; ++i) {
      if (done + static_cast<std::int64_t>(i) >= count) {
        r.rule(r.w[i] == 0, "padding");
        continue;
      }
      // S-table-11, S-table-13.
      if (load.table > 2) {
        r.rule(pattern ? pattern_word_fits(load.table, load.words.size(), r.w[i])
                       : density_word_fits(c, load.table, load.words.size(), r.w[i]),
               "table word");
        load.words.push_back(r.w[i]);
        continue;
      }
      // S-table-5, S-table-6, S-table-7.
      if (load.table == 0) largest = largest_set_word(c, load.words.size());
      if (load.table == 0 && c.index == "squared_elliptic" && load.words.size() == 1) {
        const auto B = static_cast<std::int32_t>(r.w[i]);
        r.rule(B >= -33554432 && B <= 33554432, "table word");
      } else {
        r.rule(r.w[i] <= largest, "table word");
      }
      if (load.table == 2 && !load.words.empty()) r.rule(r.w[i] <= load.words.back(), "FACTOR rises");
      load.words.push_back(r.w[i]);
    }
  }
  // N-4.3-2.
  if (load.table == 0 && c.index == "squared_elliptic") {
    const Wide B = static_cast<std::int32_t>(load.words[1]);
    r.rule(4 * Wide{load.words[0]} * Wide{load.words[2]} >= B * B, "no ellipse");
  }
  return load;
}

/// The checks that splats and ellipses share (S-splat-2, S-ellipse-2): x and y were read.
template <class Record>
void place_and_colour(const Reader& r, Record& record) {
  const Words position = s(r.c.pi, r.c.pf);
  for (const std::int32_t p : {record.x, record.y}) r.rule(p >= position.smallest && p <= position.largest, "position");
  const std::uint32_t v[4] = {r.low(4), r.high(4), r.low(5), r.high(5)};
  for (int i = 0; i < 4; ++i) {
    r.rule(v[i] <= u(r.c.ci, r.c.cf).largest, "colour");
    record.v[i] = v[i];
  }
}

Splat splat(const Reader& r, const std::set<std::int64_t>& sets, std::uint32_t tag) {
  r.rule(r.w[0] < 65536, "an unnamed bit of w0 is not zero");
  r.empty_from(6);
  Splat splat;
  splat.set = static_cast<int>(r.w[0] / 256);
  // S-splat-1.
  r.rule(sets.contains(splat.set), "radius set not loaded");
  // S-splat-3.
  splat.tag = r.w[1];
  r.rule(splat.tag == tag, "tag");
  splat.x = static_cast<std::int32_t>(r.w[2]);
  splat.y = static_cast<std::int32_t>(r.w[3]);
  place_and_colour(r, splat);
  return splat;
}

/// N-4.6-2: its words.
Ellipse ellipse(const Reader& r, std::uint32_t tag) {
  // Every bit has a name except the uppermost four of w3.
  r.rule(r.w[3] < 268435456, "an unnamed bit of w3 is not zero");
  Ellipse e;
  e.tag = r.w[1];
  r.rule(e.tag == tag, "tag");
  e.x = static_cast<std::int32_t>(r.two_complement(2, 0, 22));
  e.y = static_cast<std::int32_t>(r.two_complement(3, 0, 22));
  place_and_colour(r, e);
  e.A = r.bits(6, 0, 22);
  e.B = r.two_complement(0, 8, 24);
  e.C = r.bits(7, 0, 22);
  e.h = static_cast<int>(r.bits(3, 22, 6));
  e.left = static_cast<int>(r.two_complement(6, 22, 10));
  e.top = static_cast<int>(r.two_complement(7, 22, 10));
  // S-ellipse-3.
  e.nx = static_cast<int>(r.bits(2, 22, 5)) + 1;
  e.ny = static_cast<int>(r.bits(2, 27, 5)) + 1;
  const char* broken = broken_shape(r.c, e);
  r.rule(broken == nullptr, broken == nullptr ? "" : broken);
  return e;
}

}  // namespace

std::vector<Item> read_stream(const Symbols& symbols, std::span<const std::uint8_t> bytes) {
  Reader r{symbols, bytes};
  std::vector<Item> items;

  r.need();
  r.rule(r.w[0] % 256 == 0x46, "begin_frame expected");
  r.rule(r.low(0) == 0x46, "an unnamed bit of w0 is not zero");
  // S-frame-1.
  r.rule(r.high(0) == 2, "version");
  r.empty_from(6);
  r.rule(r.w[1] == 0x31535346, "magic");
  // S-frame-3.
  r.rule(r.w[2] + r.w[3] * (std::uint64_t{1} << 32) == hash(symbols), "hash");
  // S-frame-4.
  const std::int64_t image_width = r.low(4), image_height = r.high(4);
  r.rule(image_width >= 1 && image_height >= 1, "image sides");
  const std::uint64_t tiles = r.w[5];

  std::set<std::int64_t> sets;
  bool have_radial = false, have_factor = false;
  std::set<int> of_densities, of_patterns;
  std::uint64_t scaled_sheets = 0;
  std::uint64_t tiles_seen = 0;

  // S-grammar-1, with the opcodes of S-record-4.
  while (true) {
    r.need();
    const std::uint32_t opcode = r.w[0] % 256;
    if (opcode == 0x4C) {
      r.rule(tiles_seen == 0, "a table after the first tile");
      TableLoad load = table_load(r);
      if (load.table == 0) sets.insert(load.set);
      have_radial |= load.table == 1;
      have_factor |= load.table == 2;
      if (load.table > 7) of_patterns.insert(load.table);
      if (load.table > 2 && load.table < 8) of_densities.insert(load.table);
      if (load.table == 7) scaled_sheets = load.words.size() / 2;
      items.emplace_back(std::move(load));
    } else if (opcode == 0x54) {
      // S-table-8.
      r.rule(have_radial && have_factor, "a tile before its tables");  // RADIAL of every kind (N-4.4-9, N-4.5-4)
      r.rule(r.w[0] < 4096, "an unnamed bit of w0 is not zero");
      r.empty_from(5);
      TileStart tile;
      tile.mode = static_cast<int>(r.w[0] / 256);
      const bool densities = r.c.segment_bits > 0 && (tile.mode == 8 || tile.mode == 9);
      // S-table-12, S-table-13.
      r.rule(!densities || of_densities.size() == 5, "a tile of densities before its tables");
      r.rule(of_patterns.size() != 1, "one table of a pattern without the other");
      // The modes of each device: N-6-11, N-6.2-1. S-tile-1.
      r.rule(tile.mode <= 2 || (r.c.every_sample != 0 && (tile.mode == 4 || tile.mode == 5)) || densities, "mode");
      // S-tile-4.
      tile.tile = r.w[1];
      r.rule(tile.tile == tiles_seen && tile.tile < tiles, "tile number");
      tile.x = static_cast<std::int32_t>(r.w[2]);
      tile.y = static_cast<std::int32_t>(r.w[3]);
      tile.width = static_cast<int>(r.low(4));
      tile.height = static_cast<int>(r.high(4));
      const int rim = densities ? 2 : 0;  // S-tile-2, S-tile-3 (N-6.2-3)
      r.rule(tile.width >= 1 && tile.width <= symbols.W - rim && tile.height >= 1 && tile.height <= symbols.H - rim,
             "tile sides");
      tile.image_width = static_cast<int>(image_width);
      tile.image_height = static_cast<int>(image_height);
      r.rule(tile.x >= 0 && tile.y >= 0 && std::int64_t{tile.x} + tile.width <= image_width &&
                 std::int64_t{tile.y} + tile.height <= image_height,
             "tile outside the image");
      ++tiles_seen;
      items.emplace_back(tile);

      std::uint32_t sheets = 0, tag = 0;
      std::optional<std::uint32_t> last_sheet;
      // S-tile-10: a tile may have no sheet, and a sheet no splat.
      for (r.need(); r.w[0] % 256 != 0x74; r.need()) {
        r.rule(r.w[0] % 256 == 0x53, "begin_sheet or end_tile expected");
        r.only_opcode();
        r.empty_from(2);
        const std::uint32_t sheet = r.w[1];
        // S-tile-6, S-tile-7.
        r.rule(!last_sheet || sheet > *last_sheet, "sheet numbers rise");
        r.rule(!densities || sheet < scaled_sheets, "a sheet without scales");
        last_sheet = sheet;
        ++sheets;
        items.emplace_back(SheetStart{sheet});
        std::uint32_t splats = 0;
        std::uint64_t promised = 0;  // splats up to here are in some group
        for (r.need(); r.w[0] % 256 != 0x73; r.need()) {
          if (r.w[0] % 256 == 0x50) {
            items.emplace_back(splat(r, sets, tag++));
            ++splats;
          } else if (symbols.f > 0 && r.w[0] % 256 == 0x45) {  // N-4.6-1
            // S-ellipse-1; tags and counts include those of splats (S-ellipse-2).
            items.emplace_back(ellipse(r, tag++));
            ++splats;
          } else {
            r.rule(r.w[0] % 256 == 0x43, "splat, cull_block or end_sheet expected");
            r.only_opcode();
            r.empty_from(6);
            // S-cull-1.
            r.rule(r.low(4) >= 1 && r.high(4) >= 1, "an empty cull_block");
            const CullHint hint{static_cast<std::int32_t>(r.w[2]), static_cast<std::int32_t>(r.w[3]),
                                static_cast<int>(r.low(4)), static_cast<int>(r.high(4)), r.w[5]};
            // S-cull-2 if culling is off; else S-cull-3, S-cull-4.
            if (symbols.cull != "off") {
              promised = std::max<std::uint64_t>(promised, splats);
              r.rule(r.w[1] == tag + (promised - splats), "a promise with another tag");
              promised += hint.splats;
            }
            items.emplace_back(hint);
          }
        }
        r.only_opcode();
        r.empty_from(3);
        // S-tile-8, S-tile-9.
        r.rule(r.w[1] == sheet, "sheet number");
        r.rule(r.w[2] == splats, "splat count");
        // S-cull-8.
        r.rule(promised <= splats, "a promise without its splats");
        items.emplace_back(SheetEnd{});
      }
      r.only_opcode();
      r.empty_from(3);
      // S-tile-8, S-tile-9.
      r.rule(r.w[1] == tile.tile, "tile number");
      r.rule(r.w[2] == sheets, "sheet count");
      items.emplace_back(TileEnd{});
    } else {
      r.rule(opcode == 0x66, "end_frame expected");
      r.only_opcode();
      r.empty_from(4);
      // S-file-6.
      r.rule(tiles_seen == tiles, "tile count");
      r.rule(r.w[1] + r.w[2] * (std::uint64_t{1} << 32) == r.beat - 1, "beat count");
      r.rule(r.w[3] == crc32(bytes.first((r.beat - 1) * kBytes)), "CRC");
      // S-file-5.
      if (r.next()) r.rule(false, "something follows end_frame");
      return items;
    }
  }
}

}  // namespace fastsplat::oracle
