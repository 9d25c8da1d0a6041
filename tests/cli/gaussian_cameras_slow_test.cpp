// SPDX-License-Identifier: Apache-2.0
// Cameras, orders, boxes and animations of 3-D Gaussians from the command line.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "base/images/image_file.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

using Json = nlohmann::json;

class GaussianCameras : public ::testing::Test {
 protected:
  GaussianCameras() {
    // Three cameras of a trainer, 160x100, before, beside and in built-in shells.
    Json cameras = Json::array();
    const std::vector<std::vector<double>> eyes{{0.1, -4, 0.2}, {4, 0.2, 0}, {0, -0.4, 0.1}};
    const std::vector<std::vector<std::vector<double>>> rotations{
        {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}, {{0, 0, -1}, {1, 0, 0}, {0, -1, 0}}, {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}};
    for (std::size_t i = 0; i < eyes.size(); ++i)
      cameras.push_back({{"id", i},
                         {"img_name", "photo_" + std::to_string(i)},
                         {"width", 160},
                         {"height", 100},
                         {"fx", 150.0},
                         {"fy", 149.0},
                         {"position", eyes[i]},
                         {"rotation", rotations[i]}});
    file_ = folder_.write("cameras.json", cameras.dump());
  }
  Result render(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"render", "--gaussians", "shells:600"};
    words.insert(words.end(), more.begin(), more.end());
    return fastsplat(words);
  }
  images::LoadedImage image(const std::string& name) const { return images::read_image(folder_ / name); }

  TempFolder folder_;
  std::string file_;
};

TEST_F(GaussianCameras, EveryCameraOfAFileIsAFrame) {
  const Result run =
      render({"--cameras", file_, "--sequence", "-o", folder_ / "view-#.exr", "--json", folder_ / "run.json"});
  expect_success(run);
  const Json json = Json::parse(read_bytes(folder_ / "run.json"));
  ASSERT_EQ(json["frames"].size(), 3U);
  std::size_t compared = 0, lit = 0;
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(json["frames"][static_cast<std::size_t>(i)]["camera"], "photo_" + std::to_string(i));
    expect_success(render({"--cameras", file_, "--view", "photo_" + std::to_string(i), "-o", folder_ / "still.exr"}));
    const auto frame = image("view-" + std::to_string(i) + ".exr"), still = image("still.exr");
    EXPECT_EQ(frame.metadata, still.metadata);
    EXPECT_EQ(frame.image.data, still.image.data);
    EXPECT_EQ(frame.image.width, 160);
    EXPECT_EQ(frame.image.height, 100);
    compared += frame.image.data.size();
    for (const float value : frame.image.data) lit += value > 0.01F ? 1U : 0U;
  }
  std::printf("[figure] values of frames and stills compared: %zu, above 0.01: %zu\n", compared, lit);
  EXPECT_GT(lit, compared / 20);
  const Result again = render({"--cameras", file_, "--sequence", "-o", folder_ / "view-#.exr"});
  expect_success(again);
  EXPECT_NE(again.err.find("3 kept"), std::string::npos) << again.err;
}

// The second camera, as an eye that looks along -x and as a matrix: the same picture.
TEST_F(GaussianCameras, AnEyeAndAMatrixAreTheSameCamera) {
  const double fov = 2.0 * std::atan(50.0 / 150.0) * 180.0 / 3.14159265358979323846;
  const std::string angle = std::to_string(fov);
  expect_success(render(
      {"--eye", "4,0.2,0", "--look-at", "0,0.2,0", "--fov", angle, "--size", "160x100", "-o", folder_ / "eye.exr"}));
  expect_success(
      render({"--pose=0,0,-1,4,1,0,0,0.2,0,-1,0,0", "--fov", angle, "--size", "160x100", "-o", folder_ / "pose.exr"}));
  expect_success(fastsplat({"compare", folder_ / "eye.exr", folder_ / "pose.exr", "--min-psnr", "120"}));
  expect_success(render({"--cameras", file_, "--view", "1", "-o", folder_ / "file.exr"}));
  const Result other = fastsplat({"compare", folder_ / "eye.exr", folder_ / "file.exr", "--min-psnr", "120"});
  EXPECT_EQ(other.code, 1) << "its fy is less by 1 in 150: " << other.out;
}

TEST_F(GaussianCameras, AnOrbitsFramesAreStills) {
  for (const std::vector<std::string>& engine :
       {std::vector<std::string>{}, std::vector<std::string>{"--engine", "cmodel"}}) {
    const auto with = [&](std::vector<std::string> words) {
      words.insert(words.end(), engine.begin(), engine.end());
      words.insert(words.end(), {"--size", "72", "--elevation", "20"});
      return render(words);
    };
    const std::string name = engine.empty() ? "golden-" : "device-";
    expect_success(with({"--orbit", "0..90", "--frames", "3", "-o", folder_ / (name + "#.exr")}));
    for (int i = 0; i < 3; ++i) {
      expect_success(with({"--azimuth", std::to_string(45 * i), "-o", folder_ / "still.exr"}));
      const auto frame = image(name + std::to_string(i) + ".exr"), still = image("still.exr");
      EXPECT_EQ(frame.metadata, still.metadata);
      EXPECT_EQ(frame.image.data, still.image.data);
    }
  }
}

// From a camera within the scene, in either order of Gaussians.
TEST_F(GaussianCameras, TheDeviceIsAbove50dBOfGoldenFromThem) {
  for (const std::string order : {"centres", "distance"}) {
    for (const std::string view : {"0", "2"}) {
      const std::vector<std::string> scene{"--cameras", file_, "--view", view, "--order", order};
      const auto with = [&](std::vector<std::string> words) {
        words.insert(words.end(), scene.begin(), scene.end());
        return render(words);
      };
      expect_success(with({"-o", folder_ / "golden.exr"}));
      expect_success(with({"--engine", "cmodel", "-o", folder_ / "device.exr"}));
      const Result compared = fastsplat({"compare", folder_ / "golden.exr", folder_ / "device.exr", "--min-psnr", "50",
                                         "--json", folder_ / "c.json"});
      expect_success(compared);
      std::printf("[figure] %s, camera %s: %s dB\n", order.c_str(), view.c_str(),
                  Json::parse(read_bytes(folder_ / "c.json"))["psnr_db"].dump().c_str());
    }
  }
  expect_success(render({"--size", "64", "-o", folder_ / "a.exr"}));
  expect_success(render({"--size", "64", "--order", "distance", "-o", folder_ / "b.exr"}));
  EXPECT_NE(image("a.exr").metadata.at("method"), image("b.exr").metadata.at("method"));
  expect_success(fastsplat({"errors", "--gaussians", "shells:200", "--eye", "3,1,1", "--size", "48", "--quick"}));
  expect_success(fastsplat(
      {"cycles", "--gaussians", "shells:200", "--eye", "3,1,1", "--size", "48", "--crop", "-1..1,-1..1,0..1"}));
}

TEST_F(GaussianCameras, MisuseIsRefusedInOneLine) {
  struct Misuse {
    std::vector<std::string> words, said;
  };
  for (const Misuse& misuse : {
           Misuse{{"--eye", "1,2"}, {"--eye", "X,Y,Z"}},
           Misuse{{"--eye", "1,2,3", "--azimuth", "3"}, {"--eye", "--azimuth"}},
           Misuse{{"--eye", "1,2,3", "--zoom", "3"}, {"--eye", "--zoom"}},
           Misuse{{"--eye", "1,2,3", "--orthographic"}, {"--eye", "--orthographic"}},
           Misuse{{"--eye", "1,2,3", "--cameras", file_}, {"--cameras", "--eye"}},
           Misuse{{"--eye", "1,2,3", "--orbit", "0..9", "--frames", "2"}, {"--orbit", "--eye"}},
           Misuse{{"--eye", "1,2,3", "--look-at", "1,2,3"}, {"--eye", "--look-at"}},
           Misuse{{"--look-at", "1,2,3"}, {"--look-at", "--eye"}},
           Misuse{{"--look-at", "1,2,3", "--cameras", file_}, {"--cameras", "--look-at"}},
           Misuse{{"--pose", "1,2,3"}, {"--pose", "12 numbers"}},
           Misuse{{"--pose", "2,0,0,0,0,2,0,0,0,0,2,0"}, {"--pose", "rotation"}},
           Misuse{{"--pose", "1,0,0,0,0,1,0,0,0,0,1,0", "--roll", "3"}, {"--pose", "--roll"}},
           Misuse{{"--cameras", file_, "--up", "z"}, {"--cameras", "--up"}},
           Misuse{{"--view", "1"}, {"--view", "--cameras"}},
           Misuse{{"--cameras", file_, "--view", "photo_9"}, {"--view", "photo_0", "0 to 2"}},
           Misuse{{"--cameras", file_, "--fov", "40"}, {"--cameras", "--fov"}},
           Misuse{{"--cameras", file_, "--sequence", "--view", "1"}, {"--view", "--sequence"}},
           Misuse{{"--cameras", file_, "--sequence", "--frames", "2"}, {"--frames", "--sequence"}},
           Misuse{{"--sequence"}, {"--sequence", "--cameras FILE"}},
           Misuse{{"--near", "0"}, {"--near", "1e-06"}},
           Misuse{{"--near", "1", "--orthographic"}, {"--near", "--orthographic"}},
           Misuse{{"--crop", "1..2"}, {"--crop", "A..B"}},
           Misuse{{"--crop", "7..8,7..8,7..8"}, {"--crop", "no Gaussian"}},
           Misuse{{"--keep-memory", "9"}, {"--keep-memory"}},
           Misuse{{"--order", "pixels", "--engine", "cmodel"}, {"--order", "distance"}},
       }) {
    std::vector<std::string> words{"-o", folder_ / "none.exr"};
    words.insert(words.end(), misuse.words.begin(), misuse.words.end());
    expect_error(render(words), 2, misuse.said);
  }
  expect_error(render({"-o", folder_ / "none.exr", "--cameras", folder_ / "no.json"}), 3, {"no.json"});
  expect_error(render({"-o", file_, "--cameras", file_}), 2, {"cameras.json"});
  for (const char* flag :
       {"--eye=1,2,3", "--pose=1,0,0,0,0,1,0,0,0,0,1,0", "--near=1", "--cameras=a.json", "--view=1", "--look-at=1,2,3"})
    expect_error(fastsplat({"render", "-o", folder_ / "none.exr", flag}), 2,
                 {std::string(flag).substr(0, std::string(flag).find('=')), "--gaussians FILE"});
  expect_error(fastsplat({"render", "--volume", "shells:8", "-o", folder_ / "none.exr", "--crop", "0.5..2,0..3,0..3"}),
               2, {"--crop", "voxels from 0"});
  for (const std::string verb : {"cycles", "verify", "errors"})
    expect_error(fastsplat({verb, "--gaussians", "shells:99", "--order", "pixels"}), 2, {"--order", "distance"});
  EXPECT_EQ(folder_.entries(), std::vector<std::string>{"cameras.json"});
}

}  // namespace
}  // namespace fastsplat::cli_test
