// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/oracle/oracle.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "tests/cmodel/oracle/classify.hpp"
#include "tests/cmodel/oracle/number.hpp"
#include "tests/cmodel/oracle/pattern.hpp"
#include "tests/cmodel/oracle/stream.hpp"

namespace fastsplat::oracle {
namespace {

using Four = std::array<Wide, 4>;

struct Pixel {
  Four S{};          // the sheet
  Four C{};          // C_R, C_G, C_B, T; for X-rays the four sums
  bool hit = false;  // a window covered it in this sheet
};

struct RadiusSet {
  std::int64_t rho = 0, base = 0, Ea = 0;
  std::vector<std::uint32_t> words;  // of the kinds without columns (N-4.4-2)
};

class Renderer {
 public:
  explicit Renderer(const Symbols& symbols) : c(symbols) {}

  Rendering run(std::span<const std::uint8_t> bytes) {
    for (const Item& item : read_stream(c, bytes)) std::visit([&](const auto& it) { take(it); }, item);
    return std::move(out);
  }

 private:
  Wide count(const Narrowed& narrowed, const char* counter) {
    if (narrowed.overflow) ++out.counts[counter];
    return narrowed.word;
  }
  Wide sat(Rounding rounding, Wide value, int from_f, const Words& words, const char* counter) {
    return count(narrow(rounding, Overflow::Sat, value, from_f, words), counter);
  }
  static std::uint32_t word(Wide value) { return static_cast<std::uint32_t>(value); }
  Pixel& at(Wide x, Wide y) { return pixels[static_cast<std::size_t>(y * tile.width + x)]; }
  bool inside(Wide x, Wide y) const { return x >= 0 && y >= 0 && x < tile.width && y < tile.height; }

  void take(const TableLoad& load) {
    if (load.table == 1) radial = load.words;
    if (load.table == 2) factor = load.words;
    if (load.table > 2 && load.table < 8) density_tables[load.table] = load.words;
    if (load.table == 8) patterns.nodes = load.words;
    if (load.table == 9) patterns.pattern = load.words;
    if (load.table != 0) return;
    // S-table-10: in the other kinds each set keeps its words.
    sets[load.set] = {load.rho, load.base, load.Ea, load.words};
    if (c.index != "rlut" && c.index != "separable") return;
    // One memory of k x columns words for all sets: a column holds the words loaded last (N-4-1, N-4.5-1, S-table-9).
    rlut.resize(static_cast<std::size_t>(c.k) * static_cast<std::size_t>(c.columns));
    for (std::int64_t m = 0; m < c.k; ++m)
      for (std::int64_t i = 0; i < load.Ea; ++i)
        rlut[static_cast<std::size_t>(m * c.columns + load.base + i)] =
            load.words[static_cast<std::size_t>(m * load.Ea + i)];
  }

  void take(const TileStart& start) {
    tile = start;
    Pixel fresh;  // all 0 but T (N-6-1, N-6-9)
    if (tile.mode != 2) fresh.C[3] = power_of_two(c.tf);
    pixels.assign(static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height), fresh);
    frozen.clear();
    announced.clear();
    density_sheets.clear();
    ++out.counts["tiles"];
  }

  bool densities() const { return tile.mode >= 8; }
  int rim() const { return densities() ? 1 : 0; }

  void take(const SheetStart& start) {
    sheet = start.sheet;
    if (densities()) density_sheets[sheet];
    for (Pixel& p : pixels) {
      p.S = {};  // N-5-1
      p.hit = false;
    }
  }

  void take(const CullHint& hint) {
    // S-cull-2: counted for any cull.map. S-cull-3: it covers the next splats that no group covers yet.
    ++out.counts["cull_blocks"];  // N-9-9, in every mode (N-6.1-2)
    if (!culls()) return;
    // Splats of a hidden group are dropped (N-6.1-8).
    announced.insert(announced.end(), hint.splats, hidden(hint.x, hint.y, hint.width, hint.height, cell()));
  }

  // Culling, section 6.1, pixel by pixel.
  bool culls() const { return c.cull != "off" && tile.mode < 2; }  // N-6.1-2
  int cell() const { return c.cull == "block" ? c.P : 1; }         // N-6.1-3
  /// Whether all pixels of all cells that the rectangle meets in the tile were frozen two sheets ago (N-6.1-4), by the
  /// table's words (N-6.1-5, N-6.1-7). A rectangle that meets no cell is hidden (N-6.1-6).
  bool hidden(Wide x0, Wide y0, Wide width, Wide height, int u) const {
    for (Wide y = 0; y < tile.height; ++y)
      for (Wide x = 0; x < tile.width; ++x) {
        // The pixel's cell, [cx, cx+u) x [cy, cy+u), meets the rectangle in the tile.
        const Wide cx = x - x % u, cy = y - y % u;
        const bool meets = std::max(cx, x0) < std::min({cx + u, x0 + width, Wide{tile.width}}) &&
                           std::max(cy, y0) < std::min({cy + u, y0 + height, Wide{tile.height}});
        if (!meets) continue;
        if (frozen.size() < 2 || !frozen[frozen.size() - 2][static_cast<std::size_t>(y * tile.width + x)]) return false;
      }
    return true;
  }
  bool dropped() {
    if (announced.empty()) return false;
    const bool gone = announced.front();
    announced.erase(announced.begin());
    return gone;
  }

  /// A centre relative to the tile, and a radius set (N-3-2).
  void take(const Splat& splat) {
    if (dropped()) return;   // N-6.1-8: no counter, no tap
    ++out.counts["splats"];  // N-9-9, hidden or not (N-6.1-9)
    const RadiusSet& set = sets.at(splat.set);
    const Words grid = s(c.pi, log2_of(c.K()));
    const auto first = [&](Wide p) {
      return floor_divide(narrow(c.Rs, Overflow::Sat, p, c.pf, grid).word - set.rho, c.K()) + 1;
    };
    if (culls() && hidden(first(splat.x), first(splat.y), set.Ea, set.Ea, cell())) return;
    // N-3-4: the snap; N-3-5: the window's origin and phase; N-3-6: the windows in their order.
    const Wide xs = sat(c.Rs, splat.x, c.pf, grid, "snap_saturated");
    const Wide ys = sat(c.Rs, splat.y, c.pf, grid, "snap_saturated");
    const Wide x0 = floor_divide(xs - set.rho, c.K()) + 1, y0 = floor_divide(ys - set.rho, c.K()) + 1;
    const Wide mx = remainder(xs - set.rho, c.K()), my = remainder(ys - set.rho, c.K());
    emit(Kind::Snap, splat.tag, x0, y0, {word(x0), word(y0), word(mx), word(my)});
    for (std::int64_t j = 0; j < set.Ea; j += c.P)
      for (std::int64_t i = 0; i < set.Ea; i += c.P)
        window(splat, x0, y0, i, j,
               [&](std::int64_t column, std::int64_t row) { return weight(set, mx, my, column, row); });
  }

  void take(const Ellipse& e) {
    if (dropped()) return;
    ++out.counts["splats"];
    ++out.ellipses.records;
    const FirstPixel first = first_pixel(c, e);
    // N-6.1-9
    if (culls() && hidden(first.x0, first.y0, Wide{e.nx} * c.P, Wide{e.ny} * c.P, cell())) return;
    emit(Kind::Snap, e.tag, first.x0, first.y0, {word(first.x0), word(first.y0), word(first.X), word(first.Y)});
    const EllipseForm form(c, e);
    out.ellipses.wrapped += form.wrapped() ? 1 : 0;
    const std::uint64_t weighted = out.counts["lanes_weighted"];
    // N-4.6-4: the windows; N-4.6-7: the weights.
    for (std::int64_t j = 0; j < e.ny; ++j)
      for (std::int64_t i = 0; i < e.nx; ++i)
        window(e, first.x0, first.y0, i * c.P, j * c.P,
               [&](std::int64_t column, std::int64_t row) { return entry(form.steps(column, row), c.g); });
    out.ellipses.windows += static_cast<std::uint64_t>(e.nx) * static_cast<std::uint64_t>(e.ny);
    out.ellipses.weighted += out.counts["lanes_weighted"] - weighted;
  }

  /// The window of a splat or an ellipse from its pixel (i0, j0) on.
  template <class Record, class Weight>
  void window(const Record& splat, Wide x0, Wide y0, std::int64_t i0, std::int64_t j0, const Weight& weight_of) {
    // N-6.1-10, N-9-16
    if (std::is_same_v<Record, Splat> && culls() && hidden(x0 + i0, y0 + j0, c.P, c.P, c.P)) return;
    ++out.counts["windows"];  // N-9-8
    std::vector<std::uint32_t> weights, sums;
    for (std::int64_t j = j0; j < j0 + c.P; ++j)
      for (std::int64_t i = i0; i < i0 + c.P; ++i) {
        const Wide w = weight_of(i, j);
        weights.push_back(word(w));
        if (densities()) {
          add_density(splat.v, x0 + i, y0 + j, w, sums);
          continue;
        }
        if (!inside(x0 + i, y0 + j)) {  // N-3-7
          sums.insert(sums.end(), 4, 0);
          continue;
        }
        ++out.counts["lanes_inside"];
        if (w > 0) ++out.counts["lanes_weighted"];
        Pixel& p = at(x0 + i, y0 + j);
        const Words sums_format = u(c.si, c.sf);
        Four products;  // N-5-2; saturation counts (N-9-11)
        for (std::size_t ch = 0; ch < 4; ++ch)
          products[ch] = sat(c.Rp, Wide{splat.v[ch]} * w, c.cf + c.wf, sums_format, "product_saturated");
        // Every sample: composited at once; the end of the sheet does nothing (N-6-12, N-6-13).
        if (tile.mode >= 4) {
          if (w > 0) {
            ++out.counts["pixels_composited"];  // N-9-12
            if (p.C[3] < c.eps) ++out.counts["frozen_pixels"];
            composite(p, products, tile.mode - 4);
          }
          for (const Wide value : p.C) sums.push_back(word(value));
          continue;
        }
        p.hit = true;  // N-9-6: for any weight
        // N-5-3, N-9-11
        for (std::size_t ch = 0; ch < 4; ++ch) {
          p.S[ch] = sat(Rounding::Trn, p.S[ch] + products[ch], c.sf, sums_format, "sheet_saturated");
          sums.push_back(word(p.S[ch]));
        }
      }
    // Includes windows outside the tile, with the splat's tag (N-9-1, N-9-2).
    emit(Kind::Footprint, splat.tag, x0 + i0, y0 + j0, std::move(weights));
    emit((tile.mode == 4 || tile.mode == 5) ? Kind::Composite : Kind::Sheet, splat.tag, x0 + i0, y0 + j0,
         std::move(sums));
  }

  /// In a density tile: at a pixel of it or its halo (N-6.2-3), where counters count both (N-9-8, N-9-11). Splats also
  /// add to frozen pixels (N-6.2-5). Taps show 0 outside the tile (N-9-3).
  void add_density(const std::uint32_t (&v)[4], Wide x, Wide y, Wide w, std::vector<std::uint32_t>& sums) {
    if (x < -1 || y < -1 || x > tile.width || y > tile.height) {
      sums.insert(sums.end(), 4, 0);
      return;
    }
    ++out.counts["lanes_inside"];
    if (w > 0) ++out.counts["lanes_weighted"];
    Four& S = density_sheets[sheet][{y, x}];
    for (std::size_t ch = 0; ch < 4; ++ch) {
      const Wide p = sat(c.Rp, v[ch] * w, c.cf + c.wf, u(c.si, c.sf), "product_saturated");
      S[ch] = sat(Rounding::Trn, S[ch] + p, c.sf, u(c.si, c.sf), "sheet_saturated");
      sums.push_back(word(S[ch]));
    }
  }

  /// Density of a pixel in a sheet (N-6.2-2), 0 without splats or without the sheet (N-6.2-4).
  Wide density(std::int64_t of, Wide x, Wide y) const {
    const auto found = density_sheets.find(of);
    if (found == density_sheets.end()) return 0;
    const auto pixel = found->second.find({y, x});
    return pixel == found->second.end() ? 0 : pixel->second[3];
  }

  /// Sheet `number` between its neighbours; neighbours that the tile lacks are empty (N-6.2-4). Its Composites have its
  /// number (N-9-5).
  void classify_sheet(std::int64_t number) {
    const std::uint32_t open = sheet;
    sheet = static_cast<std::uint32_t>(number);
    for (Wide by = -1; by <= tile.height; by += c.P)
      for (Wide bx = -1; bx <= tile.width; bx += c.P) classify_block(number, bx, by);
    sheet = open;
  }

  /// From (-1, -1) on (N-6.2-3). Dirty blocks only (N-6.2-5), which pixels of the halo also make (N-9-6).
  void classify_block(std::int64_t number, Wide bx, Wide by) {
    bool dirty = false;
    for (const auto& [at, unused] : density_sheets[number])
      dirty = dirty || (at.second >= bx && at.second < bx + c.P && at.first >= by && at.first < by + c.P);
    if (!dirty) return;
    ++out.counts["dirty_blocks"];
    std::vector<std::uint32_t> words;
    for (Wide y = by; y < by + c.P; ++y)
      for (Wide x = bx; x < bx + c.P; ++x) {
        if (!inside(x, y)) {
          words.insert(words.end(), 4, 0);
          continue;
        }
        DensityPixel pixel{.density = density(number, x, y), .X = tile.x + x, .Y = tile.y + y, .sheet = sheet};
        const auto here = [&](Wide i, Wide j) { return density(number, i, j); };
        // One-sided at the picture's edges, counted twice (N-6.2-9).
        const bool left = pixel.X == 0, right = pixel.X == tile.image_width - 1, above = pixel.Y == 0,
                   below = pixel.Y == tile.image_height - 1;
        pixel.dx = (here(right ? x : x + 1, y) - here(left ? x : x - 1, y)) * (left || right ? 2 : 1);
        pixel.dy = (here(x, below ? y : y + 1) - here(x, above ? y : y - 1)) * (above || below ? 2 : 1);
        pixel.dz = density(number + 1, x, y) - density(number - 1, x, y);
        Pixel& p = at(x, y);
        ++out.counts["pixels_composited"];
        if (p.C[3] < c.eps) ++out.counts["frozen_pixels"];
        composite(p, oracle::classify(c, density_tables, patterns, pixel), tile.mode - 8);  // N-6.2-2
        for (const Wide value : p.C) words.push_back(word(value));
      }
    emit(Kind::Composite, 0, bx, by, std::move(words));
  }

  /// For pixel (i, j) of the footprint, by the page's formula of the kind: rlut N-4-6, separable N-4.5-2, blit2d
  /// N-4.4-1, squared N-4.2-2, squared_elliptic N-4.3-3, linear N-4.1-2. Separable and blit2d read no RADIAL (N-4.5-4,
  /// N-4.4-9).
  Wide weight(const RadiusSet& set, Wide mx, Wide my, std::int64_t i, std::int64_t j) const {
    if (c.index == "rlut") return entry(column(set, mx, i) + column(set, my, j), c.g);
    if (c.index == "separable")
      return narrow(Rounding::Rnd, Overflow::Sat, column(set, mx, i) * column(set, my, j), 2 * (c.wf + c.g),
                    u(c.wi, c.wf))
          .word;
    if (c.index == "blit2d") return stored(set, mx, my, i, j);
    // N-3-8: the offset from the centre.
    const Wide dx = (i + 1) * Wide{c.K()} - mx - set.rho, dy = (j + 1) * Wide{c.K()} - my - set.rho;
    if (c.index == "squared") return entry(set.words[0] * (dx * dx + dy * dy), int_of(set, 1));
    if (c.index == "squared_elliptic") {
      const Wide B = static_cast<std::int32_t>(set.words[1]);
      const Wide q = set.words[0] * dx * dx + B * dx * dy + set.words[2] * dy * dy;
      return entry(q, int_of(set, 3));
    }
    // linear: the largest s whose square does not exceed the squared distance in 2^-g steps.
    const Wide square = (dx * dx + dy * dy) * power_of_two(2 * c.g);
    Wide low = 0, high = power_of_two(33);
    while (high - low > 1) {
      const Wide middle = (low + high) / 2;
      (middle * middle <= square ? low : high) = middle;
    }
    return entry(low * set.words[0], int_of(set, 1));
  }
  static int int_of(const RadiusSet& set, std::size_t word) { return static_cast<int>(set.words[word]); }
  /// Weight at q entries, f fraction bits (N-4-6); interpolated if the device does (N-4.7-1).
  Wide entry(Wide q, int f) const {
    const Wide t = floor_divide(q, power_of_two(f));
    if (t >= c.N) return 0;
    const Wide here = radial[static_cast<std::size_t>(t)];
    if (c.interpolate == 0) return here;
    // N-4.7-2: the remainder of q, in steps of 2^-g; N-4.7-3: the weight.
    const Wide rest = floor_divide(remainder(q, power_of_two(f)) * power_of_two(c.g), power_of_two(f));
    const Wide next = radial[static_cast<std::size_t>(t) + 1];
    return here - narrow(Rounding::Rnd, Overflow::Sat, (here - next) * rest, c.wf + c.g, s(c.wi + 1, c.wf)).word;
  }

  /// blit2d (N-4.4-1, N-4.4-5). With eightfold symmetry the footprint is searched: the phases, their mirror images and
  /// both exchanged, until a stored pair is found (N-4.4-3, N-4.4-4).
  Wide stored(const RadiusSet& set, Wide mx, Wide my, Wide i, Wide j) const {
    const auto word_of_footprint = [&](Wide number, Wide column, Wide row) {
      if (column < 0 || row < 0 || column >= set.Ea || row >= set.Ea) return Wide{0};
      return Wide{set.words[static_cast<std::size_t>((number * set.Ea + row) * set.Ea + column)]};
    };
    if (c.symmetry == "off") return word_of_footprint(my * c.k + mx, i, j);
    const auto image = [&](Wide m) { return remainder(-m - 2 * set.rho, c.k); };
    const auto mirror = [&](Wide& m, Wide& at) {
      if (m <= image(m)) return;
      // d(m, i) = (i+1) k - m - rho, with the sign reversed.
      const Wide d = -((at + 1) * c.k - m - set.rho);
      m = image(m);
      at = (d + m + set.rho) / c.k - 1;
      if ((at + 1) * c.k - m - set.rho != d) throw std::logic_error("the mirror image of a pixel is a pixel");
    };
    mirror(mx, i);
    mirror(my, j);
    if (mx > my) std::swap(mx, my), std::swap(i, j);
    Wide number = 0;  // of the stored pairs before this one
    for (Wide b = 0; b < c.k; ++b)
      for (Wide a = 0; a <= b; ++a) {
        if (b == my && a == mx) return word_of_footprint(number, i, j);
        if (a <= image(a) && b <= image(b)) ++number;
      }
    throw std::logic_error("no such footprint");
  }

  Wide column(const RadiusSet& set, Wide m, std::int64_t i) const {
    return rlut[static_cast<std::size_t>(m * c.columns + set.base + i)];
  }

  void take(const SheetEnd&) {
    ++out.counts["sheets"];  // N-9-9
    if (densities()) {
      // The previous sheet, with any number (N-6.2-4).
      if (density_sheets.size() > 1) classify_sheet(std::prev(density_sheets.end(), 2)->first);
      return;
    }
    for (int by = 0; by < tile.height; by += c.P)
      for (int bx = 0; bx < tile.width; bx += c.P) block(bx, by);
    frozen.emplace_back();
    for (const Pixel& p : pixels) frozen.back().push_back(p.C[3] < c.eps);
  }

  /// Every pixel is composited, dirty or not: the model, which visits dirty blocks only, must agree (N-6-10). Blocks
  /// go row by row (N-9-4); only dirty ones have a tap and are counted (N-9-6, N-9-12).
  void block(int bx, int by) {
    bool dirty = false;
    for (int y = by; y < by + c.P; ++y)
      for (int x = bx; x < bx + c.P; ++x) dirty = dirty || (inside(x, y) && at(x, y).hit);
    std::vector<std::uint32_t> words;
    for (int y = by; y < by + c.P; ++y)
      for (int x = bx; x < bx + c.P; ++x) {
        if (!inside(x, y)) {
          words.insert(words.end(), 4, 0);
          continue;
        }
        Pixel& p = at(x, y);
        if (dirty) ++out.counts["pixels_composited"];
        // N-9-14
        if (dirty && tile.mode != 2 && p.C[3] < c.eps) ++out.counts["frozen_pixels"];
        composite(p, tinted(p.S, x, y), tile.mode);
        for (const Wide value : p.C) words.push_back(word(value));
      }
    if (!dirty) return;
    ++out.counts["dirty_blocks"];
    emit(Kind::Composite, 0, bx, by, std::move(words));
  }

  /// The composited value of a sheet's sums at a pixel of the tile (N-6.3-8).
  Four tinted(Four S, Wide x, Wide y) const {
    if (!patterns.loaded() || tile.mode > 1) return S;  // N-6.3-1, N-6.3-10
    const Solid solid = solid_at(c, patterns, tile.x + x, tile.y + y, sheet);
    for (std::size_t ch = 0; ch < 3; ++ch)
      S[ch] = narrow(Rounding::Rnd, Overflow::Sat, S[ch] * solid.tint[ch], c.sf + 16, u(c.si, c.sf)).word;
    return S;
  }

  /// S of a sheet or a sample, by mode 0, 1 or 2.
  void composite(Pixel& p, const Four& S, int mode) {
    if (mode == 2) {  // N-6-9
      for (std::size_t ch = 0; ch < 4; ++ch)
        p.C[ch] = sat(Rounding::Trn, p.C[ch] + S[ch], c.sf, u(c.si, c.sf), "composite_saturated");
      return;
    }
    Wide f = 1;
    int f_bits = 0;   // mode 1: the factor is the integer 1 (N-6-5)
    if (mode == 0) {  // N-6-2
      const int b = c.si + c.sf - log2_of(c.G);
      const Wide i = floor_divide(S[3], power_of_two(b)), rem = remainder(S[3], power_of_two(b));
      const Wide left = factor[static_cast<std::size_t>(i)], right = factor[static_cast<std::size_t>(i) + 1];
      f = left - sat(c.Rf, (left - right) * rem, c.of + b, one(c.of), "never");
      f_bits = c.of;
    }
    const Words colours = c.ci == 0 ? one(c.tf) : u(c.ci, c.tf);
    Four slab;  // N-6-3; counted before the test whether the pixel is frozen (N-9-13)
    for (std::size_t ch = 0; ch < 4; ++ch)
      slab[ch] = sat(c.Ra, S[ch] * f, c.sf + f_bits, ch < 3 ? colours : one(c.tf), "opacity_saturated");
    const Wide T = p.C[3];
    if (T < c.eps) return;  // N-6-6
    // N-6-7; the cut of a colour counts (N-9-15)
    for (std::size_t ch = 0; ch < 3; ++ch) {
      const Wide seen = sat(c.Rl, T * slab[ch], 2 * c.tf, colours, "never");
      p.C[ch] = sat(Rounding::Trn, p.C[ch] + seen, c.tf, u(1 + c.ci, c.tf), "composite_saturated");
    }
    p.C[3] = T - sat(c.Rl, T * slab[3], 2 * c.tf, one(c.tf), "never");
  }

  void take(const TileEnd&) {
    // The last sheet of densities, before the pixels (N-6.2-4, N-9-5).
    if (!density_sheets.empty()) classify_sheet(density_sheets.rbegin()->first);
    sheet = 0;  // of the Pixel events (N-9-2)
    Picture picture{tile.tile, tile.x, tile.y, tile.width, tile.height, {}};
    const Words pixel = u(c.xi, c.xf);
    // N-7-1
    for (int y = 0; y < tile.height; ++y)
      for (int x = 0; x < tile.width; ++x) {
        Four rgba = at(x, y).C;
        if (tile.mode != 2) rgba[3] = power_of_two(c.tf) - rgba[3];  // N-6-8
        std::vector<std::uint32_t> words;                            // N-7-2, N-9-15
        for (const Wide value : rgba)
          words.push_back(word(sat(c.Ro, value, tile.mode == 2 ? c.sf : c.tf, pixel, "pixel_saturated")));
        picture.words.insert(picture.words.end(), words.begin(), words.end());
        emit(Kind::Pixel, 0, x, y, std::move(words));
      }
    out.tiles.push_back(std::move(picture));
  }

  /// A tap record (N-9-1), after the earlier ones (N-9-4).
  void emit(Kind kind, std::uint32_t tag, Wide x, Wide y, std::vector<std::uint32_t> payload) {
    out.events.push_back(
        {kind, tile.tile, sheet, tag, static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), std::move(payload)});
  }

  Symbols c;
  Rendering out;
  std::map<std::int64_t, RadiusSet> sets;
  std::vector<std::uint32_t> rlut, radial, factor;
  DensityTables density_tables;
  PatternTables patterns;
  std::map<std::int64_t, std::map<std::pair<Wide, Wide>, Four>> density_sheets;  // by number; S at (y, x)
  TileStart tile;
  std::uint32_t sheet = 0;
  std::vector<Pixel> pixels;
  std::vector<std::vector<bool>> frozen;  // the tile's pixels after each of its sheets
  std::vector<bool> announced;            // of the next splats, whether their group is hidden
};

}  // namespace

Rendering render(const Symbols& symbols, std::span<const std::uint8_t> bytes) { return Renderer(symbols).run(bytes); }

}  // namespace fastsplat::oracle
