// SPDX-License-Identifier: Apache-2.0
// The command that the lab shows draws the words that the lab shows: for every setting and for changed devices.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/images/image_file.hpp"
#include "lab/session.hpp"
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
    const auto file = std::filesystem::path(testing::TempDir()) / "lab-command.exr";
    auto line = json["command"].get<std::string>();
    const std::string out = " --out device.exr", name = "fastsplat ";
    EXPECT_TRUE(line.starts_with(name) && line.ends_with(out)) << line;
    line = line.substr(name.size(), line.size() - name.size() - out.size()) + " -o '" + file.string() + "' --quiet";
    const auto run = cli_test::run_words({"sh", "-c", "exec '" + cli_test::program() + "' " + line});
    EXPECT_EQ(run.code, 0) << line << "\n" << run.err;
    if (run.code != 0) return true;
    const Image image = images::read_image(file).image;
    const lab::Words& words = answer.pictures.at(1);
    EXPECT_EQ(image.data.size(), words.words.size()) << line;
    std::size_t differ = 0;
    for (std::size_t i = 0; i < std::min(image.data.size(), words.words.size()); ++i)
      differ += std::ldexp(image.data[i], std::countr_zero(static_cast<std::uint64_t>(words.scale))) != words.words[i];
    EXPECT_EQ(differ, 0U) << line;
    return true;
  }

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

}  // namespace
}  // namespace fastsplat
