// SPDX-License-Identifier: Apache-2.0
// Hounsfield units, background and percentiles are independent of padding and air.
#include "scene/value_range.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "scene/transfer_function.hpp"
#include "scene/volume/synthetic.hpp"
#include "tests/volume/volume_testing.hpp"

namespace fastsplat::scene {
namespace {

using volume::VoxelType;

/// Noise of standard deviation 1, fixed by the voxel's place: the sum of twelve even draws.
double noise(int i, int j, int k) {
  std::uint32_t state = 1 + static_cast<std::uint32_t>(i + 64 * (j + 64 * k));
  double sum = -6.0;
  for (int draw = 0; draw < 12; ++draw) {
    state = state * 1664525u + 1013904223u;
    state ^= state >> 15;
    sum += state / 4294967296.0;
  }
  return sum;
}

/// A CT of a cylinder of 40 HU with a rod of 700 HU in air, noise of 10 HU. Outside the scanner's round field the value
/// is `padding` if that is below air; `offset` is added to all.
volume::Volume phantom(double padding, double offset, VoxelType stored) {
  return volume::make_volume({48, 48, 24}, glm::dvec3(1), stored, [=](int i, int j, int k) {
    const double x = i - 23.5, y = j - 23.5, radius = std::hypot(x, y);
    const bool inside = radius < 15 && k > 2 && k < 21;
    const double hu = !inside ? -1000.0 : std::hypot(x - 5, y) < 3 ? 700.0 : 40.0;
    if (radius > 23.5 && padding < -1000.0) return padding + offset;
    return std::round(std::max(hu + 10.0 * noise(i, j, k), -1024.0) + offset);
  });
}

struct Padded {
  const char* name;
  volume::Volume volume;
  double water;
};

std::vector<Padded> phantoms() {
  return {{"air alone", phantom(0, 0, VoxelType::I16), 0},
          {"padding -1024", phantom(-1024, 0, VoxelType::I16), 0},
          {"padding -3024", phantom(-3024, 0, VoxelType::I16), 0},
          {"padding -3024, float", phantom(-3024, 0, VoxelType::F32), 0},
          {"stored from 0", phantom(-1024, 1024, VoxelType::U16), 1024}};
}

TEST(ValueRange, PaddingAndOffsetChangeNoTissueOfACt) {
  const auto all = phantoms();
  int compared = 0;
  for (const char* name : {"bone", "ct-head", "soft-tissue"}) {
    const TransferFunction tf = load_transfer_function(name);
    const Classifier first(tf, all[0].volume);
    for (const auto& [padding, volume, water] : all) {
      SCOPED_TRACE(std::string(name) + ", " + padding);
      ASSERT_EQ(volume.water, water);
      EXPECT_EQ(remark_on(tf, volume), "");
      const Classifier classify(tf, volume);
      EXPECT_EQ(classify(volume.at(0, 0, 0)).extinction, 0.0f);  // the corner is clear
      for (int hu = -1000; hu <= 700; hu += 10, ++compared) {
        EXPECT_EQ(classify(static_cast<float>(hu + water)).extinction, first(static_cast<float>(hu)).extinction) << hu;
        EXPECT_EQ(classify(static_cast<float>(hu + water)).colour, first(static_cast<float>(hu)).colour) << hu;
      }
    }
    EXPECT_EQ(first(-950.0f).extinction, 0.0f);
    EXPECT_GT(first(700.0f).extinction, 0.0f);
  }
  std::printf("[figure] materials compared between phantoms = %d\n", compared);
}

TEST(ValueRange, PaddingAndOffsetChangeNoSpanOfACt) {
  const auto all = phantoms();
  const ValueSpan first = shown_span(all[0].volume);
  for (const auto& [padding, volume, water] : all) {
    SCOPED_TRACE(padding);
    EXPECT_EQ(background_top(volume), water - 900.0);
    EXPECT_EQ(shown_span(volume).low, first.low + water);
    EXPECT_EQ(shown_span(volume).high, first.high + water);
    EXPECT_EQ(spread(volume), spread(all[0].volume));
  }
  std::printf("[figure] shown span of the phantoms = %g to %g HU\n", first.low, first.high);
}

/// Voxels of these values, and as many evenly between the first two.
volume::Volume values_of(double low, double high, std::initializer_list<double> others) {
  const auto many = static_cast<int>(others.size());
  return volume::make_volume({10, 10, 1 + many}, glm::dvec3(1), VoxelType::F32, [=](int i, int j, int k) {
    return k == 0 ? low + (high - low) * (i + 10 * j) / 99.0 : *(others.begin() + k - 1);
  });
}

TEST(ValueRange, CtsAreDistinguishedFromOtherScans) {
  const struct {
    const char* what;
    volume::Volume volume;
    std::optional<double> water;
  } scans[] = {
      {"CT", values_of(-1024, 3071, {-1000, -1000, 40, 40}), 0.0},
      {"CT of a chest", values_of(-1024, 2000, {-1000, -850, -800, -750, -700, 40}), 0.0},
      {"CT stored from 0", values_of(0, 4095, {24, 24, 1064, 1064, 1000}), 1024.0},
      {"CT stored from 0, padded with -2000", values_of(0, 4095, {-2000, -2000, 24, 24, 1064, 1064, 1000}), 1024.0},
      {"CT stored from 0, padded with -1000", values_of(0, 4095, {-1000, 24, 24, 1064, 1064, 1000}), 1024.0},
      {"CT stored from 0, padded with -32768", values_of(0, 4095, {-32768, 24, 24, 1064, 1064, 1000}), 1024.0},
      {"CT padded with -2000", values_of(-1024, 3071, {-2000, -2000, -1000, -1000, 40, 40}), 0.0},
      {"phases of 11 bits", values_of(-2048, 2047, {}), std::nullopt},
      {"phases of a head", values_of(-4096, 4094, {0, 10, 100, -90}), std::nullopt},
      {"MRI of 12 bits", values_of(0, 4095, {0, 0, 600, 900, 1400, 1900}), std::nullopt},
      {"MRI with dim tissue", values_of(0, 2000, {5, 5, 200, 350, 450}), std::nullopt},
      {"MRI resampled with overshoot", values_of(-30, 1200, {0, 0, 100, 250}), std::nullopt},
      {"phases", values_of(-4096, 4095, {}), std::nullopt},
      {"bytes", values_of(0, 255, {0, 100}), std::nullopt},
      {"a difference of pictures", values_of(-1, 1, {0}), std::nullopt},
      {"an industrial scan", values_of(0, 1300, {390, 390, 700}), std::nullopt},
  };
  for (const auto& scan : scans) EXPECT_EQ(volume::find_water(scan.volume), scan.water) << scan.what;
  std::printf("[figure] kinds of scans = %zu\n", std::size(scans));
}

TEST(ValueRange, OtherScansAreStretchedWithANotice) {
  const TransferFunction bone = load_transfer_function("bone");
  const auto bytes = values_of(0, 200, {});
  EXPECT_NE(remark_on(bone, bytes).find("0 to 200 are not: they are mapped to -1000 to 3000 HU"), std::string::npos);
  EXPECT_EQ(resolved(bone, bytes).points[0].at, 62.0);  // (240 + 1000) / 4000 of 200
}

TEST(ValueRange, AirThatIsNotTheLeastValueIsBackground) {
  // A ball of 700 in air of 390, as an industrial scan of a tooth has it; a few dark voxels lie below.
  for (const VoxelType stored : {VoxelType::U16, VoxelType::F32}) {
    const auto ball = volume::make_volume({32, 32, 32}, glm::dvec3(1), stored, [](int i, int j, int k) {
      if (i == 16 && j == 16) return 0.0;
      const bool inside = glm::length(glm::dvec3(i, j, k) - 15.5) < 10;
      return std::round((inside ? 700.0 : 390.0) + 8.0 * noise(i, j, k));
    });
    const double top = background_top(ball);
    std::printf("[figure] background of the ball = %g (air 390 with deviation 8)\n", top);
    EXPECT_GT(top, 390 + 4 * 8);  // of 20,000 normal draws the greatest is near four deviations
    EXPECT_LT(top, 390 + 8 * 8);
    const Classifier classify(load_transfer_function("default"), ball);
    EXPECT_EQ(classify(415.0f).extinction, 0.0f);
    EXPECT_GT(classify(700.0f).extinction, 0.0f);
  }
}

TEST(ValueRange, PaddingBeyondARoundFieldIsBackgroundToo) {
  // Air of 390 in a cylinder wider than the volume; its corners are 0, as a reconstruction of a round field leaves
  // them.
  const auto head = volume::make_volume({32, 32, 32}, glm::dvec3(1), VoxelType::U16, [](int i, int j, int k) {
    if (std::hypot(i - 15.5, j - 15.5) > 18.5) return 0.0;
    const bool inside = glm::length(glm::dvec3(i, j, k) - 15.5) < 10;
    return std::round((inside ? 700.0 : 390.0) + 8.0 * noise(i, j, k));
  });
  const auto padding = std::count(head.voxels.begin(), head.voxels.end(), 0.0f);
  std::printf("[figure] padding = %.1f %% of the voxels (limit > 5 %%), background to %g\n",
              100.0 * static_cast<double>(padding) / static_cast<double>(head.voxels.size()), background_top(head));
  EXPECT_GT(padding * 20, static_cast<long>(head.voxels.size()));
  EXPECT_GT(background_top(head), 390 + 4 * 8);
  EXPECT_LT(background_top(head), 390 + 8 * 8);
}

TEST(ValueRange, ABrightLevelOnTheFacesIsNotTheBackground) {
  const auto negative = volume::make_volume({16, 16, 16}, glm::dvec3(1), VoxelType::U8, [](int i, int j, int k) {
    return glm::length(glm::dvec3(i, j, k) - 7.5) < 7 ? 20 + i : 200;
  });
  const auto darker = std::count_if(negative.voxels.begin(), negative.voxels.end(), [](float v) { return v < 200; });
  std::printf("[figure] voxels darker than the faces = %.1f %% (limit 5 %%)\n",
              100.0 * static_cast<double>(darker) / static_cast<double>(negative.voxels.size()));
  EXPECT_EQ(background_top(negative), negative.min);
}

TEST(ValueRange, WithoutALevelOnTheFacesTheLeastValueIsTheBackground) {
  int compared = 0;
  for (const std::string& name : volume::synthetic_names()) {
    const volume::Volume volume = volume::make_synthetic(name, 12);
    EXPECT_EQ(background_top(volume), volume.min) << name;
    ++compared;
  }
  std::printf("[figure] built-in volumes with the least value as background = %d\n", compared);
}

TEST(ValueRange, AReferenceLengthInMillimetresIsTheSameForThickSlices) {
  TransferFunction tf = load_transfer_function("linear");
  tf.reference_length_mm = 2.0;
  int compared = 0;
  for (const double thickness : {1.0, 2.0, 4.0}) {
    const auto slab = volume::make_volume({4, 4, static_cast<int>(8 / thickness)}, glm::dvec3(1, 1, thickness),
                                          VoxelType::U8, [](int i, int, int) { return i; });
    const double depth = 8.0 / slab.kernel_unit();  // of 8 mm of the material
    EXPECT_NEAR(Classifier(tf, slab)(3).extinction * depth, 4.0 * std::log(2.0), 1e-6);
    ++compared;
  }
  EXPECT_EQ(resolved(tf, volume::make_synthetic("shells", 8)).reference_length_mm, std::nullopt);
  std::printf("[figure] slabs compared = %d\n", compared);
}

}  // namespace
}  // namespace fastsplat::scene
