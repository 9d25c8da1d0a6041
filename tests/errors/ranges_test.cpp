// SPDX-License-Identifier: Apache-2.0
// Ranges of whole frames: exact sums, the device's own counters, theory against all values that occur, and formats that
// then saturate nothing.
#include "analysis/errors/ranges.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "driver/tiles/render.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_helper.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::Narrowing;
using cmodel::Overflow;
using cmodel::Rounding;
using cmodel::Site;

scene::Scene scene_of(const std::string& volume, scene::Method method, double opacity_scale = 1.0) {
  scene::SceneDescription description;
  description.volume = volume;
  description.width = description.height = 40;
  description.method = method;
  description.opacity_scale = opacity_scale;
  description.camera.azimuth = 25.0;
  return scene::build_scene(description);
}

TEST(WideSum, CarriesAndBorrows) {
  cmodel::WideSum sum;
  sum.add(-1);
  EXPECT_TRUE(sum.negative());
  sum.add(1);
  EXPECT_EQ(sum, (cmodel::WideSum{0, 0}));
  // (2^43 - 1)^2 = 2^86 - 2^44 + 1, four times.
  for (int i = 0; i < 4; ++i) sum.add_square(-((std::int64_t{1} << 43) - 1));
  EXPECT_EQ(sum.low, std::uint64_t{0} - (std::uint64_t{1} << 46) + 4);
  EXPECT_EQ(sum.high, (std::uint64_t{1} << 24) - 1);
  // (2^32 + 3)^2 = 2^64 + 6 2^32 + 9
  cmodel::WideSum one;
  one.add_square((std::int64_t{1} << 32) + 3);
  EXPECT_EQ(one.high, 1u);
  EXPECT_EQ(one.low, (std::uint64_t{6} << 32) + 9);
}

TEST(Ranges, CountLossesAsByHand) {
  // U 2.4 from 8 fraction bits, half up: 0x34 is 3 and a quarter, 0x38 a tie that goes up, 0x3F8 leaves the format.
  const Narrowing narrowing(Rounding::RND, Overflow::SAT, 8, cmodel::unsigned_format(2, 4));
  cmodel::Ranges a, b;
  const auto see = [&](cmodel::Ranges& ranges, std::int64_t value) {
    ranges(Site::Product, narrowing, value, narrowing(value));
  };
  for (const std::int64_t value : {0, 0x34, 0x3F8}) see(a, value);
  see(b, 0x38);
  a += b;
  const cmodel::Range& range = a.at(Site::Product);
  EXPECT_EQ(range.count, 4u);
  EXPECT_EQ(range.overflow, 1u);
  EXPECT_EQ(range.error, (cmodel::WideSum{4, 0})) << "-4 and +8 sixteenths of a word; what was cut counts elsewhere";
  EXPECT_EQ(range.error_squares, (cmodel::WideSum{16 + 64, 0}));
  EXPECT_EQ(range.leading[0], 1u);
  EXPECT_EQ(range.leading[6], 2u);
  EXPECT_EQ(range.leading[10], 1u);
  EXPECT_EQ(range.idle_tail(narrowing), 0);
  cmodel::Ranges even;
  for (const std::int64_t value : {0x40, 0xC0}) see(even, value);  // words 4 and 12
  EXPECT_EQ(even.at(Site::Product).idle_tail(narrowing), 2);
}

TEST(Ranges, TheoryIsTheMeanOverAllLostBits) {
  int compared = 0;
  for (const Rounding rounding : {Rounding::TRN, Rounding::RND, Rounding::RND_CONV}) {
    for (int dropped = 0; dropped <= 10; ++dropped, ++compared) {
      const Narrowing narrowing(rounding, Overflow::SAT, 4 + dropped, cmodel::unsigned_format(4, 4));
      const std::int64_t all = std::int64_t{2} << dropped;  // over an even word and an odd one
      double sum = 0.0, squares = 0.0;
      for (std::int64_t value = 0; value < all; ++value) {
        const double error =
            static_cast<double>(narrowing(value).word) - std::ldexp(static_cast<double>(value), -dropped);
        sum += error;
        squares += error * error;
      }
      const Lost lost = uniform_loss(rounding, dropped);
      EXPECT_NEAR(lost.mean, sum / static_cast<double>(all), 1e-12) << static_cast<int>(rounding) << ", " << dropped;
      EXPECT_NEAR(lost.rms, std::sqrt(squares / static_cast<double>(all)), 1e-12);
    }
  }
  std::printf("[figure] roundings and widths compared with every value = %d\n", compared);
  // The limit of many bits: an ulp over sqrt(12), about the mean.
  EXPECT_NEAR(uniform_loss(Rounding::RND, 16).rms, 1.0 / std::sqrt(12.0), 1e-5);
  EXPECT_NEAR(uniform_loss(Rounding::TRN, 16).mean, -0.5, 1e-5);
}

TEST(Ranges, OfAFrameSaturateAsOftenAsTheDeviceCounts) {
  std::uint64_t frames = 0, saturated = 0, counted = 0;
  test::Random random(71);
  std::vector<cmodel::Config> configs;
  for (const std::string& name : test::config_names()) configs.push_back(test::named_config(name));
  configs.push_back(test::named_config("tiny"));
  configs.back().sheet_int_bits = 1;
  configs.back().pixel_int_bits = 0;
  for (int n = 0; n < 6; ++n) configs.push_back(test::random_config(random));
  for (const auto method : {scene::Method::ImageAligned, scene::Method::AxisAligned, scene::Method::XRay}) {
    // Thirty times as opaque: sums saturate.
    for (const double opacity : {1.0, 30.0}) {
      const scene::Scene scene = scene_of("shells:20", method, opacity);
      for (const cmodel::Config& config : configs) {
        driver::DeviceRender rendered;
        try {
          rendered = driver::render(scene, config);
        } catch (const UserError&) {
          continue;  // a random device too small for the scene
        }
        const auto ranges = driver::frame_ranges(scene, config, {.threads = 2, .progress = {}});
        ASSERT_EQ(ranges.counters, rendered.counters) << config.name;
        EXPECT_EQ(ranges.report.vanished_voxels, rendered.report.vanished_voxels);
        EXPECT_EQ(ranges.report.splat_records, rendered.report.splat_records);
        cmodel::Counters sums;
        for (std::size_t i = 0; i < cmodel::kSiteCount; ++i) {
          const std::uint64_t overflow = ranges.ranges.at(static_cast<Site>(i)).overflow;
          if (const auto counts = cmodel::kSiteFacts[i].counts) {
            sums.*counts += overflow;
          } else {
            EXPECT_EQ(overflow, 0u) << cmodel::kSiteFacts[i].name;
          }
          saturated += overflow;
        }
        for (const auto& facts : cmodel::kSiteFacts) {
          if (facts.counts == nullptr) continue;
          EXPECT_EQ(sums.*facts.counts, rendered.counters.*facts.counts) << config.name << ", " << facts.name;
          ++counted;
        }
        ++frames;
      }
    }
  }
  std::printf("[figure] frames = %llu, counters compared = %llu, values saturated = %llu\n",
              static_cast<unsigned long long>(frames), static_cast<unsigned long long>(counted),
              static_cast<unsigned long long>(saturated));
  EXPECT_GE(frames, 48u);
  EXPECT_GT(saturated, 0u);
}

TEST(Ranges, ThreadsDoNotMatterAndScenesAdd) {
  cmodel::Config config = test::named_config("tiny");
  config.tile_width = config.tile_height = 16;
  const scene::Scene shells = scene_of("shells:20", scene::Method::ImageAligned),
                     rays = scene_of("shells:16", scene::Method::XRay);
  const auto one = driver::frame_ranges(shells, config, {.threads = 1, .progress = {}});
  for (const int threads : {2, 5})
    EXPECT_EQ(driver::frame_ranges(shells, config, {.threads = threads, .progress = {}}).ranges, one.ranges);
  const auto other = driver::frame_ranges(rays, config);
  cmodel::Ranges both = one.ranges;
  both += other.ranges;
  EXPECT_EQ(both.at(Site::Sum).count, one.ranges.at(Site::Sum).count + other.ranges.at(Site::Sum).count);
  EXPECT_EQ(both.at(Site::SumOver), other.ranges.at(Site::SumOver));
  EXPECT_EQ(both.at(Site::Light), one.ranges.at(Site::Light));
}

/// A saturating format, widened as reported, no longer saturates; with one bit less it does.
TEST(Ranges, ReportedFormatsSaturateNothingAndAreNotTooWide) {
  int frames = 0;
  for (const char* name : {"tiny", "small", "base"}) {
    for (const auto method : {scene::Method::ImageAligned, scene::Method::XRay}) {
      cmodel::Config config = test::named_config(name);
      config.sheet_int_bits = 1;
      config.pixel_int_bits = 0;
      scene::Scene scene = scene_of("shells:20", method, 40.0);
      if (method == scene::Method::XRay) scene.xray_scale *= 3.0;
      const auto narrow = driver::frame_ranges(scene, config);
      ASSERT_TRUE(cut(narrow.ranges)) << name;
      const auto wide = driver::frame_ranges(scene, roomy(config));
      cmodel::Config widened = config;
      for (const Need& need : ranges_report(config, narrow.ranges, wide.ranges).needs) {
        const std::string key = need.key;
        if (key == "sheet.int_bits") widened.sheet_int_bits = need.needs;
        if (key == "pixel.int_bits") widened.pixel_int_bits = need.needs;
      }
      const auto saturated = [&](const cmodel::Config& c) {
        const auto counters = driver::render(scene, c).counters;
        return counters.product_saturated + counters.sheet_saturated + counters.pixel_saturated +
               (method == scene::Method::XRay ? counters.composite_saturated : 0);
      };
      EXPECT_EQ(saturated(widened), 0u) << name;
      std::printf("[figure] %s, %s: sheet.int_bits 1 -> %d, pixel.int_bits 0 -> %d saturate nothing\n", name,
                  scene::to_string(method), widened.sheet_int_bits, widened.pixel_int_bits);
      if (widened.sheet_int_bits > 1) {
        cmodel::Config less = widened;
        --less.sheet_int_bits;
        EXPECT_GT(saturated(less), 0u) << name;
      }
      // If sheets were cut, a slab's factor with room has another range and other words: output words may then differ
      // by their last bit, and the reported need is a bound.
      const bool bound = method != scene::Method::XRay && narrow.counters.sheet_saturated > 0;
      if (widened.pixel_int_bits > 0 && !bound) {
        cmodel::Config less = widened;
        --less.pixel_int_bits;
        EXPECT_GT(saturated(less), 0u) << name;
      }
      ++frames;
    }
  }
  EXPECT_EQ(frames, 6);
}

}  // namespace
}  // namespace fastsplat::analysis
