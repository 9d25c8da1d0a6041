// SPDX-License-Identifier: Apache-2.0
// The narrowing sites and their observers: the table against the page's formats, ranges by hand and on random frames.
#include "cmodel/numbers/sites.hpp"

#include <gtest/gtest.h>

#include "cmodel/model.hpp"
#include "tests/cmodel/compare_helper.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

using cmodel::Site;

/// The formats of each site in docs/numerics.md, sections 3 to 7.
struct Row {
  Site site;
  oracle::Rounding rounding;
  int from_f;
  oracle::Words words;
};
std::vector<Row> page(const oracle::Symbols& c) {
  using oracle::one, oracle::u;
  const oracle::Words colour = c.ci == 0 ? one(c.tf) : u(c.ci, c.tf);
  const int b = c.si + c.sf - oracle::log2_of(c.G);
  return {{Site::Snap, c.Rs, c.pf, oracle::s(c.pi, oracle::log2_of(c.K()))},
          {Site::AxisProduct, oracle::Rounding::Rnd, 2 * (c.wf + c.g), u(c.wi, c.wf)},
          {Site::RadialFall, oracle::Rounding::Rnd, c.wf + c.g, oracle::s(c.wi + 1, c.wf)},
          {Site::Product, c.Rp, c.cf + c.wf, u(c.si, c.sf)},
          {Site::Sum, oracle::Rounding::Trn, c.sf, u(c.si, c.sf)},
          {Site::Fall, c.Rf, c.of + b, one(c.of)},
          {Site::SlabColour, c.Ra, c.sf + c.of, colour},
          {Site::SlabOpacity, c.Ra, c.sf + c.of, one(c.tf)},
          {Site::AddedColour, c.Ra, c.sf, colour},
          {Site::AddedOpacity, c.Ra, c.sf, one(c.tf)},
          {Site::Light, c.Rl, 2 * c.tf, colour},
          {Site::Over, oracle::Rounding::Trn, c.tf, u(1 + c.ci, c.tf)},
          {Site::Absorbed, c.Rl, 2 * c.tf, one(c.tf)},
          {Site::SumOver, oracle::Rounding::Trn, c.sf, u(c.si, c.sf)},
          {Site::PixelOut, c.Ro, c.tf, u(c.xi, c.xf)},
          {Site::PixelSum, c.Ro, c.sf, u(c.xi, c.xf)}};
}

TEST(Sites, TableNarrowsAsThePageDoes) {
  Random random(seed_or(21));
  std::uint64_t compared = 0;
  for (int n = 0; n < 200; ++n) {
    const cmodel::Config config = random_config(random);
    const cmodel::Sites sites(config);
    const auto rows = page(symbols_of(config));
    ASSERT_EQ(rows.size(), cmodel::kSiteCount);
    for (const Row& row : rows) {
      const cmodel::Narrowing& site = sites[row.site];
      ASSERT_EQ(site.from_frac(), row.from_f) << cmodel::facts(row.site).name;
      for (int i = 0; i < 50; ++i, ++compared) {
        // Values around the ends and the ties of the format, and arbitrary ones.
        const int drop = std::max(0, row.from_f - row.words.f);
        const auto largest = static_cast<std::int64_t>(row.words.largest);
        std::int64_t value = random.between(-4, largest + 4) >> random.between(0, 24);
        value = value * (std::int64_t{1} << drop) + random.one_of({0, 1, (std::int64_t{1} << drop) / 2});
        const auto want = oracle::narrow(row.rounding, oracle::Overflow::Sat, value, row.from_f, row.words);
        const auto got = site(value);
        ASSERT_TRUE(got.word == want.word && got.overflow == want.overflow && got.inexact == want.inexact)
            << cmodel::facts(row.site).name << ", value " << value << ": " << got.word;
      }
    }
  }
  std::printf("[figure] values narrowed at the sites of 200 configurations = %llu, mismatches = 0 (limit 0)\n",
              static_cast<unsigned long long>(compared));
  EXPECT_GT(compared, 0U);
}

TEST(Ranges, ByHand) {
  // U 2.4 from 8 fraction bits: 4 are dropped.
  const cmodel::Narrowing narrowing(cmodel::Rounding::RND, cmodel::Overflow::SAT, 8, cmodel::unsigned_format(2, 4));
  cmodel::Ranges ranges;
  const auto see = [&](std::int64_t value) { ranges(Site::Product, narrowing, value, narrowing(value)); };
  const cmodel::Range& range = ranges.at(Site::Product);
  EXPECT_EQ(range.count, 0U);
  see(0x30);  // word 3
  see(0x34);  // bit 2 of 4 is lost: two fraction bits more would have kept it
  EXPECT_EQ(range.count, 2U);
  EXPECT_EQ(range.inexact, 1U);
  EXPECT_EQ(range.overflow, 0U);
  EXPECT_EQ(range.least, 0x30);
  EXPECT_EQ(range.greatest, 0x34);
  EXPECT_EQ(range.missing_bits(narrowing), 2);
  EXPECT_EQ(range.headroom(narrowing), 4) << "word 3 needs 2 of 6 bits";
  see(0x3F8);  // 63.5: rounds up to 64, one bit too wide
  EXPECT_EQ(range.overflow, 1U);
  EXPECT_EQ(range.headroom(narrowing), -1);
  see(1);
  EXPECT_EQ(range.missing_bits(narrowing), 4);

  const cmodel::Narrowing both_signs(cmodel::Rounding::TRN, cmodel::Overflow::SAT, 0, cmodel::signed_format(8, 0));
  for (const std::int64_t value : {-16, 15}) ranges(Site::Snap, both_signs, value, both_signs(value));
  EXPECT_EQ(ranges.at(Site::Snap).headroom(both_signs), 3) << "-16..15 are 4 bits and a sign of 7";
  EXPECT_EQ(ranges.at(Site::Sum).count, 0U);
}

std::uint64_t seen(const cmodel::Ranges& ranges, std::initializer_list<Site> sites) {
  std::uint64_t sum = 0;
  for (const Site site : sites) sum += ranges.at(site).count;
  return sum;
}

TEST(Ranges, OfRandomFramesAgreeWithTheCountersAndChangeNothing) {
  Random random(seed_or(22));
  std::uint64_t values = 0, overflows = 0, dropping = 0;
  for (int n = 0; n < 60; ++n) {
    const cmodel::Config config = random_config(random);
    const auto beats = to_beats(random_stream(symbols_of(config), random, 40).bytes);
    Collector with, without;
    cmodel::Ranges ranges;
    cmodel::Model watched(config, cmodel::StreamScope::Whole, with, nullptr, &ranges);
    cmodel::Model plain(config, cmodel::StreamScope::Whole, without);
    for (cmodel::Model* model : {&watched, &plain}) model->consume(beats), model->finish();
    const Comparison same = compare(with.rendering, without.rendering);
    ASSERT_EQ(same.mismatches, 0U) << same.first;
    ASSERT_GT(same.total(), 0U);
    const cmodel::Counters& counters = watched.counters();
    ASSERT_EQ(counters, plain.counters());

    cmodel::Counters counted;
    for (std::size_t i = 0; i < cmodel::kSiteCount; ++i) {
      const cmodel::Range& range = ranges.at(static_cast<Site>(i));
      const cmodel::Narrowing site = cmodel::narrowing(config, static_cast<Site>(i));
      values += range.count;
      overflows += range.overflow;
      if (const auto counts = cmodel::kSiteFacts[i].counts) counted.*counts += range.overflow;
      EXPECT_TRUE(cmodel::kSiteFacts[i].counts != nullptr || range.overflow == 0) << cmodel::kSiteFacts[i].name;
      if (range.count == 0) continue;
      EXPECT_LE(range.least, range.greatest);
      EXPECT_EQ(range.missing_bits(site) > 0, range.inexact > 0) << cmodel::kSiteFacts[i].name;
      EXPECT_LE(range.missing_bits(site), site.dropped_bits());
      // For overflow the end of the range is sufficient.
      EXPECT_EQ(site(range.greatest).overflow || site(range.least).overflow, range.overflow > 0);
      dropping += range.inexact > 0 ? 1 : 0;
    }
    EXPECT_EQ(counted.snap_saturated, counters.snap_saturated);
    EXPECT_EQ(counted.product_saturated, counters.product_saturated);
    EXPECT_EQ(counted.sheet_saturated, counters.sheet_saturated);
    EXPECT_EQ(counted.opacity_saturated, counters.opacity_saturated);
    EXPECT_EQ(counted.composite_saturated, counters.composite_saturated);
    EXPECT_EQ(counted.pixel_saturated, counters.pixel_saturated);
    EXPECT_EQ(seen(ranges, {Site::Snap}), 2 * counters.splats);
    EXPECT_EQ(seen(ranges, {Site::Product}), 4 * counters.lanes_weighted);
    // Samples composited at once are not summed.
    if (config.composite_every_sample != 0) {
      EXPECT_LE(seen(ranges, {Site::Sum}), 4 * counters.lanes_weighted);
    } else {
      EXPECT_EQ(seen(ranges, {Site::Sum}), 4 * counters.lanes_weighted);
    }
    EXPECT_EQ(seen(ranges, {Site::SlabColour, Site::SlabOpacity, Site::AddedColour, Site::AddedOpacity, Site::SumOver}),
              4 * counters.pixels_composited);
  }
  std::printf("[figure] values watched = %llu, out of range = %llu, sites that lost bits = %llu\n",
              static_cast<unsigned long long>(values), static_cast<unsigned long long>(overflows),
              static_cast<unsigned long long>(dropping));
  EXPECT_GT(values, 0U);
  EXPECT_GT(overflows, 0U);
  EXPECT_GT(dropping, 0U);
}

}  // namespace
}  // namespace fastsplat::test
