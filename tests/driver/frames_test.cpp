// SPDX-License-Identifier: Apache-2.0
// Whole frames through the device: independence of tiling, threads, sheets and order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "cmodel/model.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/frame_sink.hpp"
#include "driver/tiles/render.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

using scene::Method;

cmodel::Config with_tile(const std::string& name, int width, int height) {
  auto config = load_config(name);
  config.tile_width = width;
  config.tile_height = height;
  return config;
}

TEST(Frames, tiled_equals_untiled_bit_for_bit) {
  for (const Method method : {Method::ImageAligned, Method::AxisAligned, Method::XRay}) {
    for (const auto projection : {scene::Projection::Orthographic, scene::Projection::Perspective}) {
      auto description = view_of("shells:24", 150);
      description.method = method;
      description.camera.projection = projection;
      const auto scene = scene::build_scene(description);
      const auto whole = render(scene, with_tile("base", 152, 152));
      EXPECT_EQ(whole.report.tiles, 1u);
      for (const auto& [width, height] : {std::pair{16, 24}, {64, 64}, {128, 128}, {8, 152}}) {
        const auto tiled = render(scene, with_tile("base", width, height));
        const auto apart = difference(whole.frame, tiled.frame);
        EXPECT_GT(tiled.report.tiles, 1u);
        EXPECT_GT(std::count_if(whole.frame.words.begin(), whole.frame.words.end(), [](auto w) { return w != 0; }),
                  1000);
        EXPECT_EQ(apart.different, 0u) << scene::to_string(method) << " " << width << "x" << height;
        figure(std::string("words compared, ") + scene::to_string(method) + " tile " + std::to_string(width),
               static_cast<double>(apart.compared));
      }
    }
  }
}

TEST(Frames, threads_do_not_matter) {
  const auto scene = scene::build_scene(view_of("marschner-lobb:32", 300));
  const auto config = load_config("base");
  const auto one = render(scene, config, {.threads = 1, .progress = {}});
  for (const int threads : {2, 3, 8}) {
    const auto many = render(scene, config, {.threads = threads, .progress = {}});
    EXPECT_EQ(difference(one.frame, many.frame).different, 0u) << threads;
    EXPECT_TRUE(one.counters == many.counters) << threads;
  }
}

// N-8-110: 0 where the product is kept.
TEST(Frames, xray_in_any_number_of_sheets_is_bit_exact_where_the_product_is_kept) {
  auto description = view_of("shells:24", 96);
  description.method = Method::XRay;
  const auto config = load_config("exact");
  ASSERT_GE(config.sheet_frac_bits, config.colour_frac_bits + config.radial_frac_bits);
  const auto one = render(scene::build_scene(description), config);
  EXPECT_EQ(one.counters.sheet_saturated + one.counters.composite_saturated, 0u);
  for (const int sheets : {2, 3, 7, 32, 100}) {
    description.xray_sheets = sheets;
    const auto many = render(scene::build_scene(description), config);
    const auto apart = difference(one.frame, many.frame);
    EXPECT_EQ(apart.different, 0u) << sheets << " sheets";
    EXPECT_GT(many.report.splat_records, one.report.splat_records);
    figure("exact, words differing in " + std::to_string(sheets) + " sheets of " + std::to_string(apart.compared),
           static_cast<double>(apart.different));
  }
}

/// Counts the products of each pixel, to bound the sum of their rounding errors.
class ProductCount final : public cmodel::TapSink {
 public:
  ProductCount(int width, int height)
      : width_(width), height_(height), count_(static_cast<std::size_t>(width) * height, 0) {}
  void on_tap(const cmodel::TapRecord& record) override {
    if (record.tap != cmodel::Tap::Footprint) return;
    const int lanes = static_cast<int>(std::lround(std::sqrt(static_cast<double>(record.payload.size()))));
    for (int j = 0; j < lanes; ++j) {
      for (int i = 0; i < lanes; ++i) {
        const int x = record.x + i, y = record.y + j;
        if (x < 0 || y < 0 || x >= width_ || y >= height_ ||
            record.payload[static_cast<std::size_t>(j) * lanes + i] == 0)
          continue;
        ++count_[static_cast<std::size_t>(y) * width_ + x];
      }
    }
  }
  std::uint64_t at(std::size_t pixel) const { return count_[pixel]; }

 private:
  int width_, height_;
  std::vector<std::uint64_t> count_;
};

/// One-tile frame with taps, and without an end_frame (S-file-7).
cmodel::Frame tapped(const scene::Scene& scene, const cmodel::Config& config, cmodel::TapSink& taps) {
  const CompiledFrame compiled(scene, config);
  EXPECT_EQ(compiled.grid().count(), 1);
  FrameSink frame(config, compiled.grid().image_width, compiled.grid().image_height);
  cmodel::Model device(config, cmodel::StreamScope::Subset, frame, &taps);
  compiled.emit([&](std::span<const cmodel::Beat> beats) { device.consume(beats); });
  device.finish();
  return frame.take();
}

// N-8-110.
TEST(Frames, xray_sheets_elsewhere_stay_within_half_an_ulp_per_product) {
  auto description = view_of("shells:24", 96);
  description.method = Method::XRay;
  auto config = with_tile("base", 96, 96);
  config.pixel_int_bits = config.sheet_int_bits;  // see the sums themselves
  config.pixel_frac_bits = config.sheet_frac_bits;
  ProductCount one_count(96, 96);
  const auto one = tapped(scene::build_scene(description), config, one_count);
  for (const int sheets : {2, 7, 32}) {
    description.xray_sheets = sheets;
    ProductCount many_count(96, 96);
    const auto many = tapped(scene::build_scene(description), config, many_count);
    double tightest = 0.0;
    for (std::size_t i = 0; i < one.words.size(); ++i) {
      // Each product is rounded once: the errors of whole splats and slices add up to at most half a word each.
      const double bound = 0.5 * static_cast<double>(one_count.at(i / 4) + many_count.at(i / 4));
      const double apart = std::abs(static_cast<double>(one.words[i]) - many.words[i]);
      ASSERT_LE(apart, bound) << "value " << i;
      if (bound > 0) tightest = std::max(tightest, apart / bound);
    }
    const auto apart = difference(one, many);
    EXPECT_GT(apart.different, 0u) << "nothing was rounded: the test proves nothing";
    figure("base, " + std::to_string(sheets) + " sheets: largest difference", apart.largest, "words of 2^-16");
    figure("base, " + std::to_string(sheets) + " sheets: largest share of the bound", tightest);
  }
}

TEST(Frames, order_of_splats_within_a_sheet_does_not_matter) {
  const auto scene = scene::build_scene(view_of("shells:20", 96));
  for (const auto& name : {"base", "tiny", "compact", "year2000"}) {
    const auto config = load_config(name);
    const CompiledFrame compiled(scene, config);
    std::uint64_t splats = 0;
    FrameSink plain(config, 96, 96), shuffled(config, 96, 96);
    std::mt19937 random(20000);
    // S-tile-5: one tile for each device.
    for (int tile = 0; tile < compiled.grid().count(); ++tile) {
      cmodel::Model a(config, cmodel::StreamScope::Subset, plain), b(config, cmodel::StreamScope::Subset, shuffled);
      a.consume(compiled.preamble());
      b.consume(compiled.preamble());
      std::vector<cmodel::Beat> beats;
      compiled.emit_tile(
          tile, [&](std::span<const cmodel::Beat> part) { beats.insert(beats.end(), part.begin(), part.end()); });
      a.consume(beats);
      std::uint32_t tag = 0;
      for (std::size_t i = 0; i < beats.size();) {
        const auto is_splat = [&](std::size_t at) {
          return (beats[at][0] & 0xff) == static_cast<std::uint32_t>(cmodel::Opcode::Splat);
        };
        std::size_t end = i;
        while (end < beats.size() && is_splat(end)) ++end;
        std::shuffle(beats.begin() + static_cast<std::ptrdiff_t>(i), beats.begin() + static_cast<std::ptrdiff_t>(end),
                     random);
        for (; i < end; ++i, ++splats) beats[i][1] = tag++;
        i = end + 1;
      }
      b.consume(beats);
      EXPECT_EQ(a.counters().sheet_saturated > 0, b.counters().sheet_saturated > 0);
    }
    const auto apart = difference(plain.take(), shuffled.take());
    figure(std::string("splats shuffled, ") + name, static_cast<double>(splats));
    ASSERT_GT(splats, 1000u);
    EXPECT_EQ(apart.different, 0u) << name;
  }
}

}  // namespace
}  // namespace fastsplat::driver
