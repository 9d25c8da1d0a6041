// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/random_stream_helper.hpp"

#include <algorithm>
#include <functional>

#include "tests/cmodel/oracle/classify.hpp"
#include "tests/cmodel/oracle/pattern.hpp"
#include "tests/cmodel/random_ellipse_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

using oracle::Wide;

struct Set {
  std::int64_t rho = 0, columns = 0;
};

/// Pixels x0..x1-1, y0..y1-1.
struct Box {
  Wide x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  Box clipped(int width, int height) const {
    return {std::max<Wide>(x0, 0), std::max<Wide>(y0, 0), std::min<Wide>(x1, width), std::min<Wide>(y1, height)};
  }
  Box around(const Box& other) const {
    if (other.x0 >= other.x1 || other.y0 >= other.y1) return *this;
    return {std::min(x0, other.x0), std::min(y0, other.y0), std::max(x1, other.x1), std::max(y1, other.y1)};
  }
};

class Generator {
 public:
  Generator(const oracle::Symbols& symbols, Random& random, SetOrder sets_order)
      : c(symbols), r(random), w(symbols), order(sets_order) {}

  RandomStream run(std::uint64_t splats) {
    // begin_frame holds the number of tiles, so the tiles are written first.
    for (std::int64_t i = 0; i < r.between(1, 3) || sets.empty(); ++i) radius_set();
    table(1, c.radial_words(), (std::int64_t{1} << (c.wi + c.wf)) - 1);
    factor();
    if (c.segment_bits > 0) density_tables();
    if (c.node_bits > 0 && !r.once_in(4)) pattern_tables();
    if (r.once_in(2)) radius_set();  // perhaps over the columns of another
    const StreamWriter tables = w;
    std::uint32_t tiles = 0;
    w = StreamWriter(c);
    while (w.total_splats() < splats || tiles < 2) tile(tiles++);
    const StreamWriter body = w;

    w = StreamWriter(c);
    w.begin_frame(image_width, image_height, tiles);
    std::vector<std::uint8_t> bytes = w.bytes();
    bytes.insert(bytes.end(), tables.bytes().begin(), tables.bytes().end());
    bytes.insert(bytes.end(), body.bytes().begin(), body.bytes().end());
    bytes.resize(bytes.size() + cmodel::kBeatBytes);
    bytes[bytes.size() - cmodel::kBeatBytes] = 0x66;
    seal(bytes);
    return {std::move(bytes), body.total_splats()};
  }

 private:
  static constexpr int image_width = 65535, image_height = 4096;
  static constexpr std::int64_t kScaledSheets = 128;

  /// A word of 0..largest: an end, next to an end, small, or arbitrary.
  std::uint32_t word(std::int64_t largest) {
    switch (r.between(0, 7)) {
      case 0:
        return static_cast<std::uint32_t>(largest);
      case 1:
        return static_cast<std::uint32_t>(std::max<std::int64_t>(largest - 1, 0));
      case 2:
        return 0;
      case 3:
        return static_cast<std::uint32_t>(r.between(0, std::min<std::int64_t>(largest, 3)));
      case 4:
        return static_cast<std::uint32_t>(r.between(0, 1 + largest / 16) % (largest + 1));
      case 5:
        return static_cast<std::uint32_t>((largest + 1) / 2);
      default:
        return static_cast<std::uint32_t>(r.between(0, largest));
    }
  }
  std::uint32_t two_words(std::int64_t largest) {
    const std::uint32_t low = word(largest);
    return low | word(largest) << 16;
  }

  void radius_set() {
    const std::int64_t most_windows = c.columns / c.P;
    const std::int64_t windows = std::min(most_windows, r.once_in(4) ? r.between(1, 4) : r.between(1, 2));
    // E = ceil(2 rho / k) in (windows-1) P + 1 .. windows P; its widest and narrowest rho are boundary cases.
    const std::int64_t widest = windows * c.P * c.K() / 2, narrowest = (windows - 1) * c.P * c.K() / 2 + 1;
    if (widest < narrowest) return;
    const std::int64_t rho = r.once_in(2) ? r.between(narrowest, widest) : r.one_of({narrowest, widest});
    const bool columns = c.index == "rlut" || c.index == "separable";
    const std::int64_t base = columns ? r.between(0, most_windows - windows) * c.P : 0, Ea = windows * c.P;
    const auto set = static_cast<std::uint32_t>(r.between(0, c.sets - 1));
    const std::vector<std::uint32_t> words = c.index == "rlut" ? rlut_words(c.k * Ea) : set_words(rho, Ea);
    w.load_table(0, set, static_cast<std::uint32_t>(rho), static_cast<std::uint32_t>(base), words);
    const auto known = std::find(numbers.begin(), numbers.end(), set);
    if (known == numbers.end()) {
      numbers.push_back(set);
      sets.push_back({rho, Ea});
    } else {
      sets[static_cast<std::size_t>(known - numbers.begin())] = {rho, Ea};
    }
  }

  /// For the other kinds of index. Rims mostly lie within the footprint or just outside.
  std::vector<std::uint32_t> set_words(std::int64_t rho, std::int64_t Ea) {
    const std::int64_t most = std::int64_t{1} << 24, weight = (std::int64_t{1} << (c.wi + c.wf)) - 1;
    std::vector<std::uint32_t> words;
    if (c.index == "blit2d") {
      const std::int64_t n = c.symmetry == "off" ? c.k : c.k == 1 ? 1 : c.k / 2 + 1;
      const std::int64_t pairs = c.symmetry == "off" ? n * n : n * (n + 1) / 2;
      for (std::int64_t i = 0; i < pairs * Ea * Ea; ++i) words.push_back(word(weight));
      return words;
    }
    if (c.index == "separable") {
      const std::int64_t largest = std::min(weight, std::int64_t{1} << c.wf) << c.g;
      for (std::int64_t i = 0; i < c.k * Ea; ++i) words.push_back(word(largest));
      return words;
    }
    // The scale that puts the rim at rho, with 24 bits; then up to four times wider or narrower.
    std::int64_t h = 0;
    oracle::Wide scale = 0;
    const oracle::Wide rim = c.index == "linear" ? oracle::Wide{rho} << c.g : oracle::Wide{rho} * rho;
    do scale = (oracle::Wide{c.N} << h) / rim;
    while (scale < most / 2 && h++ < 62);
    h = std::clamp<std::int64_t>(h + r.between(-2, 2), 0, 62);
    const auto c0 = static_cast<std::int64_t>(std::min<oracle::Wide>(scale, most));
    const auto near = [&] {
      return r.once_in(6) ? std::int64_t{word(most)} : std::clamp<std::int64_t>(c0 + r.between(-2, 2), 0, most);
    };
    words.push_back(static_cast<std::uint32_t>(near()));
    if (c.index == "squared_elliptic") {
      const std::int64_t A = words[0];
      std::int64_t C = A;
      if (!r.once_in(3)) C = near(), C /= r.between(1, 16);
      std::int64_t B = 0;  // the thinnest ellipse
      for (std::int64_t bit = std::int64_t{1} << 25; bit > 0; bit /= 2)
        if ((B + bit) * (B + bit) <= 4 * A * C) B += bit;
      if (!r.once_in(4)) B = r.between(0, B);
      if (r.once_in(2)) B = -B;
      words.push_back(static_cast<std::uint32_t>(static_cast<std::int32_t>(B)));
      words.push_back(static_cast<std::uint32_t>(C));
    }
    words.push_back(static_cast<std::uint32_t>(h));
    return words;
  }

  /// Words that no driver makes: the device depends on the loaded words only (N-4-5).
  std::vector<std::uint32_t> rlut_words(std::int64_t count) {
    const std::int64_t rim = std::int64_t{c.N} << c.g;
    std::vector<std::uint32_t> words;
    const std::int64_t style = r.between(0, 2);
    for (std::int64_t i = 0; i < count; ++i) {
      if (style == 0) words.push_back(word(rim));
      if (style == 1) words.push_back(static_cast<std::uint32_t>(r.between(0, rim / 2)));  // sums mostly inside
      if (style == 2)
        words.push_back(static_cast<std::uint32_t>(std::max<std::int64_t>(0, rim / 2 - r.between(-2, 2))));
      words.back() = std::min(words.back(), static_cast<std::uint32_t>(rim));
    }
    return words;
  }

  void table(int id, std::int64_t count, std::int64_t largest) {
    std::vector<std::uint32_t> words;
    const bool falling = r.once_in(2);
    for (std::int64_t i = 0; i < count; ++i) words.push_back(word(largest));
    if (falling) std::sort(words.begin(), words.end(), std::greater<>());
    w.load_table(id, 0, 0, 0, words);
  }

  void factor() {
    const std::int64_t top = std::int64_t{1} << c.of;
    std::vector<std::uint32_t> words;
    const std::int64_t style = r.between(0, 2);
    for (std::int64_t j = 0; j <= c.G; ++j) {
      if (style == 0) words.push_back(word(top));
      if (style == 1) words.push_back(static_cast<std::uint32_t>(r.between(top / 2, top)));
      if (style == 2) words.push_back(static_cast<std::uint32_t>(top * c.G / (c.G + j)));  // near the physical one
    }
    std::sort(words.begin(), words.end(), std::greater<>());
    w.load_table(2, 0, 0, 0, words);
  }

  /// Density tables: arbitrary words in their ranges, some as from a driver.
  void density_tables() {
    for (const int id : {3, 4, 5, 6, 7}) {
      const std::int64_t count = id == 7 ? 2 * kScaledSheets : oracle::density_table_words(c, id);
      std::vector<std::uint32_t> words;
      for (std::int64_t i = 0; i < count; ++i) {
        const auto any = static_cast<std::uint32_t>(r.next());
        if (id == 3) words.push_back(word(i % 4 == 3 ? (std::int64_t{1} << (c.si + c.sf)) - 1 : 16384));
        if (id == 4) words.push_back(static_cast<std::uint32_t>(16384 * 4 / (4 + i / 16)));
        if (id == 5) words.push_back(word(4096));
        if (id == 6)
          words.push_back(i < 6   ? static_cast<std::uint32_t>(static_cast<std::int32_t>(r.between(-16384, 16384)))
                          : i < 9 ? word(65535)
                          : i % 2 == 1 || r.once_in(4)
                              ? any
                              : static_cast<std::uint32_t>(static_cast<std::int32_t>(r.between(-65536, 65536))));
        if (id == 7) words.push_back(i % 2 == 1 ? any >> r.between(0, 31) : two_words(4096));
      }
      w.load_table(id, 0, 0, 0, words);
    }
  }

  /// Patterns: places near the tiles and far from them, steps as from a driver and arbitrary ones.
  void pattern_tables() {
    std::vector<std::uint32_t> nodes, words;
    for (std::int64_t i = 0; i < oracle::pattern_table_words(c, 8); ++i) nodes.push_back(two_words(65535));
    for (const int most : {image_width, image_height, 128})
      words.push_back(r.once_in(2) ? 0 : static_cast<std::uint32_t>(r.between(0, most)));
    for (const int most : {image_width, image_height, 16}) {
      const std::int64_t spread = (std::int64_t{1} << (24 + c.node_bits)) / most;  // over all of it
      words.push_back(r.once_in(4)   ? static_cast<std::uint32_t>(r.next())
                      : r.once_in(4) ? std::uint32_t{1} << 24
                                     : static_cast<std::uint32_t>(r.between(spread / 2, 2 * spread)));
    }
    for (int i = 0; i < 6; ++i) words.push_back(word(65536));
    words.push_back(r.once_in(3) ? word((std::int64_t{1} << 26) - 1) : word(131072));
    if (r.once_in(2)) {
      w.load_table(8, 0, 0, 0, nodes);
      w.load_table(9, 0, 0, 0, words);
    } else {
      w.load_table(9, 0, 0, 0, words);
      w.load_table(8, 0, 0, 0, nodes);
    }
  }

  int mode() {
    if (c.segment_bits > 0 && c.W > 2 && c.H > 2 && r.once_in(2)) return static_cast<int>(r.between(8, 9));
    const auto drawn = static_cast<int>(r.between(0, c.every_sample != 0 ? 4 : 2));
    return drawn > 2 ? drawn + 1 : drawn;
  }

  void tile(std::uint32_t number) {
    int width = static_cast<int>(r.between(1, std::min(c.W, 3 * c.P + 8)));
    int height = static_cast<int>(r.between(1, std::min(c.H, 3 * c.P + 8)));
    if (r.once_in(8)) width = height = 1;
    if (r.once_in(8) || c.W * c.H <= 1600) width = c.W, height = c.H;
    int y = static_cast<int>(r.between(0, image_height - height)),
        x = static_cast<int>(r.between(0, image_width - width));
    const int drawn = mode();
    if (drawn >= 8) {
      width = std::min(width, c.W - 2), height = std::min(height, c.H - 2);
      // At the picture's edges more often than not.
      if (r.once_in(2)) x = static_cast<int>(r.one_of({0, image_width - width}));
      if (r.once_in(2)) y = static_cast<int>(r.one_of({0, image_height - height}));
    }
    w.begin_tile(drawn, number, x, y, width, height);
    // Bright tiles freeze and saturate; dim ones keep many sheets visible.
    const int dimming = static_cast<int>(r.one_of({0, 1, 2, 4, 6}));
    std::uint32_t sheet = static_cast<std::uint32_t>(r.one_of({0, 0, 1, 77}));
    for (std::int64_t s = r.between(0, 8); s > 0; --s) {
      w.begin_sheet(sheet);
      sheet += static_cast<std::uint32_t>(r.between(1, 3));
      if (c.cull != "off") {
        promising_sheet(width, height, dimming);
        w.end_sheet();
        continue;
      }
      const std::int64_t splats = r.once_in(6) ? 0 : r.between(1, 40);
      const std::int64_t kinds = c.f > 0 ? r.between(0, 2) : 2;
      for (std::int64_t i = 0; i < splats; ++i) {
        if (r.once_in(12)) w.cull_block(static_cast<std::uint32_t>(r.next()), 0, 0, width, height, 3);
        // With ellipses: whole sheets of either, and mixed ones.
        if (c.f > 0 && (kinds == 0 || (kinds == 1 && r.once_in(2))))
          ellipse(width, height, dimming);
        else
          splat(width, height, dimming);
      }
      w.end_sheet();
    }
    w.end_tile();
  }

  /// For culling devices: every cull_block keeps its rules. Some sheets are walls, which freeze blocks.
  void promising_sheet(int width, int height, int dimming) {
    struct Planned {
      std::size_t which = 0;
      oracle::Ellipse ellipse;
      bool round = true;
      Box box;
    };
    std::vector<Planned> planned;
    const auto add = [&](std::int32_t x, std::int32_t y, int dim) {
      Planned one;
      one.which = static_cast<std::size_t>(r.between(0, static_cast<std::int64_t>(sets.size()) - 1));
      one.ellipse.x = x, one.ellipse.y = y;
      draw(one.ellipse.v, dim);
      one.box = box_of(sets[one.which], x, y);
      planned.push_back(one);
    };
    const std::int64_t one = std::int64_t{1} << c.pf, half = std::int64_t{1} << (c.pi + c.pf - 1);
    if (r.once_in(3)) {
      for (std::int64_t y = 0; y <= height; y += c.P / 2 + 1)
        for (std::int64_t x = 0; x <= width; x += c.P / 2 + 1)
          add(static_cast<std::int32_t>(std::min(x * one, half - 1)),
              static_cast<std::int32_t>(std::min(y * one, half - 1)), 0);
    } else {
      for (std::int64_t i = r.once_in(6) ? 0 : r.between(1, 40); i > 0; --i) {
        const Set& near = sets[static_cast<std::size_t>(r.between(0, static_cast<std::int64_t>(sets.size()) - 1))];
        const std::int32_t y = position(height, near), x = position(width, near);
        add(x, y, dimming);
        if (c.f == 0 || r.once_in(2)) continue;
        Planned& last = planned.back();
        last.round = false;
        random_shape(c, r, last.ellipse);
        const oracle::FirstPixel first = oracle::first_pixel(c, last.ellipse);
        last.box = {first.x0, first.y0, first.x0 + last.ellipse.nx * c.P, first.y0 + last.ellipse.ny * c.P};
      }
    }
    // Neighbours in a group of few splats: larger groups are hardly ever hidden.
    if (r.once_in(2)) {
      std::stable_sort(planned.begin(), planned.end(), [&](const Planned& a, const Planned& b) {
        return std::pair{a.box.y0 / (2 * c.P), a.box.x0 / (2 * c.P)} <
               std::pair{b.box.y0 / (2 * c.P), b.box.x0 / (2 * c.P)};
      });
    }
    // S-cull-6.
    std::int64_t room = 0;
    for (std::int64_t side = c.P; room == 0 || room > 1024; side *= 2)
      room = ((c.W + side - 1) / side) * ((c.H + side - 1) / side);
    std::vector<std::size_t> ends;  // of open sets
    std::size_t promised = 0;
    const bool in_front = r.once_in(2);  // as many as there is room for
    for (std::size_t at = 0; at < planned.size(); ++at) {
      std::erase_if(ends, [&](std::size_t end) { return end <= at; });
      promised = std::max(promised, at);
      const bool may = order == SetOrder::Any || promised == at;
      while (may && static_cast<std::int64_t>(ends.size()) < room && (in_front || r.once_in(6))) {
        const std::size_t most = planned.size() - promised;
        const std::size_t n = std::min(most, static_cast<std::size_t>(r.between(0, 9)));
        Box box{Wide{width}, Wide{height}, 0, 0};
        for (std::size_t i = promised; i < promised + n; ++i) box = box.around(planned[i].box.clipped(width, height));
        if (r.once_in(8)) box = {0, 0, width, height};
        if (box.x0 >= box.x1 || box.y0 >= box.y1) box = {-5, 3, -4, 4};  // beside the tile
        w.cull_block(static_cast<std::uint32_t>(w.next_tag() + (promised - at)), static_cast<std::int32_t>(box.x0),
                     static_cast<std::int32_t>(box.y0), static_cast<int>(box.x1 - box.x0),
                     static_cast<int>(box.y1 - box.y0), static_cast<std::uint32_t>(n));
        promised += n;
        if (n > 0) ends.push_back(promised);
        if (most == 0 || r.once_in(10)) break;
      }
      const Planned& one_of = planned[at];
      if (one_of.round)
        w.splat(static_cast<int>(numbers[one_of.which]), one_of.ellipse.x, one_of.ellipse.y,
                {one_of.ellipse.v[0], one_of.ellipse.v[1], one_of.ellipse.v[2], one_of.ellipse.v[3]});
      else
        w.ellipse(one_of.ellipse);
    }
  }

  void splat(int width, int height, int dimming) {
    const auto which = static_cast<std::size_t>(r.between(0, static_cast<std::int64_t>(sets.size()) - 1));
    const std::int32_t x = position(width, sets[which]), y = position(height, sets[which]);
    std::array<std::uint32_t, 4> colour{};
    draw(colour, dimming);
    w.splat(static_cast<int>(numbers[which]), x, y, colour);
  }

  void ellipse(int width, int height, int dimming) {
    oracle::Ellipse e;
    const Set near{.rho = 0, .columns = r.between(0, 2 * c.P)};
    e.x = position(width, near), e.y = position(height, near);
    random_shape(c, r, e);
    draw(e.v, dimming);
    w.ellipse(e);
  }

  template <class Colour>
  void draw(Colour& colour, int dimming) {
    for (std::uint32_t& v : colour) v = word(((std::int64_t{1} << c.cf) - 1) >> std::min(dimming, c.cf - 1));
  }

  /// All windows of a splat.
  Box box_of(const Set& set, std::int32_t x, std::int32_t y) const {
    const oracle::Words grid = oracle::s(c.pi, oracle::log2_of(c.K()));
    const auto first = [&](std::int32_t p) {
      return oracle::floor_divide(oracle::narrow(c.Rs, oracle::Overflow::Sat, p, c.pf, grid).word - set.rho, c.K()) + 1;
    };
    return {first(x), first(y), first(x) + set.columns, first(y) + set.columns};
  }

  std::int32_t position(int side, const Set& set) {
    const std::int64_t one = std::int64_t{1} << c.pf, half = std::int64_t{1} << (c.pi + c.pf - 1);
    const std::int64_t reach = set.columns + 2;
    std::int64_t p = 0;
    switch (r.between(0, 9)) {
      case 0:  // the ends of the format: snapping saturates, the window is far outside
        p = r.one_of({-half, -half + 1, half - 1, half - 2});
        break;
      case 1:  // anywhere at all
        p = r.between(-half, half - 1);
        break;
      case 2:  // around the tile's first edge
        p = r.between(-reach, reach) * one;
        p += r.between(-2, 2);
        break;
      case 3:  // around its last edge
        p = (side + r.between(-reach, reach)) * one;
        p += r.between(-2, 2);
        break;
      case 4: {  // ties between two grid positions
        const std::int64_t step = std::max<std::int64_t>(one / c.K(), 1);
        p = r.between(-reach, side + reach) * one + step / 2;
        p += r.between(0, c.K() - 1) * step;
        p -= r.between(0, 1);
        break;
      }
      default:
        p = r.between(0, side * one);
    }
    return static_cast<std::int32_t>(std::clamp(p, -half, half - 1));
  }

  oracle::Symbols c;
  Random& r;
  StreamWriter w;
  SetOrder order;
  std::vector<Set> sets;
  std::vector<std::uint32_t> numbers;
};

}  // namespace

RandomStream random_stream(const oracle::Symbols& symbols, Random& random, std::uint64_t splats, SetOrder sets) {
  return Generator(symbols, random, sets).run(splats);
}

}  // namespace fastsplat::test
