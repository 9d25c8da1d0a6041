// SPDX-License-Identifier: Apache-2.0
// Every unit at small widths, exhaustively: streams that put each combination of words through the device, all taps and
// pixels compared with the oracle.
#include <gtest/gtest.h>

#include "cmodel/numbers/window_geometry.hpp"
#include "tests/cmodel/compare_helper.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

/// One pixel per splat: P = 1, k = 2 and rho = 1, so a splat covers the pixel it is centred on. Radius set s has its
/// own RLUT column and so weight word s of the radial table's even entries.
oracle::Symbols dots() {
  oracle::Symbols c;
  c.P = 1, c.W = 32, c.H = 32;
  c.pi = 8, c.pf = 1, c.k = 2;
  c.sets = 64, c.columns = 64, c.g = 0;
  c.N = 128, c.wi = 1, c.wf = 2;
  c.cf = 4, c.zf = 0, c.hf = 2;
  c.si = 1, c.sf = 4;
  c.G = 4, c.of = 4;
  c.tf = 4, c.eps = 1;
  c.xi = 1, c.xf = 4;
  return c;
}

class Dots {
 public:
  explicit Dots(const oracle::Symbols& symbols) : c(symbols), w(symbols) {}

  void begin(std::uint32_t tiles, const std::vector<std::uint32_t>& factor) {
    w.begin_frame(65535, 65535, tiles);
    const auto weights = std::uint32_t{1} << (c.wi + c.wf);
    std::vector<std::uint32_t> radial(static_cast<std::size_t>(c.N));
    for (std::uint32_t s = 0; s < weights; ++s) {
      w.load_table(0, s, 1, s, {s, s});
      radial[2 * s] = s;
    }
    w.load_table(1, 0, 0, 0, radial);
    w.load_table(2, 0, 0, 0, factor);
  }
  /// Adds `sums` (sheet words) to pixel (x, y), exactly; needs cf == sf.
  void put(int x, int y, std::array<std::uint32_t, 4> sums) {
    const std::uint32_t most = (1U << c.cf) - 1, one = 1U << c.wf;
    while (sums != std::array<std::uint32_t, 4>{}) {
      std::array<std::uint32_t, 4> part{};
      for (std::size_t i = 0; i < 4; ++i) {
        part[i] = std::min(sums[i], most);
        sums[i] -= part[i];
      }
      w.splat(static_cast<int>(one), 2 * x, 2 * y, part);
    }
  }
  Comparison finish() {
    w.end_frame();
    return compare(run_model(config_of(c, "dots"), w.bytes()), oracle::render(c, w.bytes()));
  }

  oracle::Symbols c;
  StreamWriter w;
};

/// A table that never rises, from 2^of down to about a third, with a step that is not the same everywhere.
std::vector<std::uint32_t> falling(const oracle::Symbols& c, int shape) {
  std::vector<std::uint32_t> words;
  const std::uint32_t top = 1U << c.of;
  for (int j = 0; j <= c.G; ++j) {
    const auto step = static_cast<std::uint32_t>(j), segments = static_cast<std::uint32_t>(c.G);
    if (shape == 0) words.push_back(top * segments / (segments + 2 * step));
    if (shape == 1) words.push_back(j == 0 ? top : 0);
    if (shape == 2) words.push_back(top - top * step / segments);
  }
  return words;
}

void expect_equal(const char* name, const Comparison& comparison, std::uint64_t cases) {
  std::printf("[figure] %s: cases = %llu\n", name, static_cast<unsigned long long>(cases));
  print(name, comparison);
  EXPECT_GT(comparison.total(), 0U) << "nothing was compared";
  EXPECT_EQ(comparison.mismatches, 0U) << comparison.first;
}

// N-3-4, N-3-5.
TEST(Units, SnapEveryPositionAndRadius) {
  Comparison total;
  std::uint64_t cases = 0;
  for (int pf = 0; pf <= 4; ++pf)
    for (int kl = 0; kl <= pf; ++kl)
      for (const int P : {1, 2, 4}) {
        oracle::Symbols c = dots();
        c.P = P, c.W = c.H = 4, c.pi = 4, c.pf = pf, c.k = 1 << kl, c.sets = 1, c.columns = 4, c.N = 2;
        ASSERT_FALSE(cmodel::first_violation(config_of(c, "snap")));
        for (int rho = 1; rho <= c.columns * c.k / 2; ++rho) {
          StreamWriter w(c);
          w.begin_frame(4, 4, 1);
          const auto Ea = cmodel::window_geometry(config_of(c, "snap"), static_cast<std::uint32_t>(rho)).padded;
          w.load_table(0, 0, static_cast<std::uint32_t>(rho), 0,
                       std::vector<std::uint32_t>(Ea * static_cast<std::size_t>(c.k), 0));
          w.load_table(1, 0, 0, 0, {3, 1});
          w.load_table(2, 0, 0, 0, falling(c, 0));
          w.begin_tile(2, 0, 0, 0, 4, 4);
          w.begin_sheet(0);
          const int half = 1 << (c.pi + c.pf - 1);
          for (int x = -half; x < half; ++x, ++cases) w.splat(0, x, -1 - x, {1, 2, 3, 4});
          w.end_sheet();
          w.end_tile();
          w.end_frame();
          total += compare(run_model(config_of(c, "snap"), w.bytes()), oracle::render(c, w.bytes()));
        }
      }
  expect_equal("snap", total, cases);
}

// N-5-2, N-5-3
TEST(Units, AccumulateEveryColourWeightAndSum) {
  Comparison total;
  std::uint64_t cases = 0;
  // Products with fewer, as many, and more fraction bits than the sheet.
  for (const auto& [cf, wf] : {std::pair{2, 1 + 1}, std::pair{2, 3}, std::pair{3, 3}}) {
    oracle::Symbols c = dots();
    c.cf = cf, c.wf = wf;
    Dots dots(c);
    dots.begin(1, falling(c, 0));
    dots.w.begin_tile(2, 0, 0, 0, 32, 32);
    std::uint32_t sheet = 0;
    const std::uint32_t largest = (1U << cf) - 1;
    // Pixel x holds the sum x (in steps of the first product) when the splat under test arrives.
    for (std::uint32_t v = 0; v <= largest; ++v)
      for (int w = 0; w < 1 << (1 + wf); ++w) {
        dots.w.begin_sheet(sheet++);
        for (int x = 0; x < 32; ++x) {
          for (int ulp = 0; ulp < x; ++ulp) dots.w.splat(1 << std::max(0, cf + wf - c.sf), 2 * x, 0, {1, 1, 1, 1});
          dots.w.splat(w, 2 * x, 0, {v, largest - v, v, v});
          ++cases;
        }
        dots.w.end_sheet();
      }
    dots.w.end_tile();
    total += dots.finish();
  }
  expect_equal("accumulate", total, cases);
}

// N-6-2, N-6-3, N-6-5
TEST(Units, SlabEverySumAndTable) {
  Comparison total;
  std::uint64_t cases = 0;
  for (const int G : {1, 4, 32})
    for (const int of : {2, 4, 6})
      for (int shape = 0; shape < 3; ++shape) {
        oracle::Symbols c = dots();
        c.G = G, c.of = of, c.eps = 0;
        Dots dots(c);
        dots.begin(2, falling(c, shape));
        for (std::uint32_t mode = 0; mode < 2; ++mode) {
          dots.w.begin_tile(static_cast<int>(mode), mode, 0, 0, 32, 32);
          dots.w.begin_sheet(0);
          for (std::uint32_t tau = 0; tau < 32; ++tau)
            for (std::uint32_t colour = 0; colour < 32; ++colour, ++cases)
              dots.put(static_cast<int>(tau), static_cast<int>(colour), {colour, 31 - colour, colour ^ tau, tau});
          dots.w.end_sheet();
          dots.w.end_tile();
        }
        total += dots.finish();
      }
  expect_equal("slab", total, cases);
}

// N-6-6, N-6-7
TEST(Units, CompositeEveryTransmittanceColourAndOpacity) {
  Comparison total;
  std::uint64_t cases = 0;
  for (const int eps : {0, 3}) {
    oracle::Symbols c = dots();
    c.eps = eps;
    Dots dots(c);
    constexpr std::uint32_t kPairs = 17 * 17, kTiles = (kPairs + 2) / 3;
    dots.begin(kTiles, falling(c, 0));
    for (std::uint32_t tile = 0; tile < kTiles; ++tile) {
      // Sheet 1 makes the state (C, T) = (c1, 1 - a1); sheet 2 adds (c2, a2): x = a1, y = a2, three (c1, c2) per tile.
      dots.w.begin_tile(1, tile, 0, 0, 17, 17);
      for (std::uint32_t sheet = 0; sheet < 2; ++sheet) {
        dots.w.begin_sheet(sheet);
        for (std::uint32_t x = 0; x < 17; ++x)
          for (std::uint32_t y = 0; y < 17; ++y) {
            std::array<std::uint32_t, 4> sums{0, 0, 0, sheet == 0 ? x : y};
            for (std::uint32_t i = 0; i < 3; ++i) {
              const std::uint32_t pair = std::min(3 * tile + i, kPairs - 1);
              sums[i] = sheet == 0 ? pair % 17 : pair / 17;
            }
            dots.put(static_cast<int>(x), static_cast<int>(y), sums);
            cases += sheet == 1 ? 3 : 0;
          }
        dots.w.end_sheet();
      }
      dots.w.end_tile();
    }
    total += dots.finish();
  }
  expect_equal("composite", total, cases);
}

// N-7-2
TEST(Units, PixelOutEveryWord) {
  Comparison total;
  std::uint64_t cases = 0;
  for (const int f : {4, 6, 7})
    for (const int xf : {4, 5, 6, 9})
      for (const int xi : {0, 1}) {
        oracle::Symbols c = dots();
        c.cf = c.sf = c.tf = f, c.xi = xi, c.xf = xf, c.W = c.H = 16;
        Dots dots(c);
        dots.begin(3, falling(c, 0));
        for (std::uint32_t mode = 0; mode < 3; ++mode) {
          dots.w.begin_tile(static_cast<int>(mode), mode, 0, 0, 16, 16);
          for (std::uint32_t sheet = 0; sheet < 2; ++sheet) {  // two: composited colours above 1.0
            dots.w.begin_sheet(sheet);
            for (std::uint32_t word = 0; word < 2U << f; ++word, ++cases)
              dots.put(static_cast<int>(word % 16), static_cast<int>(word / 16),
                       {word, word / 2, (2U << f) - 1 - word, sheet == 0 ? word / 4 : word});
            dots.w.end_sheet();
          }
          dots.w.end_tile();
        }
        total += dots.finish();
      }
  expect_equal("pixel out", total, cases);
}

}  // namespace
}  // namespace fastsplat::test
