// SPDX-License-Identifier: Apache-2.0
// Error maps: the right colour at the right pixel, a legend with its numbers, no loss in a display file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "analysis/bitmap_font.hpp"
#include "analysis/colour_map.hpp"
#include "analysis/compare.hpp"
#include "base/images/image_file.hpp"
#include "base/srgb.hpp"
#include "tests/images/image_helper.hpp"

namespace fastsplat::analysis {
namespace {

std::array<int, 3> drawn(const Image& map, int x, int y) {
  std::array<int, 3> codes{};
  for (std::size_t c = 0; c < 3; ++c) {
    codes[c] = static_cast<int>(std::lround(srgb_encode(map.pixel(x, y)[c]) * 255));
  }
  return codes;
}

std::array<int, 3> codes(Colour colour) { return {colour.red, colour.green, colour.blue}; }

/// Grey, with one error per column: -3, -1, 0, +1, +3 LSB in different channels, and one that is not finite.
struct Pair {
  Image ref{300, 40, 4};
  Image test{300, 40, 4};
  Pair() {
    for (float& value : ref.data) value = 0.5f;
    test = ref;
    const std::array<double, 5> errors{-3, -1, 0, 1, 3};
    for (int x = 0; x < 5; ++x) {
      test.pixel(x, 7)[x % 4] += static_cast<float>(errors[static_cast<std::size_t>(x)] / 255);
      test.pixel(x, 7)[(x + 1) % 4] += 0.1f / 255;  // not the worst channel
    }
    for (int c = 0; c < 4; ++c) test.pixel(9, 9)[c] = std::numeric_limits<float>::quiet_NaN();
  }
};

TEST(LsbMap, ColoursFollowTheSignedError) {
  const Pair pair;
  const Image map = lsb_map(pair.ref, pair.test, {});
  EXPECT_EQ(map.width, 300);
  EXPECT_GT(map.height, 40);
  EXPECT_EQ(map.channels, 4);
  // The scale ends at the first round number above 3.0000x, so -3 and +3 are three quarters out or at the ends.
  const double position = 3.0 / (codes(diverging_colour(-1)) == drawn(map, 0, 7) ? 3 : 4);
  EXPECT_EQ(drawn(map, 0, 7), codes(diverging_colour(-position)));
  EXPECT_EQ(drawn(map, 4, 7), codes(diverging_colour(position)));
  EXPECT_GT(drawn(map, 1, 7)[2], drawn(map, 1, 7)[0]);  // -1 is bluish, +1 reddish
  EXPECT_GT(drawn(map, 3, 7)[0], drawn(map, 3, 7)[2]);
  EXPECT_EQ(drawn(map, 100, 30), codes(diverging_colour(0)));
  EXPECT_EQ(drawn(map, 9, 9), codes(kNonfiniteColour));
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) ASSERT_EQ(map.pixel(x, y)[3], 1.0f);
  }
}

TEST(HeatMap, ColoursRiseWithTheError) {
  const Pair pair;
  const Image map = heat_map(pair.ref, pair.test, {});
  EXPECT_EQ(drawn(map, 100, 30), codes(heat_colour(0)));
  EXPECT_EQ(drawn(map, 0, 7), drawn(map, 4, 7));
  EXPECT_EQ(drawn(map, 9, 9), codes(kNonfiniteColour));
  const auto brightness = [&](int x) { return drawn(map, x, 7)[0] + drawn(map, x, 7)[1]; };
  EXPECT_GT(brightness(0), brightness(1));
  EXPECT_GT(brightness(1), brightness(2));
}

TEST(Maps, HaveALegendThatDependsOnTheScale) {
  const Image ref = images::random_image(256, 64, 3, 1);
  Image small = ref, large = ref;
  for (std::size_t i = 0; i < ref.data.size(); i += 7) small.data[i] += 0.5f / 255, large.data[i] += 90.0f / 255;
  for (const auto& map : {lsb_map, heat_map}) {
    const Image a = map(ref, small, {});
    const Image b = map(ref, large, {});
    ASSERT_EQ(a.height, b.height);
    int differing = 0, ink = 0;
    for (int y = 64; y < a.height; ++y) {
      for (int x = 0; x < 256; ++x) {
        differing += drawn(a, x, y) != drawn(b, x, y);
        ink += drawn(a, x, y) == std::array{32, 32, 32};
      }
    }
    EXPECT_GT(differing, 50);
    EXPECT_GT(ink, 500);
  }
}

TEST(Maps, SmallImagesAreEnlargedToTheLegend) {
  const Image image = images::random_image(30, 20, 4, 1);
  const Image map = lsb_map(image, image, {});
  EXPECT_EQ(map.width, 270);  // 9 times
  EXPECT_GT(map.height, 180);
  const Image strip = images::random_image(3, 2000, 4, 1);
  EXPECT_EQ(lsb_map(strip, strip, {}).width, 256);
  EXPECT_GT(lsb_map(Image(0, 0, 4), Image(0, 0, 4), {}).height, 0);
}

TEST(Maps, SurviveADisplayFileExactly) {
  const images::TempFolder folder;
  const Pair pair;
  const Image map = lsb_map(pair.ref, pair.test, {});
  EXPECT_EQ(images::write_image(folder / "map.png", map, {}, {.display = true}), 0u);
  const Image shown = images::read_image(folder / "map.png").image;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(std::lround(shown.pixel(x, y)[c] * 255), drawn(map, x, y)[c]);
    }
  }
}

TEST(BitmapFont, HasEveryCharacterOfTheLegends) {
  for (const char c : std::string("0123456789+-./(),:TESTREFLSBabcdefghijklmnopqrstuvwxyz")) {
    int dots = 0;
    for (const auto row : glyph(c)) {
      EXPECT_LT(row, 32);
      dots += row != 0;
    }
    EXPECT_GT(dots, 0) << c;
  }
}

}  // namespace
}  // namespace fastsplat::analysis
