// SPDX-License-Identifier: Apache-2.0
#include "scene/transfer_function.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "scene/scene.hpp"
#include "tests/scene/scene_testing.hpp"

namespace fastsplat::scene {
namespace {

using ::testing::HasSubstr;

/// All 16-bit values as a 256 x 256 x 1 volume.
volume::Volume every_value(volume::VoxelType type, int low) {
  return make_volume({256, 256, 1}, glm::dvec3(1), type, [low](int i, int j, int) { return low + i + 256 * j; });
}

/// The definition, in the plainest way: find the segment, interpolate, convert.
Material by_hand(const TransferFunction& tf, double low, double high, double value) {
  const double at = (value - low) / (high - low);
  const auto& p = tf.points;
  glm::dvec3 colour = p.front().colour;
  double opacity = p.front().opacity;
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (at >= p[i].at) colour = p[i].colour, opacity = p[i].opacity;
    if (i + 1 < p.size() && at > p[i].at && at < p[i + 1].at) {
      const double t = (at - p[i].at) / (p[i + 1].at - p[i].at);
      colour = (1 - t) * p[i].colour + t * p[i + 1].colour;
      opacity = (1 - t) * p[i].opacity + t * p[i + 1].opacity;
    }
  }
  return {glm::vec3(colour), static_cast<float>(-std::log(1.0 - opacity) / tf.reference_length)};
}

// N-8-16.
TEST(Classifier, IsExactForEverySixteenBitValue) {
  TransferFunction tf;
  tf.domain = Domain::Range;
  tf.reference_length = 2.0;
  tf.points = {{0.1, {0, 0, 0}, 0.0}, {0.3, {1, 0.5, 0}, 0.4}, {0.6, {0, 1, 1}, 0.1}, {0.9, {1, 1, 1}, 0.95}};
  std::size_t compared = 0;
  double worst = 0.0;
  for (const auto& [type, low] : {std::pair{volume::VoxelType::U16, 0}, {volume::VoxelType::I16, -32768}}) {
    const volume::Volume volume = every_value(type, low);
    const Classifier classify(tf, volume);
    for (const float value : volume.voxels) {
      const Material got = classify(value);
      const Material expected = by_hand(tf, volume.min, volume.max, value);
      worst = std::max({worst, std::abs(static_cast<double>(got.extinction) - expected.extinction)});
      if (expected.extinction > 0) {
        for (int c = 0; c < 3; ++c)
          worst = std::max(worst, std::abs(static_cast<double>(got.colour[c]) - expected.colour[c]));
      }
      ++compared;
    }
  }
  // Both sides round to float once, from doubles that differ by a few ulps.
  const double limit = 2.0 * 0x1p-24;
  std::printf("[figure] classifier against definition = %.3g over %zu values (limit %.3g)\n", worst, compared, limit);
  EXPECT_EQ(compared, 131072u);
  EXPECT_LE(worst, limit);
}

TEST(Classifier, FloatsAreEvaluatedDirectlyTheSameWay) {
  const TransferFunction tf = load_transfer_function("default");
  volume::Volume integers = every_value(volume::VoxelType::U16, 0);
  volume::Volume floats = integers;
  floats.stored = volume::VoxelType::F32;
  const Classifier tabulated(tf, integers);
  const Classifier direct(tf, floats);
  for (const float value : integers.voxels) {
    EXPECT_EQ(tabulated(value).extinction, direct(value).extinction);
    EXPECT_EQ(tabulated(value).colour, direct(value).colour);
  }
}

// N-8-16: of two points at one value the later one.
TEST(Classifier, PointsAtOnePlaceMakeAStep) {
  TransferFunction tf;
  tf.domain = Domain::Value;
  tf.points = {{5.0, {1, 0, 0}, 0.0}, {5.0, {0, 1, 0}, 0.5}};
  const volume::Volume volume =
      make_volume({11, 1, 1}, glm::dvec3(1), volume::VoxelType::U8, [](int i, int, int) { return i; });
  const Classifier classify(tf, volume);
  EXPECT_EQ(classify(4).extinction, 0.0f);
  EXPECT_FLOAT_EQ(classify(5).extinction, static_cast<float>(std::log(2.0)));
  EXPECT_EQ(classify(5).colour, glm::vec3(0, 1, 0));
  EXPECT_EQ(classify(10).extinction, classify(5).extinction);
}

// N-8-16.
TEST(Classifier, OpacityOfOneReferenceLengthComesBack) {
  TransferFunction tf;
  tf.domain = Domain::Value;
  tf.reference_length = 3.0;
  tf.points = {{0.0, {1, 1, 1}, 0.37}};
  const volume::Volume volume =
      make_volume({2, 1, 1}, glm::dvec3(1), volume::VoxelType::U8, [](int i, int, int) { return i; });
  const double extinction = static_cast<double>(Classifier(tf, volume)(0).extinction);
  EXPECT_NEAR(1.0 - std::exp(-extinction * 3.0), 0.37, 1e-7);
}

TEST(Classifier, PercentilesLeaveTheBackgroundOut) {
  // 5000 voxels of background 0 and the values 1..1000: ranks 0.5 % and 99.8 % of 1000 values are 5 and 998 (rank 4,
  // 997 counted from 0 and rounded down).
  const volume::Volume volume = make_volume({6000, 1, 1}, glm::dvec3(1), volume::VoxelType::U16,
                                            [](int i, int, int) { return std::max(0, i - 4999); });
  TransferFunction tf;
  tf.domain = Domain::Percentile;
  tf.points = {{0.0, {0, 0, 0}, 0.0}, {0.0, {0, 0, 0}, 0.5}, {1.0, {0, 0, 0}, 0.5}, {1.0, {0, 0, 0}, 0.9}};
  const Classifier classify(tf, volume);
  EXPECT_EQ(classify(4).extinction, 0.0f);
  EXPECT_GT(classify(5).extinction, 0.0f);
  EXPECT_NEAR(classify(997).extinction, std::log(2.0), 1e-6);
  EXPECT_NEAR(classify(998).extinction, -std::log(0.1), 1e-6);
}

TEST(Classifier, AConstantVolumeCountsAsFull) {
  for (const Domain domain : {Domain::Range, Domain::Percentile}) {
    TransferFunction tf = load_transfer_function("linear");
    tf.domain = domain;
    for (const float value : {-3.0f, 0.0f, 1.0f, 200.0f}) {
      const volume::Volume volume =
          make_volume({2, 2, 2}, glm::dvec3(1), volume::VoxelType::F32, [value](int, int, int) { return value; });
      EXPECT_FLOAT_EQ(Classifier(tf, volume)(value).extinction, static_cast<float>(std::log(2.0)));
    }
  }
}

// Integers get their ranks by counting, other values by sorting: the same voxels, the same percentiles.
TEST(Classifier, PercentilesAreTheSameCountedAndSorted) {
  TransferFunction tf = load_transfer_function("linear");
  tf.domain = Domain::Percentile;
  int compared = 0;
  for (const int size : {1, 2, 3, 10, 333}) {
    for (const int spread : {1, 2, 5, 200, 60000}) {
      for (const int low : {0, -32768, 17}) {
        const auto value = [=](int i, int j, int k) {
          return low + static_cast<int>((2654435761U * static_cast<std::uint32_t>(1 + i + 7 * j + 31 * k) >> 8) %
                                        static_cast<std::uint32_t>(spread));
        };
        const glm::ivec3 dims(size, 3, 2);
        const auto type = low < 0 ? volume::VoxelType::I16 : volume::VoxelType::U16;
        const TransferFunction counted = resolved(tf, make_volume(dims, glm::dvec3(1), type, value)),
                               sorted = resolved(tf, make_volume(dims, glm::dvec3(1), volume::VoxelType::F32, value));
        for (std::size_t i = 0; i < tf.points.size(); ++i, ++compared)
          EXPECT_EQ(counted.points[i].at, sorted.points[i].at) << size << ", " << spread << ", " << low;
      }
    }
  }
  std::printf("[figure] points compared = %d\n", compared);
}

TEST(Presets, AreValidAndStayInTheDevicesRange) {
  // The device takes amplitude * extinction as U0.16: with extinction <= 1.5 per kernel unit and a footprint peak of
  // a/pi <= 0.64 that is 0.96 at most.
  constexpr double kLimit = 1.5;
  const auto names = transfer_function_presets();
  for (const char* name :
       {"default", "bone", "soft-tissue", "ct-head", "x-ray", "mri-head", "binary", "checker", "linear"}) {
    EXPECT_THAT(names, ::testing::Contains(name));
  }
  for (const auto& name : names) {
    const TransferFunction tf = load_transfer_function(name);
    double densest = 0.0;
    for (const auto& point : tf.points) densest = std::max(densest, -std::log1p(-point.opacity) / tf.reference_length);
    std::printf("[figure] densest material of %s = %.3f per kernel unit (limit %g)\n", name.c_str(), densest, kLimit);
    EXPECT_GT(densest, 0.0);
    EXPECT_LE(densest, kLimit);
    EXPECT_EQ(tf.name, name);
  }
}

class TransferFunctionFile : public TemporaryFolder {
 protected:
  std::string refused(const std::string& text) const {
    const auto path = write("tf.toml", text);
    const std::string message = refusal([&] { load_transfer_function(path.string()); });
    EXPECT_THAT(message, HasSubstr("tf.toml:"));
    return message;
  }
};

TEST_F(TransferFunctionFile, ReadsWhatItSays) {
  const auto path =
      write("tf.toml",
            "domain = \"value\"\nreference_length = 2\npoints = [{at = -10, colour = [0, 0.5, 1], opacity = 0}]\n"
            "[[unused]]\n");
  EXPECT_THAT(refusal([&] { load_transfer_function(path.string()); }), HasSubstr("unknown key 'unused'"));
  write("tf.toml",
        "domain = \"value\"\nreference_length = 2\n[[points]]\nat = -10\ncolour = [0, 0.5, 1]\nopacity = "
        "1\n[shading]\nspecular = 0.5\n");
  const TransferFunction tf = load_transfer_function(path.string());
  EXPECT_EQ(tf.domain, Domain::Value);
  EXPECT_EQ(tf.reference_length, 2.0);
  ASSERT_EQ(tf.points.size(), 1u);
  EXPECT_EQ(tf.points[0].at, -10.0);
  EXPECT_EQ(tf.points[0].colour, glm::dvec3(0, 0.5, 1));
  EXPECT_EQ(tf.points[0].opacity, 0.9999);  // not quite opaque: extinction stays finite
  EXPECT_TRUE(tf.shading.on);
  EXPECT_EQ(tf.shading.specular, 0.5);
  EXPECT_EQ(tf.shading.diffuse, Shading{}.diffuse);
}

TEST_F(TransferFunctionFile, RefusesWithLineColumnAndHint) {
  const std::string point = "points = [{at = 0, colour = [1, 1, 1], opacity = 0.5}]\n";
  EXPECT_THAT(refused(point + "referense_length = 2\n"),
              HasSubstr("tf.toml:2:1: unknown key 'referense_length'; did you mean 'reference_length'?"));
  EXPECT_THAT(refused(point + "domain = \"values\"\n"),
              HasSubstr("tf.toml:2:10: domain: unknown domain (got \"values\"); did you mean 'value'?"));
  EXPECT_THAT(refused(point + "reference_length = \"2\"\n"), HasSubstr("wrong type (expected a number"));
  EXPECT_THAT(refused(point + "reference_length = 0\n"), HasSubstr("out of range"));
  EXPECT_THAT(refused(point + "reference_length = nan\n"), HasSubstr("out of range"));
  EXPECT_THAT(refused(point + "[shading]\nambient = 2\n"),
              HasSubstr("tf.toml:3:11: shading.ambient: value out of range (expected a number in 0..1, got 2)"));
  EXPECT_THAT(refused(point + "[shading]\non = 1\n"), HasSubstr("true or false"));
  EXPECT_THAT(refused("points = []\n"), HasSubstr("missing or empty"));
  // Hounsfield units, and the default domain.
  for (const std::string domain : {"", "domain = \"percentile\"\n"}) {
    EXPECT_THAT(refused(domain + "points = [{at = 40, colour = [0, 0.5, 1], opacity = 0}]\n"),
                HasSubstr("got 40); write domain = \"value\""));
  }
  EXPECT_THAT(refused("domain = \"value\"\n"), HasSubstr("missing or empty"));
  EXPECT_THAT(refused("points = 3\n"), HasSubstr("array of tables"));
  EXPECT_THAT(refused("points = [1]\n"), HasSubstr("array of tables"));
  EXPECT_THAT(refused("points = [{at = 0, colour = [1, 1], opacity = 0.5}]\n"), HasSubstr("three numbers"));
  EXPECT_THAT(refused("points = [{at = 0, colour = [1, 1, 1.5], opacity = 0.5}]\n"), HasSubstr("out of range"));
  EXPECT_THAT(refused("points = [{at = 0, colour = [1, 1, 1]}]\n"), HasSubstr("points[0].opacity: missing"));
  EXPECT_THAT(refused("points = [{at = 0, color = [1, 1, 1], opacity = 0.5}]\n"), HasSubstr("did you mean 'colour'?"));
  EXPECT_THAT(
      refused("points = [{at = 0.5, colour = [1,1,1], opacity = 0}, {at = 0.4, colour = [1,1,1], opacity = 0}]\n"),
      HasSubstr("ascending"));
  EXPECT_THAT(refused("points = [{at = 0,\n"), HasSubstr("not valid TOML"));
  EXPECT_THAT(refused("x = \"\xff\xfe\"\n"), HasSubstr("not valid TOML"));
}

TEST_F(TransferFunctionFile, MissingFilesAndNamesAreSuggested) {
  EXPECT_THAT(refusal([] { load_transfer_function("mri-heat"); }), HasSubstr("did you mean 'mri-head'?"));
  EXPECT_THAT(refusal([&] { load_transfer_function((folder_ / "none.toml").string()); }), HasSubstr("no such file"));
  EXPECT_THAT(refusal([&] { load_transfer_function(folder_.string()); }), HasSubstr("directory"));
}

TEST(TransferFunctions, AreChosenByTheVolumesName) {
  const auto volume = std::make_shared<const volume::Volume>(
      make_volume({2, 3, 4}, glm::dvec3(1), volume::VoxelType::U8, [](int i, int, int) { return i; }));
  EXPECT_EQ(build_scene({.volume = "ch2bet"}, volume).transfer_function.name, "mri-head");
  EXPECT_EQ(build_scene({.volume = "/some/folder/ch2bet.nii.gz"}, volume).transfer_function.name, "mri-head");
  EXPECT_EQ(build_scene({.volume = "checkerboard-floor:8"}, volume).transfer_function.name, "checker");
  EXPECT_EQ(build_scene({.volume = "other.nrrd"}, volume).transfer_function.name, "default");
}

}  // namespace
}  // namespace fastsplat::scene
