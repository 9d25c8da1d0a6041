// SPDX-License-Identifier: Apache-2.0
#include "tests/driver/oracle/frame.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <span>

#include "tests/cmodel/oracle/number.hpp"
#include "tests/driver/oracle/cells.hpp"
#include "tests/driver/oracle/ellipse.hpp"

namespace fastsplat::scene_oracle {
namespace {

using oracle::ceil_divide;
using oracle::floor_divide;
using oracle::log2_of;
using oracle::narrow;
using oracle::Overflow;
using oracle::power_of_two;
using oracle::Rounding;
using oracle::Wide;

std::int64_t to_int(Wide wide) { return static_cast<std::int64_t>(wide); }
std::uint32_t u32(std::int64_t word) { return static_cast<std::uint32_t>(static_cast<std::uint64_t>(word)); }

struct Sets {
  std::vector<RadiusSet> all;
  double r_min = 0.0;
  double b = 0.0;  ///< bins per e-fold
};

Sets radius_sets(const Given& given) {
  const oracle::Symbols& symbols = given.symbols;
  double r_max = 0.0;
  Sets sets;
  sets.r_min = HUGE_VAL;
  for (const double s : given.scale_at_corner) {
    const double r = given.R * given.u * s;  // N-8-25
    sets.r_min = std::min(sets.r_min, r);
    r_max = std::max(r_max, r);
  }
  if (2 * std::ceil(r_max * symbols.K()) > symbols.columns * symbols.K())  // N-8-26
    throw Refused("a support radius beyond half the RLUT's columns");
  const RadiusSet largest = radius_set(symbols, r_max);
  if (r_max <= sets.r_min * (1 + 1e-9) || shaped(given)) {  // N-8-27, N-8-43: one set
    sets.all = {largest};
    return sets;
  }
  const bool columns = symbols.index == "rlut" || symbols.index == "separable";
  // N-8-27: the number of sets. N-8-28: their radii. N-8-31: their bases.
  const std::int64_t room = symbols.has_phases() ? symbols.columns / largest.Ea : symbols.sets;
  const std::int64_t n = std::min<std::int64_t>(room, symbols.sets);
  sets.b = static_cast<double>(n) / std::log(r_max / sets.r_min);
  for (std::int64_t i = 0; i < n; ++i) {
    sets.all.push_back(radius_set(symbols, sets.r_min * std::exp((static_cast<double>(i) + 0.5) / sets.b)));
    sets.all.back().base = columns ? i * largest.Ea : 0;
  }
  return sets;
}

struct Sheets {
  int mode = 0;
  std::int64_t S = 1;
  bool sliced = false;
  double nearest_boundary = 0.0, width = 0.0;  ///< kernel units, where sliced
};

/// N-8-62: the table of the page, with the slabs of N-8-55.
Sheets sheets_of(const Given& given) {
  const double half = std::ceil((given.D / given.u + given.R) / given.w);
  const auto slabs = static_cast<std::int64_t>(2 * half);
  const int composited = given.additive ? 1 : 0;
  switch (given.method) {
    case Method::ImageAligned:
      return {composited, slabs + static_cast<std::int64_t>(given.slabs_before + given.slabs_behind), true,
              -half * given.w - given.slabs_before * given.w, given.w};
    case Method::AxisAligned:
      return {composited, given.grid_sheets, false, 0.0, 0.0};
    case Method::Westover:
      return {4 + composited, 1, false, 0.0, 0.0};
    case Method::XRay:
      break;
  }
  if (given.xray_sheets == 1) return {2, 1, false, 0.0, 0.0};
  return {2, given.xray_sheets, true, -half * given.w, 2 * half * given.w / given.xray_sheets};
}

/// X (N-8-23).
double exposure(const Given& given) {
  if (given.method != Method::XRay) return 1.0;
  if (given.xray_exposure != 0.0) return given.xray_exposure;
  return given.L > 0.0 ? 1 / (1.05 * given.L * given.o) : 1.0;
}

using Words = std::array<std::int64_t, 4>;  // R, G, B, tau

/// The part of a splat in one sheet.
struct Share {
  Words v{};
  bool cut = false;
};

/// A splat in integers.
struct Splat {
  std::uint64_t order = 0;    ///< in the traversal
  std::int64_t x = 0, y = 0;  ///< 2^-pf pixel, of the image
  std::size_t set = 0;
  std::int64_t first_sheet = 0;
  std::vector<Share> shares;  ///< of every sheet
  std::int64_t first_tile = -1;
  std::optional<EllipseWords> ellipse;
};

class Page {
 public:
  explicit Page(const Given& given)
      : given_(given),
        symbols_(given.symbols),
        sets_(radius_sets(given)),
        sheets_(sheets_of(given)),
        phi_(phi(given)),
        radial_(radial(given)) {
    for (std::int64_t s = 0; sheets_.sliced && s <= sheets_.S; ++s) {  // N-8-65
      B_.push_back(nearest(static_cast<double>(s) * sheets_.width * std::ldexp(1.0, symbols_.zf)));
      if (s > 0 && B_[static_cast<std::size_t>(s)] == B_[static_cast<std::size_t>(s - 1)])
        throw Refused("two slab boundaries are equal");
    }
    for (const RealSplat& real : given.splats) add(real);
    std::stable_sort(splats_.begin(), splats_.end(),  // N-8-73: the splats' order
                     [](const Splat& x, const Splat& y) { return x.first_sheet < y.first_sheet; });
  }

  Frame frame() {
    Frame frame;
    preamble(frame.preamble);
    for (std::int64_t tile = 0; tile < across() * down(); ++tile) frame.tiles.push_back(tile_beats(tile));
    met_.radius_sets = sets_.all.size();
    met_.several_sets = sets_.all.size() > 1 ? 1 : 0;
    for (const std::uint32_t word : radial(given_))
      met_.cut_weights += word == oracle::u(symbols_.wi, symbols_.wf).largest ? 1 : 0;
    met_.odd_steps = std::ceil(std::ldexp(2.0 * given_.R, symbols_.zf)) + 1 == static_cast<double>(phi_.size()) ? 0 : 1;
    frame.met = met_;
    return frame;
  }

 private:
  // N-8-69: the tiles.
  std::int64_t across() const { return to_int(ceil_divide(given_.width, symbols_.W)); }
  std::int64_t down() const { return to_int(ceil_divide(given_.height, symbols_.H)); }

  std::size_t set_of(double r) {
    if (sets_.all.size() == 1) return 0;
    const double bin = std::floor(std::log(r / sets_.r_min) * sets_.b);  // N-8-28
    const auto last = static_cast<double>(sets_.all.size() - 1);
    met_.clamped_sets += bin < 0.0 || bin > last ? 1 : 0;
    return static_cast<std::size_t>(std::clamp(bin, 0.0, last));
  }

  void add(const RealSplat& real) {
    ++met_.voxels;
    const double one = std::ldexp(1.0, symbols_.pf);
    Splat splat;
    splat.order = met_.voxels;
    const bool rounded_later = symbols_.K() < one && symbols_.Rs == Rounding::Rnd;  // N-8-36
    splat.x = rounded_later ? to_int(static_cast<Wide>(std::floor(real.x * one))) : nearest(real.x * one);
    splat.y = rounded_later ? to_int(static_cast<Wide>(std::floor(real.y * one))) : nearest(real.y * one);
    const double r = given_.R * given_.u * real.s;
    splat.set = set_of(r);
    const bool ellipse = shaped(given_) && !is_circle_of(given_, real.shapes.back(), sets_.all[0].r);
    if (ellipse) {  // N-8-44, N-8-49
      splat.x = nearest(real.x * one);
      splat.y = nearest(real.y * one);
      splat.ellipse = ellipse_words(given_, real.shapes.back(), splat.x, splat.y);
    }
    const double r_set = sets_.all[splat.set].r;

    // N-8-7: peak and A. N-8-37: f.
    const double peak = given_.a / (std::numbers::pi * (1 - std::exp(-given_.a * given_.R * given_.R)));
    const double A = peak * given_.cx * given_.cy * given_.cz;
    const double f = ellipse ? A * exposure(given_) : A * exposure(given_) * (r / r_set) * (r / r_set);
    const Wide most = power_of_two(symbols_.cf + 4) - 1;
    std::array<Wide, 4> V{};
    bool cut = false, visible = false;
    // N-8-58: which splats carry, and runs. N-8-61: the initial remainder of a run.
    const bool carried = symbols_.carry == "on" || (symbols_.carry == "xray" && given_.method == Method::XRay);
    auto& [rest, last, count] = runs_[{real.i, real.j}];
    if (count == 0 || real.g != last + 1) rest.assign(4, 0.5), count = 0;
    last = real.g;
    if (++count == 3)
      for (double& left : rest)
        left += (32768 + std::int64_t{49472} * real.i + std::int64_t{37345} * real.j) % 65536 / 65536.0 - 0.5;
    for (std::size_t c = 0; c < 4; ++c) {
      double value = real.e[c] * f;
      if (ellipse) value = as_shaped(real, *splat.ellipse, value);
      const double real_word = value * std::ldexp(1.0, symbols_.cf);
      // N-8-37, or with the carry N-8-59.
      const double t = carried ? real_word + rest[c] : real_word + 0.5;
      const double word = std::floor(std::max(t, 0.0));
      const bool beyond = word > static_cast<double>(most);
      V[c] = beyond ? most : static_cast<Wide>(word);
      met_.carried_words += carried && word != std::floor(real_word + 0.5) ? 1 : 0;
      if (carried) rest[c] = beyond ? 0.0 : t - shown(V[c]);
      met_.saturated_words += beyond ? 1 : 0;
      cut = cut || beyond;
      visible = visible || V[c] != 0;
    }
    met_.saturated_voxels += cut ? 1 : 0;
    if (!visible) {  // N-8-38
      ++met_.vanished_voxels;
      return;
    }
    // N-8-54
    if (ellipse && splat.ellipse->too_large) throw Refused("a footprint beyond the RLUT's columns");
    met_.ellipses += ellipse ? 1 : 0;
    met_.thin_ellipses += ellipse && splat.ellipse->thin ? 1 : 0;
    if (sheets_.sliced)
      slice(splat, V, real.z, shaped(given_) ? real.lambda : 1.0);
    else
      whole(splat, V, given_.method == Method::AxisAligned ? real.g : 0);
    splats_.push_back(splat);
  }

  /// A splat's reals after all techniques (N-8-42), and whether it is thin (N-8-46).
  static double as_shaped(const RealSplat& real, const EllipseWords& words, double value) {
    const auto det = [](const Shape& S) { return S.xx * S.yy - S.xy * S.xy; };
    for (std::size_t i = 1; i < real.shapes.size(); ++i)
      value *= std::sqrt(det(real.shapes[i - 1]) / det(real.shapes[i]));
    return words.thin ? value * words.factor : value;
  }

  /// The sheets' average of a word (N-8-60).
  double shown(Wide V) {
    Wide all = 0;
    const auto area = [&](std::size_t t) {
      // Halved: N-4.7-5.
      if (symbols_.interpolate != 0) return t == 0 || t + 1 == radial_.size() ? Wide{1} : Wide{2};
      return symbols_.index == "linear" ? 2 * static_cast<Wide>(t) + 1 : Wide{1};
    };
    for (std::size_t t = 0; t < radial_.size(); ++t) all += radial_[t] * area(t);
    if (V >= 256 || all == 0) return static_cast<double>(V);
    const auto [at, is_new] = shown_.try_emplace(to_int(V));
    if (is_new) {
      Wide sum = 0;
      const oracle::Words sheet = oracle::u(symbols_.si, symbols_.sf);
      for (std::size_t t = 0; t < radial_.size(); ++t)
        sum += narrow(symbols_.Rp, Overflow::Sat, V * radial_[t], symbols_.cf + symbols_.wf, sheet).word * area(t);
      at->second = static_cast<double>(sum) * std::ldexp(1.0, symbols_.cf + symbols_.wf - symbols_.sf) /
                   static_cast<double>(all);
    }
    return at->second;
  }

  /// One channel of a splat in a record: v_c of N-8-66 and N-8-67.
  void input(Share& share, std::size_t c, Wide part) {
    const auto v = narrow(Rounding::Trn, Overflow::Sat, part, symbols_.cf, oracle::u(symbols_.ci, symbols_.cf));
    share.v[c] = to_int(v.word);
    share.cut = share.cut || v.overflow;
    met_.saturated_words += v.overflow ? 1 : 0;
  }

  void whole(Splat& splat, const std::array<Wide, 4>& V, int sheet) {
    splat.first_sheet = sheet;  // N-8-68: its sheet
    splat.shares.resize(static_cast<std::size_t>(sheets_.S));
    for (std::size_t c = 0; c < 4; ++c) input(splat.shares[static_cast<std::size_t>(sheet)], c, V[c]);
  }

  void slice(Splat& splat, const std::array<Wide, 4>& V, double z, double lambda) {
    const auto M = static_cast<std::int64_t>(phi_.size()) - 1;
    // N-8-65: zq. N-8-57: grown kernels. N-8-68: the first sheet. N-8-66: the shares.
    const std::int64_t zq = nearest((z / given_.u - sheets_.nearest_boundary) * std::ldexp(1.0, symbols_.zf));
    const std::int64_t g = nearest(65536 / lambda);
    const std::int64_t D = to_int(ceil_divide(M / 2 * Wide{65536}, g));
    while (splat.first_sheet < sheets_.S - 1 && B_[static_cast<std::size_t>(splat.first_sheet + 1)] <= zq - D)
      ++splat.first_sheet;
    const auto entry = [&](std::int64_t s) {
      const Wide way = floor_divide(Wide{B_[static_cast<std::size_t>(s)] - zq} * g, 65536);
      const std::int64_t i = std::clamp<std::int64_t>(to_int(way) + M / 2, 0, M);
      const std::int64_t ended = s == 0 ? 0 : s == sheets_.S ? M : i;
      met_.rims_kept += ended != i ? 1 : 0;
      return ended;
    };
    const auto h = [&](std::int64_t i, std::size_t c) {
      return narrow(Rounding::Rnd, Overflow::Sat, V[c] * phi_[static_cast<std::size_t>(i)], symbols_.cf + symbols_.hf,
                    oracle::u(4, symbols_.cf))
          .word;
    };
    for (std::int64_t s = 0; s < sheets_.S; ++s) {
      const std::int64_t before = entry(s), after = entry(s + 1);
      Share& share = splat.shares.emplace_back();
      if (before == after) continue;  // the kernel does not reach this slab
      met_.grown += g != 65536 ? 1 : 0;
      for (std::size_t c = 0; c < 4; ++c) input(share, c, h(after, c) - h(before, c));
      met_.left_out += share.v == Words{} ? 1 : 0;
    }
  }

  /// N-8-72: the records before the tiles, in this order.
  void preamble(std::vector<Beat>& beats) const {
    const std::uint64_t hash = oracle::hash(symbols_);
    beats.push_back({0x46U | 2U << 16, 0x31535346U, static_cast<std::uint32_t>(hash),
                     static_cast<std::uint32_t>(hash >> 32), u32(given_.width) | u32(given_.height) << 16,
                     u32(across() * down())});
    load_table(beats, 1, 0, {}, radial(given_));
    load_table(beats, 2, 0, {}, factor(symbols_));
    for (std::size_t n = 0; n < sets_.all.size(); ++n)
      load_table(beats, 0, n, sets_.all[n], set_words(given_, sets_.all[n]));
  }

  static void load_table(std::vector<Beat>& beats, std::uint32_t table, std::size_t n, const RadiusSet& set,
                         const std::vector<std::uint32_t>& words) {
    beats.push_back({0x4CU | table << 8, static_cast<std::uint32_t>(n), u32(set.rho),
                     static_cast<std::uint32_t>(words.size()), u32(set.base), 0});
    for (std::size_t i = 0; i < words.size(); ++i) {
      const std::size_t place = i % std::tuple_size_v<Beat>;
      if (place == 0) beats.emplace_back();  // entries without a word stay 0
      beats.back()[place] = words[i];
    }
  }

  /// Of the windows, along one axis: x0 and y0 of N-8-70.
  Wide first_pixel(std::int64_t q, const RadiusSet& set) const {
    const Wide xs = narrow(symbols_.Rs, Overflow::Sat, q, symbols_.pf, oracle::s(60, log2_of(symbols_.K()))).word;
    return floor_divide(xs - set.rho, symbols_.K()) + 1;  // no end of the format is near
  }

  /// N-8-70: whether `extent` pixels from the window's first one on meet a whole tile's `side` pixels, along one axis.
  bool meets(std::int64_t q, const RadiusSet& set, std::int64_t extent, std::int64_t first, std::int64_t side) const {
    const Wide x0 = first_pixel(q, set);
    return x0 < first + side && x0 + extent > first;
  }

  /// The records of one sheet of one tile.
  std::vector<Beat> ellipse_beats(const Splat& splat, const Words& v, std::int64_t X, std::int64_t Y,
                                  std::uint32_t& tag) const {
    const EllipseWords& e = *splat.ellipse;
    const std::int64_t pixel = to_int(power_of_two(symbols_.pf));
    const std::int64_t x = to_int(floor_divide(splat.x, pixel)) - X, y = to_int(floor_divide(splat.y, pixel)) - Y;
    const auto field = [](std::int64_t value, int first, int n) {
      return (u32(value) & ((std::uint32_t{1} << n) - 1)) << first;
    };
    std::vector<Beat> beats;
    for (const Span& span : e.spans) {  // N-8-53: the tiles of a record
      if (x + span.left >= std::min<std::int64_t>(symbols_.W, given_.width - X) || x + span.last_column < 0) continue;
      if (y + span.top >= std::min<std::int64_t>(symbols_.H, given_.height - Y) || y + span.last_row < 0) continue;
      beats.push_back({0x45U | field(e.B, 8, 24), tag++,
                       field(splat.x - X * pixel, 0, 22) | field(span.nx - 1, 22, 5) | field(span.ny - 1, 27, 5),
                       field(splat.y - Y * pixel, 0, 22) | field(e.h, 22, 6), u32(v[0]) | u32(v[1]) << 16,
                       u32(v[2]) | u32(v[3]) << 16, field(e.A, 0, 22) | field(span.left, 22, 10),
                       field(e.C, 0, 22) | field(span.top, 22, 10)});
    }
    return beats;
  }

  /// The records of one splat in one sheet of one tile.
  void splat_beats(Splat& splat, std::int64_t tile, std::int64_t s, std::int64_t X, std::int64_t Y, std::uint32_t& tag,
                   std::vector<Beat>& records) {
    const auto& [v, cut] = splat.shares[static_cast<std::size_t>(s)];
    if (v == Words{}) return;  // N-8-67
    std::vector<Beat> made;
    if (splat.ellipse) {
      made = ellipse_beats(splat, v, X, Y, tag);
      met_.ellipse_records += made.size();
      met_.many_spans += made.size() > 1 ? 1 : 0;
    } else if (in_tile(splat, X, Y, true)) {
      const std::int64_t pixel = to_int(power_of_two(symbols_.pf));
      // N-8-71: the position in the tile.
      made.push_back({0x50U | static_cast<std::uint32_t>(splat.set) << 8, tag++, u32(splat.x - X * pixel),
                      u32(splat.y - Y * pixel), u32(v[0]) | u32(v[1]) << 16, u32(v[2]) | u32(v[3]) << 16});
      met_.reordered += splat.order < last_order_ ? 1 : 0;
      last_order_ = splat.order;
    } else {
      met_.beyond_E += in_tile(splat, X, Y, false) ? 1 : 0;
    }
    records.insert(records.end(), made.begin(), made.end());
    met_.saturated_records += cut ? made.size() : 0;
    if (made.empty()) return;
    if (splat.first_tile < 0) splat.first_tile = tile;
    met_.other_tiles += splat.first_tile != tile ? made.size() : 0;
  }

  /// By the extent E (N-8-70), or by Ea.
  bool in_tile(const Splat& splat, std::int64_t X, std::int64_t Y, bool by_E) const {
    const RadiusSet& set = sets_.all[splat.set];
    const std::int64_t extent = by_E ? set.E : set.Ea;
    return meets(splat.x, set, extent, X, symbols_.W) && meets(splat.y, set, extent, Y, symbols_.H);
  }

  /// N-8-74.
  bool goes_in_sets() const { return symbols_.cull != "off" && sheets_.mode < 2 && !shaped(given_); }

  /// The most sheets that a kernel has beyond its first (N-8-77).
  std::int64_t reach() const {
    if (!sheets_.sliced) return 0;
    const auto M = static_cast<std::int64_t>(phi_.size()) - 1;
    std::int64_t most = 0;
    for (std::int64_t first = 0; first < sheets_.S; ++first) {
      const std::int64_t end = B_[static_cast<std::size_t>(first + 1)] - 1 + M;  // of the deepest that begins there
      std::int64_t last = first;
      while (last + 1 < sheets_.S && B_[static_cast<std::size_t>(last + 1)] < end) ++last;
      most = std::max(most, last - first);
    }
    return most;
  }

  void set_beats(std::int64_t tile, std::int64_t s, std::int64_t X, std::int64_t Y, bool may_hide, std::uint32_t& tag,
                 std::vector<Beat>& blocks, std::vector<Beat>& records) {
    const Cells cells = cells_of(symbols_.P, symbols_.W, symbols_.H);
    std::vector<std::vector<Splat*>> of(static_cast<std::size_t>(cells.columns * cells.rows));
    std::vector<std::int64_t> candidates(of.size());
    std::int64_t narrowest = sets_.all[0].Ea, widest = narrowest;
    for (const RadiusSet& set : sets_.all) narrowest = std::min(narrowest, set.Ea), widest = std::max(widest, set.Ea);
    // N-8-75: a splat's cell.
    const auto place = [&](std::int64_t q, const RadiusSet& set, std::int64_t first, std::int64_t count) {
      return std::clamp<std::int64_t>(to_int(floor_divide(first_pixel(q, set) - first, cells.side)), 0, count - 1);
    };
    for (Splat& splat : splats_) {  // N-8-76: candidates
      if (splat.first_sheet < s - reach() || splat.first_sheet > s || !in_tile(splat, X, Y, true)) continue;
      const RadiusSet& set = sets_.all[splat.set];
      const auto cell = static_cast<std::size_t>(place(splat.y, set, Y, cells.rows) * cells.columns +
                                                 place(splat.x, set, X, cells.columns));
      of[cell].push_back(&splat);
      ++candidates[cell];
    }
    const std::int64_t windows = narrowest / symbols_.P * (narrowest / symbols_.P);
    const SheetCells split = sheet_cells(cells, candidates, windows, may_hide, widest);
    const auto take = [&](std::size_t cell) {
      for (Splat* splat : of[cell]) splat_beats(*splat, tile, s, X, Y, tag, records);
    };
    // N-8-79: w5. N-8-80: the order of sets and of other cells.
    for (const CellSet& set : split.sets) {
      const std::uint32_t first = tag;
      std::ranges::for_each(set.cells, take);
      blocks.push_back({0x43U, first, u32(set.x), u32(set.y), u32(set.width) | u32(set.height) << 16, tag - first});
      ++met_.sets;
    }
    std::ranges::for_each(split.others, take);
  }

  /// N-8-73: sheets, splats and tags of a tile; N-8-80 if they form groups.
  std::vector<Beat> tile_beats(std::int64_t tile) {
    const std::int64_t X = tile % across() * symbols_.W, Y = tile / across() * symbols_.H;
    const std::int64_t width = std::min<std::int64_t>(symbols_.W, given_.width - X);
    const std::int64_t height = std::min<std::int64_t>(symbols_.H, given_.height - Y);
    std::vector<Beat> beats{
        {0x54U | u32(sheets_.mode) << 8, u32(tile), u32(X), u32(Y), u32(width) | u32(height) << 16, 0}};
    std::uint32_t tag = 0, sheets = 0;
    for (std::int64_t s = 0; s < sheets_.S; ++s) {
      std::vector<Beat> records, blocks;
      if (goes_in_sets())
        set_beats(tile, s, X, Y, sheets >= 2, tag, blocks, records);
      else
        for (Splat& splat : splats_) splat_beats(splat, tile, s, X, Y, tag, records);
      last_order_ = 0;
      if (records.empty() && blocks.empty()) continue;
      ++sheets;
      beats.push_back({0x53U, u32(s), 0, 0, 0, 0});
      beats.insert(beats.end(), blocks.begin(), blocks.end());
      beats.insert(beats.end(), records.begin(), records.end());
      beats.push_back({0x73U, u32(s), static_cast<std::uint32_t>(records.size()), 0, 0, 0});
    }
    beats.push_back({0x74U, u32(tile), sheets, 0, 0, 0});
    met_.splat_records += tag;
    met_.sheets += sheets;
    met_.empty_tiles += sheets == 0 ? 1 : 0;
    return beats;
  }

  const Given& given_;
  const oracle::Symbols& symbols_;
  Sets sets_;
  Sheets sheets_;
  std::vector<std::int64_t> phi_, B_;
  std::vector<std::uint32_t> radial_;
  std::map<std::int64_t, double> shown_;
  std::vector<Splat> splats_;
  struct Run {
    std::vector<double> rest;  ///< the remainders of its channels
    int last = 0, count = 0;   ///< the last splat's slice; how many splats there are
  };
  std::map<std::pair<int, int>, Run> runs_;  ///< per line of voxels, the last one
  std::uint64_t last_order_ = 0;             ///< of the sheet's records so far
  Met met_;
};

constexpr MetName kMet[] = {
    {"voxels", &Met::voxels},
    {"vanished voxels", &Met::vanished_voxels},
    {"saturated voxels", &Met::saturated_voxels},
    {"splat records", &Met::splat_records},
    {"saturated records", &Met::saturated_records},
    {"sheets", &Met::sheets},
    {"radius sets", &Met::radius_sets},
    {"frames with several sets", &Met::several_sets},
    {"radii outside the bins", &Met::clamped_sets},
    {"saturated words", &Met::saturated_words},
    {"weights cut", &Met::cut_weights},
    {"frames with M made even", &Met::odd_steps},
    {"slices that kept a rim", &Met::rims_kept},
    {"slices left out", &Met::left_out},
    {"records that only Ea would bring", &Met::beyond_E},
    {"records in further tiles", &Met::other_tiles},
    {"records out of traversal order", &Met::reordered},
    {"empty tiles", &Met::empty_tiles},
    {"sets of splats", &Met::sets},
    {"words that the carry changed", &Met::carried_words},
    {"voxels as ellipses", &Met::ellipses},
    {"ellipse records", &Met::ellipse_records},
    {"ellipses grown across", &Met::thin_ellipses},
    {"ellipses of several records", &Met::many_spans},
    {"slices of grown kernels", &Met::grown},
};

}  // namespace

std::span<const MetName> met_names() { return kMet; }

bool is_of_ellipses(std::uint64_t Met::*member) {
  return member == &Met::ellipses || member == &Met::ellipse_records || member == &Met::thin_ellipses ||
         member == &Met::many_spans || member == &Met::grown;
}

Frame compile(const Given& given) { return Page(given).frame(); }

/// N-8-72: the end of the stream.
Beat end_frame(const Frame& frame) {
  std::uint64_t beats = 0;
  std::vector<std::uint8_t> bytes;
  const auto add = [&](const std::vector<Beat>& part) {
    beats += part.size();
    for (const Beat& beat : part)
      for (const std::uint32_t word : beat)
        for (int byte = 0; byte < 4; ++byte) bytes.push_back(static_cast<std::uint8_t>(word >> (8 * byte)));
  };
  add(frame.preamble);
  for (const auto& tile : frame.tiles) add(tile);
  return {0x66U, static_cast<std::uint32_t>(beats), static_cast<std::uint32_t>(beats >> 32), oracle::crc32(bytes), 0,
          0};
}

}  // namespace fastsplat::scene_oracle
