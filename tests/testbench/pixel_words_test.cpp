// SPDX-License-Identifier: Apache-2.0
// A pixel's words out of a stream: its output is the picture's, its products add up to its sums, in every mode.
#include "testbench/triage/pixel_words.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "base/error.hpp"
#include "driver/tiles/render.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/testbench/scene_beats_helper.hpp"

namespace fastsplat::testbench {
namespace {

struct Way {
  const char* config;
  scene::Method method;
  scene::SlabOpacity opacity;
};

BeatSource source_of(const std::vector<cmodel::Beat>& beats) {
  return [&beats](const cmodel::BeatSink& sink) { sink(beats); };
}

TEST(PixelWords, AreThoseOfThePictureAndAddUp) {
  using enum scene::Method;
  using enum scene::SlabOpacity;
  std::size_t pixels = 0, different = 0, sums = 0, wrong = 0, saturated = 0, splats = 0;
  for (const Way& way :
       {Way{"tiny", ImageAligned, Exponential}, Way{"tiny", AxisAligned, Additive}, Way{"tiny", XRay, Exponential},
        Way{"faults/westover", Westover, Exponential}, Way{"faults/westover", Westover, Additive}}) {
    const cmodel::Config config = test::named_config(way.config);
    scene::SceneDescription description;
    description.volume = "shells:16";
    description.width = 44, description.height = 37;  // several tiles, the last ones cut
    description.method = way.method;
    description.slab_opacity = way.opacity;
    description.opacity_scale = 30.0;  // some sums saturate
    const auto frame = driver::render(scene::build_scene(description), config).frame;
    const auto beats = test::scene_beats(description, config);
    for (int y = 1; y < description.height; y += 5) {
      for (int x = 2; x < description.width; x += 7) {
        const PixelWords words = words_of_pixel(source_of(beats), config, {0, x, y}, true);
        const std::size_t at = 4 * static_cast<std::size_t>(y * description.width + x);
        ++pixels;
        different += std::equal(words.out.begin(), words.out.end(), frame.words.begin() + at) ? 0 : 1;
        const PixelWords again = words_of_pixel(source_of(beats), config, words.at, false);
        EXPECT_EQ(to_text(again), to_text(words)) << "the same by its tile";
        for (const auto& sheet : words.sheets) {
          for (std::size_t c = 0; c < 4; ++c) {
            std::uint64_t sum = 0;
            for (const auto& splat : sheet.splats) sum += splat.product[c];
            const auto most = static_cast<std::uint64_t>(config.sheet_format().max);
            saturated += sum > most ? 1 : 0;
            wrong += std::min(sum, most) == sheet.sums[c] ? 0 : 1;
            ++sums;
          }
          splats += sheet.splats.size();
        }
      }
    }
  }
  std::printf(
      "[figure] pixels = %zu, different: %zu (limit 0); splats = %zu, sums = %zu, saturated: %zu, wrong: %zu "
      "(limit 0)\n",
      pixels, different, splats, sums, saturated, wrong);
  EXPECT_EQ(different, 0u);
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(sums, pixels);
  EXPECT_GT(saturated, 0u);
}

TEST(PixelWords, RefusesWhatIsNoPixel) {
  const cmodel::Config config = test::named_config("tiny");
  scene::SceneDescription description;
  description.volume = "shells:8";
  description.width = description.height = 20;
  const auto beats = test::scene_beats(description, config);
  EXPECT_THROW(words_of_pixel(source_of(beats), config, {0, 20, 0}, true), UserError);
  EXPECT_THROW(words_of_pixel(source_of(beats), config, {0, -1, 0}, true), UserError);
  EXPECT_THROW(words_of_pixel(source_of(beats), config, {9, 0, 0}, false), UserError);
}

}  // namespace
}  // namespace fastsplat::testbench
