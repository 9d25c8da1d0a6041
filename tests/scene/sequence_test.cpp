// SPDX-License-Identifier: Apache-2.0
// Settings over time: the value of each frame, and invalid [sequence] tables.
#include "scene/sequence.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "base/error.hpp"
#include "tests/scene/scene_testing.hpp"

namespace fastsplat::scene {
namespace {

std::vector<double> azimuths(const Sequence& sequence) {
  std::vector<double> all;
  for (int frame = 0; frame < sequence.frames; ++frame) all.push_back(at_frame(sequence, {}, frame).camera.azimuth);
  return all;
}

TEST(Sequence, AnOrbitIncludesBothEnds) {
  EXPECT_EQ(azimuths(orbit(0, 90, 4)), (std::vector<double>{0, 30, 60, 90}));
  EXPECT_EQ(azimuths(orbit(10, -10, 3)), (std::vector<double>{10, 0, -10}));
  EXPECT_EQ(azimuths(orbit(5, 95, 1)), (std::vector<double>{5}));
}

TEST(Sequence, AWholeTurnDoesNotShowItsFirstPictureTwice) {
  EXPECT_EQ(azimuths(orbit(0, 360, 4)), (std::vector<double>{0, 90, 180, 270}));
  EXPECT_EQ(azimuths(orbit(30, -690, 3)), (std::vector<double>{30, -210, -450}));
}

TEST(Sequence, KeysAreSpreadEvenlyAndMetExactly) {
  const Sequence sequence{.frames = 7, .loop = false, .tracks = {{"camera.zoom", {1.0, 1.7, 0.3}}}};
  EXPECT_EQ(at_frame(sequence, {}, 0).camera.zoom, 1.0);
  EXPECT_EQ(at_frame(sequence, {}, 3).camera.zoom, 1.7);
  EXPECT_EQ(at_frame(sequence, {}, 6).camera.zoom, 0.3);
  EXPECT_DOUBLE_EQ(at_frame(sequence, {}, 1).camera.zoom, 1.0 + 0.7 / 3.0);
}

TEST(Sequence, WholeSettingsCountExactlyAtAnyLength) {
  int compared = 0;
  for (const int frames : {2, 3, 7, 24, 97, 1000}) {
    const Sequence sequence{.frames = frames, .loop = true, .tracks = {{"image.width", {1.0, frames + 1.0}}}};
    for (int frame = 0; frame < frames; ++frame, ++compared)
      ASSERT_EQ(at_frame(sequence, {}, frame).width, 1 + frame) << frames;
  }
  std::printf("[figure] whole_settings_compared = %d (all equal)\n", compared);
  ASSERT_EQ(compared, 2 + 3 + 7 + 24 + 97 + 1000);
}

TEST(Sequence, AKernelsNumbersTakeOverFromItsName) {
  SceneDescription still;
  still.kernel = "smooth";
  const auto now = at_frame({.frames = 2, .loop = false, .tracks = {{"kernel.radius", {2.0, 3.0}}}}, still, 1);
  EXPECT_EQ(now.kernel, "");
  EXPECT_EQ(now.kernel_a, kernel_by_name("smooth").a());
  EXPECT_EQ(now.kernel_radius, 3.0);
}

TEST(Sequence, PropertiesWithoutATrackStay) {
  SceneDescription still;
  still.volume = "point:5";
  still.camera.elevation = 77;
  const auto now = at_frame(orbit(0, 90, 3), still, 2);
  EXPECT_EQ(now.camera.azimuth, 90);
  EXPECT_EQ(now.camera.elevation, 77);
  EXPECT_EQ(now.volume, "point:5");
}

class SequenceFile : public TemporaryFolder {
 protected:
  std::filesystem::path scene_with(const std::string& table) const {
    return write("s.toml", "volume = \"point:5\"\n" + table);
  }
};

TEST_F(SequenceFile, IsReadFromASceneWhoseStillIgnoresIt) {
  const auto path =
      scene_with("[sequence]\nframes = 5\nloop = true\nopacity_scale = [1, 2]\ncamera.azimuth = [0, 10, 40]\n");
  const auto sequence = load_sequence(path);
  EXPECT_EQ(sequence.frames, 5);
  EXPECT_TRUE(sequence.loop);
  ASSERT_EQ(sequence.tracks.size(), 2u);
  EXPECT_EQ(load_scene_file(path).camera.azimuth, SceneDescription{}.camera.azimuth);
}

TEST_F(SequenceFile, ErrorsAreOneLineWithPlaceAndFix) {
  struct Bad {
    const char* table;
    std::vector<std::string> said;
  };
  const std::vector<Bad> all{{"", {"[sequence] is missing"}},
                             {"[sequence]\ncamera.azimuth = [0, 9]\n", {"frames", "missing"}},
                             {"[sequence]\nframes = 0\ncamera.azimuth = [0, 9]\n", {"frames", "1..1000000"}},
                             {"[sequence]\nframes = 3\n", {"changes no setting"}},
                             {"[sequence]\nframes = 3\ncamera.azimut = [0, 9]\n", {"azimut", "did you mean 'azimuth'"}},
                             {"[sequence]\nframes = 3\ncamrea.azimuth = [0, 9]\n", {"camrea", "did you mean 'camera'"}},
                             {"[sequence]\nframes = 3\ncamera.azimuth = 9\n", {"azimuth", "array"}},
                             {"[sequence]\nframes = 3\ncamera.azimuth = []\n", {"azimuth", "array"}},
                             {"[sequence]\nframes = 3\ncamera.zoom = [1, 0]\n", {"zoom", "out of range"}},
                             {"[sequence]\nframes = 3\ncamera.zoom = [1, \"2\"]\n", {"zoom", "wrong type"}}};
  for (const auto& bad : all) {
    const auto path = scene_with(bad.table);
    const std::string said = refusal([&] { load_sequence(path); });
    EXPECT_THAT(said, ::testing::HasSubstr("s.toml"));
    for (const auto& word : bad.said) EXPECT_THAT(said, ::testing::HasSubstr(word));
    if (*bad.table) refusal([&] { load_scene_file(path); });
  }
}

TEST(Orbit, MustGoSomewhere) {
  refusal([] { orbit(30, 30, 4); }, ExitCode::Usage);
}

}  // namespace
}  // namespace fastsplat::scene
