// SPDX-License-Identifier: Apache-2.0
// The command that the lab shows draws the words that the lab shows: for every setting and for changed devices.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/images/image_file.hpp"
#include "lab/link.hpp"
#include "lab/session.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/settings.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat {
namespace {

using Json = nlohmann::ordered_json;

class LabCommand : public testing::Test {
 protected:
  /// Whether the device draws it; if so, the command's words are those of the answer.
  bool drawn_alike(const Json& request) {
    const lab::Answer answer = session_.answer(request.dump());
    const Json json = Json::parse(answer.json);
    if (!json.contains("words_hash")) return false;
    expect_words(json["command"], answer.pictures.at(1));
    return true;
  }

  void expect_words(std::string line, const lab::Words& words) {
    const std::string out = " --out device.exr", name = "fastsplat ";
    ASSERT_TRUE(line.starts_with(name) && line.ends_with(out)) << line;
    line = "exec '" + cli_test::program() + "' " + line.substr(name.size()) + " --quiet";
    const auto run = cli_test::run_words({"sh", "-c", line}, here());
    ASSERT_EQ(run.code, 0) << line << "\n" << run.err;
    const Image image = images::read_image(folder_ / "device.exr").image;
    ASSERT_EQ(image.data.size(), words.words.size()) << line;
    std::size_t differ = 0;
    for (std::size_t i = 0; i < image.data.size(); ++i)
      differ += std::ldexp(image.data[i], std::countr_zero(static_cast<std::uint64_t>(words.scale))) != words.words[i];
    EXPECT_EQ(differ, 0U) << line;
  }

  cli_test::Surroundings here() const {
    cli_test::Surroundings surroundings;
    surroundings.folder = folder_.path();
    return surroundings;
  }

  cli_test::TempFolder folder_;
  lab::Session session_;
};

const Json kScene{{"ask", "frame"}, {"volume", "shells:24"}, {"config", "base"}};
const Json kSize{{"image.width", "40"}, {"image.height", "32"}};

TEST_F(LabCommand, DrawsTheSameForEverySetting) {
  // What a setting needs to have an effect, and a device that draws it.
  const std::vector<std::pair<Json, Json>> surroundings{
      {Json::object(), {}},
      {{{"method", "xray"}}, {}},
      {{{"camera.projection", "perspective"}}, {}},
      {{{"classify.order", "post"}, {"shading", "on"}}, {{"changes", {"classify.segment_bits=9"}}}},
      {{{"camera.projection", "perspective"}, {"footprint.antialias", "on"}}, {{"config", "ellipse"}}},
      {{{"splat_texture.amplitude", "0.7"}}, {{"changes", {"index.kind=blit2d", "snap.phases=8"}}}},
      {{{"culling.freeze", "0.1"}}, {}},
      {{{"texture.kind", "stripes"}}, {}}};
  std::size_t frames = 0, settings = 0;
  for (const scene::Setting& setting : scene::settings()) {
    const std::string name = scene::dotted(setting);
    bool any = false;
    for (const auto& [more, device] : surroundings) {
      Json request = kScene;
      request["settings"] = kSize;
      request["settings"].update(more);
      request["settings"][name] = setting.capability.probe;
      if (!device.is_null()) request.update(device);
      if (!drawn_alike(request)) continue;
      any = true;
      ++frames;
    }
    settings += any ? 1 : 0;
  }
  std::printf("[figure] settings = %zu of %zu (limit >= 40), frames alike = %zu (limit >= 100)\n", settings,
              scene::settings().size(), frames);
  EXPECT_GE(settings, 40U);
  EXPECT_GE(frames, 100U);
}

TEST_F(LabCommand, DrawsTheSameForKernelsAndChangedDevices) {
  Json request = kScene;
  request["settings"] = kSize;
  request["kernel"] = "smooth";
  EXPECT_TRUE(drawn_alike(request));
  request["settings"]["kernel.radius"] = "1.5";  // its a stays that of "smooth"
  EXPECT_TRUE(drawn_alike(request));
  request["tf"] = "linear";
  request["changes"] = {"radial.entries=64", "pixel.frac_bits=9"};
  EXPECT_TRUE(drawn_alike(request));
}

TEST_F(LabCommand, DrawsTheSameOfGaussians) {
  const Json device = {"composite.every_sample=1", "composite.freeze_below=7"};
  std::size_t frames = 0;
  for (const Json& settings : std::vector<Json>{{{"camera.projection", "perspective"}},
                                                {{"camera.azimuth", "200"}, {"camera.zoom", "1.5"}},
                                                {{"camera.projection", "perspective"}, {"camera.fov", "50"}},
                                                {{"gaussians.up", "-x"}, {"gaussians.cutoff", "2"}},
                                                {{"gaussians.low_pass", "1.5"}, {"slabs.width", "2"}}}) {
    for (const char* name : {"shells:300", "cloud:200"}) {
      Json request{{"ask", "frame"}, {"gaussians", name}, {"settings", kSize}, {"config", "ellipse"}};
      request["settings"].update(settings);
      request["changes"] = device;
      EXPECT_TRUE(drawn_alike(request)) << request;
      ++frames;
    }
  }
  std::printf("[figure] frames of Gaussians alike = %zu (limit 10)\n", frames);
}

// A link in the forms that a user has: the whole address, its part from # on, a report's with a scene.toml.
TEST_F(LabCommand, OfALinkIsThePages) {
  const std::vector<std::string> links{
      "#lab?volume=shells:24&config=base&size=40x32",
      "file:///lab.html#lab?volume=shells%3A24&config=tiny&size=40x32&tf=linear&kernel=smooth"
      "&s.camera.azimuth=77&s.camera.projection=perspective&k.pixel.frac_bits=9&view=mode%3Dside",
      "#lab?config=base&scene=volume+%3D+%22shells%3A24%22%0A%5Bimage%5D%0Awidth+%3D+40%0Aheight+%3D+32%0A"
      "%5Bcamera%5D%0Aelevation+%3D+-20.5%0A%5Bslabs%5D%0Awidth+%3D+2.0%0A"};
  for (const std::string& link : links) {
    const auto run = cli_test::fastsplat({"lab", "--print", link});
    cli_test::expect_success(run);
    const Json request = lab::request_of_state(lab::state_of_link(link));
    const lab::Answer answer = session_.answer(request.dump());
    const Json json = Json::parse(answer.json);
    ASSERT_TRUE(json.contains("words_hash")) << answer.json.substr(0, 300);
    EXPECT_EQ(run.out, json["command"].get<std::string>() + "\n");
    expect_words(json["command"], answer.pictures.at(1));
  }
  // A report's link has the name of a changed configuration.
  const Json named = lab::state_of_link("#lab?config=tiny%2Bradial.entries%3D32%2Bpixel.frac_bits%3D4");
  EXPECT_EQ(named["config"], "tiny");
  EXPECT_EQ(named["changes"], (Json{{"radial.entries", "32"}, {"pixel.frac_bits", "4"}}));
  const Json scene = lab::state_of_link(links[2]);
  EXPECT_EQ(scene["settings"], (Json{{"camera.elevation", "-20.5"}, {"slabs.width", "2.0"}}));
  cli_test::expect_error(cli_test::fastsplat({"lab", "--print", "#pictures?x=1"}), 2, {"not an address of the lab"});
  cli_test::expect_error(cli_test::fastsplat({"lab"}), 2, {"--print LINK"});
}

TEST_F(LabCommand, ALinkToGaussiansHasTheirView) {
  scene::GaussianDescription description;
  description.camera.azimuth = 33.5, description.camera.projection = scene::Projection::Perspective;
  description.width = 40, description.height = 32, description.up = scene::UpAxis::Z, description.cutoff = 2.0;
  const auto link = [&](const scene::GaussianDescription& of, bool cropped) {
    scene::GaussianCloud cloud = scene::load_gaussians("cloud:50");
    cloud.cropped = cropped;
    return lab::link_of_gaussians(scene::build_gaussian_scene(of, std::make_shared<scene::GaussianCloud>(cloud)));
  };
  const Json state = lab::state_of_link("#lab?" + link(description, false));
  EXPECT_FALSE(state.contains("ignored")) << state;
  EXPECT_EQ(state["gaussians"], "cloud:50");
  EXPECT_EQ(state["width"], 40);
  EXPECT_EQ(state["settings"]["camera.azimuth"], "33.5");
  EXPECT_EQ(state["settings"]["gaussians.up"], "z");
  EXPECT_EQ(state["settings"]["gaussians.cutoff"], "2");
  // The page has neither.
  EXPECT_EQ(link(description, true), "");
  description.order = scene::GaussianSort::Distance;
  EXPECT_EQ(link(description, false), "");
  const Json odd = lab::state_of_link("#lab?size=0x99&k.nonsense=3&config=tiny");
  EXPECT_EQ(odd["ignored"], (Json{"k.nonsense=3", "size=0x99"}));
  EXPECT_NE(cli_test::fastsplat({"lab", "--print", "#lab?k.nonsense=3"}).err.find("k.nonsense=3"), std::string::npos);
}

TEST_F(LabCommand, OfALinkWithFilesWritesThem) {
  Json request = kScene;
  request["ask"] = "config", request["config"] = "tiny";
  const std::string device = Json::parse(session_.answer(request.dump()).json)["toml"];
  const std::string tf =
      "points = [{at = 0.1, colour = [1.0, 0.2, 0.1], opacity = 0.0}, {at = 0.9, colour = [0.1, 0.9, 1.0], opacity = "
      "0.6}]\n";
  const auto encoded = [](const std::string& text) {
    std::string out;
    for (const unsigned char c : text) out += fmt::format("%{:02X}", c);
    return out;
  };
  const std::string link =
      "#lab?volume=shells:24&size=40x32&tf_toml=" + encoded(tf) + "&toml=" + encoded(device) + "&k.pixel.frac_bits=9";
  const auto told = cli_test::fastsplat({"lab", "--print", link}, here());
  EXPECT_NE(told.err.find("tf.toml; use --files"), std::string::npos) << told.err;
  EXPECT_TRUE(folder_.entries().empty());
  const auto run = cli_test::fastsplat({"lab", "--print", link, "--files", "."}, here());
  cli_test::expect_success(run);
  EXPECT_EQ(folder_.entries(), (std::vector<std::string>{"mine.toml", "tf.toml"}));
  Json page = lab::request_of_state(lab::state_of_link(link));
  page["tf"] = folder_ / "tf.toml";
  const lab::Answer answer = session_.answer(page.dump());
  ASSERT_EQ(answer.pictures.size(), 2U) << answer.json.substr(0, 300);
  expect_words(run.out.substr(0, run.out.size() - 1), answer.pictures[1]);
}

}  // namespace
}  // namespace fastsplat
