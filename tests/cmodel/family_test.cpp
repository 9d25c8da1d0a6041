// SPDX-License-Identifier: Apache-2.0
// Every kind of index: the model against the oracle on random streams, the inner steps by hand, and frames without
// tiles.
#include <gtest/gtest.h>

#include "cmodel/decode/stream_decode.hpp"
#include "cmodel/numbers/index_set.hpp"
#include "cmodel/numbers/integer_sqrt.hpp"
#include "cmodel/splat/blit_unit.hpp"
#include "cmodel/splat/quadric.hpp"
#include "cmodel/splat/weight_unit.hpp"
#include "tests/cmodel/campaign_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/cmodel/verdict_helper.hpp"

namespace fastsplat::test {
namespace {

using cmodel::IndexKind;

constexpr IndexKind kKinds[] = {IndexKind::Linear, IndexKind::Squared, IndexKind::SquaredElliptic,
                                IndexKind::Blit2d, IndexKind::Rlut,    IndexKind::Separable};

class Family : public ::testing::TestWithParam<IndexKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, Family, ::testing::ValuesIn(kKinds),
                         [](const auto& param_info) { return name_of(param_info.param); });

TEST_P(Family, ModelEqualsOracleOnRandomConfigurations) {
  Random random(seed_or(61));
  Campaign total;
  int configs = 0;
  for (; configs < 40 && total.comparison.mismatches == 0; ++configs) {
    const Campaign result = compare_streams(random_config(random, GetParam()), random, 200, 200);
    total.comparison += result.comparison;
    total.splats += result.splats;
  }
  print(name_of(GetParam()).c_str(), total.comparison);
  std::printf("[figure] %s: configurations = %d, splats = %llu, words compared = %llu, different = %llu\n",
              name_of(GetParam()).c_str(), configs, static_cast<unsigned long long>(total.splats),
              static_cast<unsigned long long>(total.comparison.total()),
              static_cast<unsigned long long>(total.comparison.mismatches));
  EXPECT_EQ(total.comparison.mismatches, 0U) << total.comparison.first;
  EXPECT_GT(total.comparison.total(), 100000U);
}

// k 4..64, N 64..2048 and all roundings of the snap, on the named configurations' other numbers.
TEST_P(Family, ModelEqualsOracleOverPhasesEntriesAndRoundings) {
  Random random(seed_or(62));
  Comparison total;
  std::uint64_t configs = 0;
  for (const int k : {4, 8, 16, 32, 64})
    for (const int entries : {64, 256, 2048})
      for (const int rounding : {0, 1, 2}) {
        cmodel::Config config = named_config("small");
        config.position_frac_bits = 6;
        config.phases = k;
        config.radial_entries = entries;
        config.rounding_snap = rounding;
        config.index_kind = static_cast<int>(GetParam());
        // Sides of up to two windows.
        config.rlut_columns = 2 * config.lanes;
        if (GetParam() == IndexKind::Blit2d) config.index_symmetry = static_cast<int>(configs % 2);
        if (GetParam() == IndexKind::Blit2d && k == 64) config.rlut_columns = config.lanes;
        ASSERT_FALSE(cmodel::first_violation(config)) << one_line(*cmodel::first_violation(config));
        total += compare_streams(config, random, 60, 60).comparison;
        ++configs;
      }
  std::printf("[figure] %s: configurations = %llu, words compared = %llu, different = %llu\n",
              name_of(GetParam()).c_str(), static_cast<unsigned long long>(configs),
              static_cast<unsigned long long>(total.total()), static_cast<unsigned long long>(total.mismatches));
  EXPECT_EQ(total.mismatches, 0U) << total.first;
  EXPECT_EQ(configs, 45U);
}

// Interpolated tables (N-4.7-1, N-4.7-2, N-4.7-3) with random words: few and many entries, every value of g, with
// ellipses.
TEST(Interpolated, ModelEqualsOracleOverEntriesAndGuardBits) {
  Random random(seed_or(65));
  Campaign total;
  std::uint64_t configs = 0;
  for (const IndexKind kind : {IndexKind::Rlut, IndexKind::Squared, IndexKind::SquaredElliptic})
    for (const int entries : {2, 64, 256})
      for (const int guard : {1, 6, 12})
        for (const int ellipses : {0, 7}) {
          cmodel::Config config = named_config("small");
          config.radial_entries = entries;
          config.rlut_guard_bits = guard;
          config.radial_interpolate = 1;
          config.index_kind = static_cast<int>(kind);
          config.ellipse_frac_bits = ellipses;
          config.rlut_columns = 2 * config.lanes;
          ASSERT_FALSE(cmodel::first_violation(config)) << one_line(*cmodel::first_violation(config));
          total += compare_streams(config, random, 60, 60);
          ++configs;
        }
  std::printf("[figure] interpolated: configurations = %llu, splats = %llu, words compared = %llu, different = %llu\n",
              static_cast<unsigned long long>(configs), static_cast<unsigned long long>(total.splats),
              static_cast<unsigned long long>(total.comparison.total()),
              static_cast<unsigned long long>(total.comparison.mismatches));
  EXPECT_EQ(total.comparison.mismatches, 0U) << total.comparison.first;
  EXPECT_EQ(configs, 54U);
  EXPECT_GT(total.ellipses.weighted, 1000U);
}

// N-4.1-2: s.
TEST(FamilySteps, TheRootIsTheLargestWhoseSquareFits) {
  std::uint64_t checked = 0;
  const auto check = [&](std::uint64_t v) {
    const std::uint64_t s = cmodel::integer_sqrt(v);
    __extension__ typedef unsigned __int128 Wide;
    ASSERT_LE(Wide{s} * s, v) << v;
    ASSERT_GT((Wide{s} + 1) * (s + 1), v) << v;
    ++checked;
  };
  for (std::uint64_t v = 0; v < 70000; ++v) check(v);
  for (int bits = 1; bits <= 32; ++bits) {
    const std::uint64_t s = (std::uint64_t{1} << bits) - 1;
    for (const std::uint64_t v : {s * s - 1, s * s, s * s + 1, s * s + 2 * s, s * s + 2 * s + 1}) check(v);
  }
  check(~std::uint64_t{0});
  Random random(seed_or(63));
  for (int i = 0; i < 100000; ++i) check(random.next() >> random.between(0, 63));
  // Words on both sides of a square: a root that is off by one shows.
  for (int i = 0; i < 100000; ++i) {
    const std::uint64_t s = (random.next() >> 32 >> random.between(0, 30)) + 1;
    for (const std::uint64_t v : {s * s - 1, s * s, s * s + 2 * s}) check(v);
  }
  std::printf("[figure] roots checked = %llu\n", static_cast<unsigned long long>(checked));
}

// Additions alone give the q of the formula (N-4.2-3, N-4.3-4), at both ends of the widths of a configuration.
TEST(FamilySteps, ForwardDifferencesAreExact) {
  Random random(seed_or(64));
  std::uint64_t compared = 0;
  for (int n = 0; n < 400; ++n) {
    cmodel::Config config = named_config("base");
    config.lanes = 1 << random.between(0, 4);
    config.position_frac_bits = static_cast<int>(random.between(0, 7));
    config.phases = 1;
    config.rlut_columns = 1024;
    config.index_kind = static_cast<int>(IndexKind::SquaredElliptic);
    ASSERT_FALSE(cmodel::first_violation(config)) << one_line(*cmodel::first_violation(config));
    const std::int64_t most = cmodel::kLargestScale, K = config.grid(), P = config.lanes;
    cmodel::Quadric f{.a = random.between(0, most), .b = 0, .c = random.between(0, most), .shift = 0};
    if (n % 4 == 0) f.a = f.c = most;
    f.b = n % 4 == 0 ? random.one_of({-2 * most, 2 * most}) : 0;
    if (n % 4 != 0) {
      do f.b = random.between(-2 * most, 2 * most);
      while (f.b * f.b > 4 * f.a * f.c);
    }
    const std::int64_t reach = config.rlut_columns * K;
    const std::int64_t dx = n % 2 == 0 ? -reach : random.between(-reach, reach - 2 * P * K);
    const std::int64_t dy = n % 3 == 0 ? -reach : random.between(-reach, reach - P * K);
    cmodel::QuadricScan scan(config);
    scan.begin(f, dx, dy);
    for (std::int64_t window = 0; window < 2; ++window) {
      std::size_t lane = 0;
      for (std::int64_t j = 0; j < P; ++j)
        for (std::int64_t i = 0; i < P; ++i, ++lane, ++compared) {
          const oracle::Wide x = dx + (window * P + i) * K, y = dy + j * K;
          const oracle::Wide q = f.a * x * x + f.b * x * y + f.c * y * y;
          ASSERT_TRUE(q == scan.values()[lane]) << "window " << window << ", lane " << lane;
          ASSERT_GE(scan.values()[lane], 0);
        }
      scan.next();
    }
  }
  std::printf("[figure] q compared = %llu, different = 0\n", static_cast<unsigned long long>(compared));
}

// A weight has no history: windows in any order give the weights of scan-line order.
TEST(FamilySteps, WindowsInAnyOrderAreTheSame) {
  Random random(seed_or(65));
  std::uint64_t compared = 0;
  for (const IndexKind kind : kKinds) {
    cmodel::Config config = named_config("small");
    config.index_kind = static_cast<int>(kind);
    config.phases = 8;
    config.rlut_columns = 4 * config.lanes;
    const auto rho = static_cast<std::uint32_t>(config.rlut_columns * config.grid() / 2);
    cmodel::LoadTable table{.table = cmodel::Table::Rlut, .radius = {.set = 0, .rho = rho, .base = 0}, .words = {}};
    for (std::int64_t i = 0; i < cmodel::set_words(config, rho); ++i)
      table.words.push_back(static_cast<std::uint32_t>(
          random.between(0, cmodel::set_word_range(config, static_cast<std::size_t>(i)).most)));
    if (table.words.size() <= 4) table.words.back() = 30;
    if (kind == IndexKind::SquaredElliptic) table.words = {9000000, static_cast<std::uint32_t>(-5000000), 7000000, 30};
    cmodel::WeightUnit unit = cmodel::weight_unit(config);
    std::visit(
        [&](auto& u) {
          cmodel::Nothing nobody;
          std::vector<std::uint32_t> radial(static_cast<std::size_t>(config.radial_entries));
          for (std::size_t t = 0; t < radial.size(); ++t) radial[t] = static_cast<std::uint32_t>(radial.size() - t);
          u.load_radial(radial);
          u.load(table);
          const auto P = static_cast<std::uint32_t>(config.lanes), Ea = u.extent(0);
          const cmodel::SnappedAxis x{.origin = 0, .phase = 3}, y{.origin = 0, .phase = 5};
          std::vector<std::uint32_t> there(P * P), back(P * P);
          std::vector<std::vector<std::uint32_t>> diagonal;
          for (std::uint32_t row = 0; row < Ea; row += P) {
            u.place(0, x, y);
            std::vector<std::vector<std::uint32_t>> line;
            for (std::uint32_t column = 0; column < Ea; column += P) {
              u.window(column, row, there, nobody);
              line.push_back(there);
            }
            for (std::uint32_t column = Ea; column > 0; column -= P) {
              u.window(column - P, row, back, nobody);
              EXPECT_EQ(back, line[(column - P) / P]) << name_of(kind) << ", row " << row << ", column " << column;
              compared += back.size();
            }
            diagonal.push_back(line[row / P]);
          }
          u.place(0, x, y);
          for (std::uint32_t at = 0; at < Ea; at += P) {
            u.window(at, at, back, nobody);
            EXPECT_EQ(back, diagonal[at / P]) << name_of(kind) << ", on the diagonal, " << at;
            compared += back.size();
          }
        },
        unit);
  }
  std::printf("[figure] weights compared = %llu\n", static_cast<unsigned long long>(compared));
  EXPECT_GT(compared, 1000U);
}

// Eight images of a footprint are one: every pair of phases of a symmetric table is read back (N-4.4-3, N-4.4-4,
// N-4.4-5).
TEST(FamilySteps, EightfoldSymmetryReadsTheSameWeights) {
  std::uint64_t compared = 0, whole = 0, stored = 0;
  for (const int k : {1, 2, 4, 8, 16})
    for (std::uint32_t rho = 1; rho <= 5u * static_cast<std::uint32_t>(k); rho += k < 8 ? 1 : 3) {
      cmodel::Config all = named_config("small");
      all.index_kind = static_cast<int>(IndexKind::Blit2d);
      all.phases = k;
      all.rlut_columns = 4 * all.lanes;
      cmodel::Config once = all;
      once.index_symmetry = static_cast<int>(cmodel::IndexSymmetry::Eightfold);
      const auto Ea = static_cast<std::int64_t>(cmodel::window_geometry(all, rho).padded), r = std::int64_t{rho};
      const auto weight = [&](std::int64_t m, std::int64_t n, std::int64_t i, std::int64_t j) {
        const std::int64_t dx = (i + 1) * k - m - r, dy = (j + 1) * k - n - r;
        return static_cast<std::uint32_t>(std::max<std::int64_t>(0, r * r - dx * dx - dy * dy));
      };
      const auto image = [&](std::int64_t m) { return ((-m - 2 * r) % k + k) % k; };
      cmodel::LoadTable every{.table = cmodel::Table::Rlut, .radius = {.set = 0, .rho = rho, .base = 0}, .words = {}};
      cmodel::LoadTable some = every;
      for (std::int64_t n = 0; n < k; ++n)
        for (std::int64_t m = 0; m < k; ++m)
          for (std::int64_t j = 0; j < Ea; ++j)
            for (std::int64_t i = 0; i < Ea; ++i) {
              every.words.push_back(weight(m, n, i, j));
              if (m <= n && m <= image(m) && n <= image(n)) some.words.push_back(weight(m, n, i, j));
            }
      ASSERT_EQ(static_cast<std::int64_t>(every.words.size()), cmodel::set_words(all, rho));
      ASSERT_EQ(static_cast<std::int64_t>(some.words.size()), cmodel::set_words(once, rho));
      whole += every.words.size();
      stored += some.words.size();
      cmodel::BlitUnit a(all), b(once);
      a.load(every);
      b.load(some);
      cmodel::Nothing nobody;
      const auto P = static_cast<std::uint32_t>(all.lanes);
      std::vector<std::uint32_t> x(P * P), y(P * P);
      for (std::uint32_t n = 0; n < static_cast<std::uint32_t>(k); ++n)
        for (std::uint32_t m = 0; m < static_cast<std::uint32_t>(k); ++m) {
          a.place(0, {0, m}, {0, n});
          b.place(0, {0, m}, {0, n});
          for (std::uint32_t row = 0; row < Ea; row += P)
            for (std::uint32_t column = 0; column < Ea; column += P) {
              a.window(column, row, x, nobody);
              b.window(column, row, y, nobody);
              ASSERT_EQ(x, y) << "k " << k << ", rho " << rho << ", phases " << m << ' ' << n;
              compared += x.size();
            }
        }
    }
  std::printf("[figure] weights compared = %llu, words stored %llu of %llu\n",
              static_cast<unsigned long long>(compared), static_cast<unsigned long long>(stored),
              static_cast<unsigned long long>(whole));
  EXPECT_GT(compared, 100000U);
}

// N-4.3-1, N-4.3-2.
// S-table-5, S-table-4.
TEST(FamilyStream, InvalidEllipsesAreRefused) {
  cmodel::Config config = named_config("small");
  config.index_kind = static_cast<int>(IndexKind::SquaredElliptic);
  const auto line = [&](std::vector<std::uint32_t> words, std::uint32_t base = 0) -> std::string {
    StreamWriter w(symbols_of(config));
    w.begin_frame(4, 4, 0);
    w.load_table(0, 0, 20, base, words);
    try {
      cmodel::StreamDecode decode(config, cmodel::StreamScope::Subset);
      for (const auto& beat : to_beats(w.bytes())) decode.feed(beat);
      return "";
    } catch (const UserError& error) {
      return error.what();
    }
  };
  const auto negative = [](std::int32_t b) { return static_cast<std::uint32_t>(b); };
  EXPECT_EQ(line({100, negative(-200), 100, 4}), "");
  EXPECT_EQ(line({100, 200, 100, 4}), "");
  const struct {
    std::vector<std::uint32_t> words;
    const char* said;
  } wrong[] = {{{100, 201, 100, 4}, "4 A C >= B^2 = 40401"},
               {{100, negative(-201), 100, 4}, "got 40000"},
               {{(1U << 24) + 1, 0, 100, 4}, "16777216"},
               {{100, negative(-(1 << 25) - 1), 100, 4}, "-33554432..33554432"},
               {{100, 0, 100, 63}, "62"},
               {{100, 0, 100}, "wrong number of table words"}};
  int refused = 0;
  for (const auto& [words, said] : wrong) {
    EXPECT_NE(line(words).find(said), std::string::npos) << said << " is not in: " << line(words);
    EXPECT_EQ(line(words).find('\n'), std::string::npos);
    ++refused;
  }
  EXPECT_NE(
      line({100, 0, 100, 4}, static_cast<std::uint32_t>(config.lanes)).find("base given for a set without columns"),
      std::string::npos);
  std::printf("[figure] sets refused = %d\n", refused + 1);
}

}  // namespace
}  // namespace fastsplat::test
