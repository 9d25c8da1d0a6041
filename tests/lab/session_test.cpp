// SPDX-License-Identifier: Apache-2.0
// The lab's engine answers as the libraries behind it do, in one line where it cannot, and never from a stale scene.
#include "lab/session.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "analysis/compare.hpp"
#include "analysis/errors/pixel_report.hpp"
#include "analysis/pipeline/chain.hpp"
#include "base/fnv1a.hpp"
#include "base/hash_text.hpp"
#include "cmodel/numbers/config.hpp"
#include "driver/config/changed.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/gaussian_frame.hpp"
#include "driver/tiles/render.hpp"
#include "golden/gaussians.hpp"
#include "golden/render.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/settings.hpp"

namespace fastsplat {
namespace {

using Json = nlohmann::ordered_json;

const Json kSmall{{"image.width", "40"}, {"image.height", "32"}};

Json request(const std::string& ask, Json settings = kSmall, const std::string& config = "base") {
  return {{"ask", ask}, {"volume", "shells:24"}, {"settings", std::move(settings)}, {"config", config}};
}

Json with(Json settings, const std::string& name, const std::string& value) {
  settings[name] = value;
  return settings;
}

TEST(LabSession, TablesHoldEverySettingAndKey) {
  lab::Session session;
  const Json tables = Json::parse(session.answer(R"({"ask":"tables"})").json);
  EXPECT_EQ(tables["settings"].size(), scene::settings().size());
  EXPECT_EQ(tables["keys"].size(), cmodel::config_keys().size());
  std::vector<std::string> configs;
  for (const auto& config : tables["configs"]) configs.push_back(config["name"]);
  EXPECT_EQ(configs, driver::config_names());
  // Every default is a valid text of its setting.
  std::size_t checked = 0;
  for (std::size_t i = 0; i < tables["settings"].size(); ++i) {
    const auto text = tables["settings"][i]["default"].get<std::string>();
    if (text.empty()) continue;  // the box: everything
    EXPECT_EQ(scene::problem_with(scene::settings()[i], text), "") << tables["settings"][i];
    ++checked;
  }
  std::printf("[figure] settings = %zu, defaults checked = %zu (limit all but one)\n", scene::settings().size(),
              checked);
  EXPECT_EQ(checked + 1, scene::settings().size());
}

TEST(LabSession, APictureOfGoldenAloneHasItsCommand) {
  lab::Session session;
  const Json frame = Json::parse(session.answer(request("frame", with(kSmall, "method", "raycast")).dump()).json);
  EXPECT_TRUE(frame.contains("device_error"));
  EXPECT_NE(frame["command"].get<std::string>().find("--method raycast --engine golden --out golden.exr"),
            std::string::npos)
      << frame["command"];
}

TEST(LabSession, AFrameIsTheDriversAndGoldens) {
  lab::Session session;
  std::size_t frames = 0;
  for (const char* config : {"base", "tiny", "ellipse"}) {
    for (const auto method : {scene::Method::ImageAligned, scene::Method::XRay}) {
      Json asked = request("frame", with(kSmall, "method", scene::to_string(method)), config);
      asked["changes"] = {"pixel.frac_bits=9"};
      const lab::Answer answer = session.answer(asked.dump());
      const Json json = Json::parse(answer.json);
      ASSERT_FALSE(json.contains("error")) << json["error"];
      ASSERT_EQ(answer.pictures.size(), 2U) << answer.json;

      scene::SceneDescription description;
      description.volume = "shells:24";
      description.width = 40, description.height = 32;
      description.method = method;
      const scene::Scene scene = scene::build_scene(description);
      const std::vector<std::string> changes{"pixel.frac_bits=9"};
      const auto drawn = driver::render(scene, driver::changed(driver::load_config(config), changes));
      const auto& words = answer.pictures[1].words;
      EXPECT_TRUE(std::equal(words.begin(), words.end(), drawn.frame.words.begin(), drawn.frame.words.end(),
                             [](std::int32_t a, std::uint32_t b) { return static_cast<std::uint32_t>(a) == b; }));
      EXPECT_EQ(answer.pictures[1].int_bits, drawn.frame.int_bits);
      EXPECT_EQ(answer.pictures[1].scale, std::int64_t{1} << drawn.frame.frac_bits);
      std::uint64_t hash = kFnv1aStart;
      for (const std::uint32_t word : drawn.frame.words) hash = fnv1a(hash, std::uint64_t{word});
      EXPECT_EQ(json["words_hash"], hash_text(hash));
      const auto report = analysis::compare(golden::render(scene), driver::to_image(drawn.frame));
      EXPECT_EQ(json["compare"], Json::parse(analysis::to_json(report)));
      ++frames;
    }
  }
  std::printf("[figure] frames equal = %zu (limit 6)\n", frames);
}

TEST(LabSession, AFrameOfGaussiansIsTheDriversAndGoldens) {
  lab::Session session;
  Json asked = request("frame", with(kSmall, "camera.projection", "perspective"), "ellipse");
  asked["gaussians"] = "shells:300";
  asked["changes"] = {"composite.every_sample=1", "composite.freeze_below=7"};
  const lab::Answer answer = session.answer(asked.dump());
  const Json json = Json::parse(answer.json);
  ASSERT_TRUE(json.contains("words_hash")) << answer.json.substr(0, 300);

  scene::GaussianDescription view;
  view.width = 40, view.height = 32;
  view.up = scene::UpAxis::Z;
  view.camera.projection = scene::Projection::Perspective;
  const auto scene =
      scene::build_gaussian_scene(view, std::make_shared<scene::GaussianCloud>(scene::load_gaussians("shells:300")));
  const auto projected = scene::project_all(scene);
  const std::vector<std::string> changes{"composite.every_sample=1", "composite.freeze_below=7"};
  const driver::GaussianFrame frame(scene, projected, driver::changed(driver::load_config("ellipse"), changes));
  const auto drawn = driver::render_gaussians(frame);
  EXPECT_TRUE(std::equal(drawn.frame.words.begin(), drawn.frame.words.end(), answer.pictures[1].words.begin(),
                         answer.pictures[1].words.end(),
                         [](std::uint32_t a, std::int32_t b) { return a == static_cast<std::uint32_t>(b); }));
  const auto report = analysis::compare(golden::render_gaussians(scene, projected), driver::to_image(drawn.frame));
  EXPECT_EQ(json["compare"], Json::parse(analysis::to_json(report)));
  EXPECT_EQ(json["records"], drawn.report.records);
  EXPECT_TRUE(answer.pictures[0].encoded && answer.pictures[1].encoded);
  EXPECT_TRUE(json["idle"].empty()) << json["idle"];

  asked["settings"]["slabs.width"] = "3";
  EXPECT_EQ(Json::parse(session.answer(asked.dump()).json)["idle"]["slabs.width"], "has no effect on 3-D Gaussians");
  asked["ask"] = "cycles";
  const Json cycles = Json::parse(session.answer(asked.dump()).json);
  std::uint64_t bytes = 0;
  frame.emit([&](std::span<const cmodel::Beat> beats) { bytes += beats.size_bytes(); });
  EXPECT_EQ(cycles["bytes_in"], bytes) << cycles;
  // Back to a volume: nothing of the Gaussians stays.
  const Json after = Json::parse(session.answer(request("frame").dump()).json);
  EXPECT_EQ(after["words_hash"], Json::parse(lab::Session().answer(request("frame").dump()).json)["words_hash"]);
}

TEST(LabSession, IdleSettingsAreLeftOutWithTheirReason) {
  lab::Session session;
  const Json plain = Json::parse(session.answer(request("frame", with(kSmall, "method", "xray")).dump()).json);
  const Json idle = Json::parse(
      session.answer(request("frame", with(with(kSmall, "method", "xray"), "slabs.width", "3")).dump()).json);
  EXPECT_EQ(idle["words_hash"], plain["words_hash"]);
  ASSERT_TRUE(idle["idle"].contains("slabs.width"));
  EXPECT_NE(idle["idle"]["slabs.width"].get<std::string>().find("has no slabs"), std::string::npos);
  EXPECT_EQ(idle["command"].get<std::string>().find("--slab-width"), std::string::npos);
  EXPECT_EQ(plain["idle"], Json::object());
}

TEST(LabSession, EverySettingAtItsDefaultChangesNothing) {
  lab::Session session;
  const Json tables = Json::parse(session.answer(R"({"ask":"tables"})").json);
  Json all = kSmall;
  for (const auto& setting : tables["settings"]) {
    const auto name = setting["name"].get<std::string>();
    if (all.contains(name) || name.starts_with("kernel.") || name == "crop") continue;
    all[name] = setting["default"];
  }
  const Json plain = Json::parse(session.answer(request("frame").dump()).json);
  const Json given = Json::parse(session.answer(request("frame", all).dump()).json);
  ASSERT_FALSE(given.contains("error")) << given["error"];
  EXPECT_EQ(given["words_hash"], plain["words_hash"]);
  EXPECT_EQ(given["command"], plain["command"]);
}

TEST(LabSession, WhatIsKeptNeverShows) {
  lab::Session session;
  std::size_t asked = 0;
  // Back and forth between volumes, scenes and devices, against a session that has seen nothing.
  for (const char* order : {"abab", "aabbca", "cbacbd", "ddabcd"}) {
    for (const char one : std::string(order)) {
      Json json = request(asked % 3 == 2 ? "pixel" : "frame");
      if (one == 'b') json["settings"]["camera.azimuth"] = "10";
      if (one == 'c') json["volume"] = "marschner-lobb:20";
      if (one == 'd') json["config"] = "tiny";
      json["x"] = 20, json["y"] = 15;
      EXPECT_EQ(session.answer(json.dump()).json, lab::Session().answer(json.dump()).json) << json;
      ++asked;
    }
  }
  std::printf("[figure] answers equal to a fresh session's = %zu (limit 20)\n", asked);
}

TEST(LabSession, BadRequestsAreOneLineAndTheSessionGoesOn) {
  lab::Session session;
  const std::vector<std::pair<std::string, std::string>> bad{
      {"", "parse error"},
      {"{}", "ask"},
      {R"({"ask":"dance"})", "unknown request"},
      {R"({"ask":"frame","config":"nothing"})", "no such configuration"},
      {R"({"ask":"frame","volume":"nothing.nrrd"})", "nothing.nrrd"},
      {R"({"ask":"frame","volume":"shells:1024"})", "too large for a page"},
      {R"({"ask":"frame","settings":{"camera.azimut":"3"}})", "camera.azimuth"},
      {R"({"ask":"frame","gaussians":"shells:9000000"})", "too large for a page"},
      {R"({"ask":"frame","gaussians":"nothing.ply"})", "nothing.ply"},
      {R"({"ask":"frame","gaussians":"shells:9","settings":{"gaussians.cutoff":"9"}})", "--cutoff"},
      {R"({"ask":"frame","gaussians":"shells:9","settings":{"gaussians.up":"w"}})", "unknown axis"},
      {R"({"ask":"terminated","gaussians":"shells:9"})", "volumes only"},
      {R"({"ask":"frame","settings":{"camera.azimuth":"east"}})", "expected a finite number, got 'east'"},
      {R"({"ask":"frame","changes":["tile.width=7"]})", "tile.width"},
      {R"({"ask":"frame","toml":"x = 1"})", "configuration:1"},
      {R"({"ask":"pixel","volume":"shells:16","settings":{"image.width":"8","image.height":"8"},"x":99,"y":0})", "99"},
      {R"({"ask":"frame","settings":{"camera.azimuth":3}})", "string"},
  };
  for (const auto& [text, part] : bad) {
    const lab::Answer answer = session.answer(text);
    const Json json = Json::parse(answer.json);
    ASSERT_TRUE(json.contains("error")) << text;
    const auto line = json["error"].get<std::string>();
    EXPECT_NE(line.find(part), std::string::npos) << text << " gave: " << line;
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_TRUE(answer.pictures.empty());
    EXPECT_TRUE(Json::parse(session.answer(request("frame").dump()).json).contains("words_hash")) << "after " << text;
  }
  std::printf("[figure] refused in one line = %zu (limit 17)\n", bad.size());
}

TEST(LabSession, EverySettingOfGaussiansMakesANewView) {
  lab::Session session;
  Json plain = request("frame", with(kSmall, "camera.projection", "perspective"), "ellipse");
  plain["gaussians"] = "shells:200";
  plain["changes"] = {"composite.every_sample=1", "composite.freeze_below=7"};
  for (const auto& [name, value] :
       std::vector<std::pair<std::string, std::string>>{{"camera.azimuth", "10"},
                                                        {"camera.elevation", "40"},
                                                        {"camera.roll", "9"},
                                                        {"camera.zoom", "2"},
                                                        {"camera.projection", "orthographic"},
                                                        {"camera.fov", "50"},
                                                        {"image.width", "44"},
                                                        {"image.height", "30"},
                                                        {"gaussians.up", "x"},
                                                        {"gaussians.low_pass", "2"},
                                                        {"gaussians.cutoff", "2"}}) {
    const Json before = Json::parse(session.answer(plain.dump()).json);
    Json other = plain;
    other["settings"][name] = value;
    const Json after = Json::parse(session.answer(other.dump()).json);
    EXPECT_NE(after["words_hash"], before["words_hash"]) << name;
    EXPECT_EQ(after, Json::parse(lab::Session().answer(other.dump()).json)) << name;
  }
}

TEST(LabSession, AFileOfGaussiansThatIsTooLargeIsRefusedUnread) {
  const auto file = std::filesystem::path(testing::TempDir()) / "lab-huge.splat";
  std::ofstream(file) << "x";
  std::filesystem::resize_file(file, 500'000'000);  // sparse
  Json asked = request("frame");
  asked["gaussians"] = file.string();
  const Json json = Json::parse(lab::Session().answer(asked.dump()).json);
  EXPECT_NE(json["error"].get<std::string>().find("too large for a page"), std::string::npos) << json;
  std::filesystem::remove(file);
}

TEST(LabSession, TheTransferFunctionAsAFileGivesTheSameWords) {
  std::size_t equal = 0;
  for (const char* preset : {"default", "mri-head", "binary", "linear"}) {
    lab::Session session;
    Json json = request("histogram");
    json["tf"] = preset;
    const Json histogram = Json::parse(session.answer(json.dump()).json);
    const auto file = std::filesystem::path(testing::TempDir()) / (std::string("lab-") + preset + ".toml");
    std::ofstream(file) << histogram["toml"].get<std::string>();
    json["ask"] = "frame";
    const Json named = Json::parse(session.answer(json.dump()).json);
    json["tf"] = file.string();
    const Json from_file = Json::parse(session.answer(json.dump()).json);
    ASSERT_TRUE(from_file.contains("words_hash")) << from_file.dump().substr(0, 300);
    EXPECT_EQ(from_file["words_hash"], named["words_hash"]) << preset;
    equal += from_file["words_hash"] == named["words_hash"] ? 1 : 0;
    std::filesystem::remove(file);
  }
  std::printf("[figure] presets equal as files = %zu (limit 4)\n", equal);
}

/// A pixel's trace, which the chain makes without the device model, ends in the sheet that terminates the pixel.
TEST(LabSession, TerminatedPixelsEndWhereTheirTracesDo) {
  lab::Session session;
  std::size_t compared = 0, terminated = 0;
  for (const char* changes : {"composite.freeze_below=200", "tile.width=16"}) {
    Json asked = request("terminated", {{"image.width", "20"}, {"image.height", "17"}, {"opacity_scale", "9"}}, "tiny");
    asked["changes"] = {changes};
    const lab::Answer answer = session.answer(asked.dump());
    const Json json = Json::parse(answer.json);
    ASSERT_FALSE(json.contains("error")) << json["error"];
    ASSERT_EQ(answer.pictures.size(), 1U);
    scene::SceneDescription description;
    description.volume = "shells:24";
    description.width = 20, description.height = 17;
    description.opacity_scale = 9.0;
    const scene::Scene scene = scene::build_scene(description);
    const std::vector<std::string> list{changes};
    const cmodel::Config config = driver::changed(driver::load_config("tiny"), list);
    const stages::Chain chain(scene, config);
    std::size_t here = 0;
    for (int y = 0; y < 17; ++y) {
      for (int x = 0; x < 20; ++x) {
        const auto trace = analysis::explain(chain, x, y, 1).device;
        const int wanted = trace.terminated ? trace.sheets.back().sheet + 1 : 0;
        EXPECT_EQ(answer.pictures[0].words[static_cast<std::size_t>(y * 20 + x)], wanted) << x << "," << y;
        ++compared;
        here += wanted > 0 ? 1 : 0;
      }
    }
    EXPECT_EQ(json["pixels"], here);
    EXPECT_EQ(json["last"].get<int>() + 1, answer.pictures[0].scale);
    terminated += here;
  }
  std::printf("[figure] pixels compared = %zu, terminated = %zu (limit >= 40)\n", compared, terminated);
  EXPECT_GE(terminated, 40U);
  const Json xray = Json::parse(session.answer(request("terminated", with(kSmall, "method", "xray")).dump()).json);
  EXPECT_EQ(xray["pixels"], 0) << xray;
}

TEST(LabSession, CyclesCostsAndHistogramAddUp) {
  lab::Session session;
  const Json cycles = Json::parse(session.answer(request("cycles").dump()).json);
  std::uint64_t sum = 0;
  for (const auto& [name, count] : cycles["account"].items()) sum += count.get<std::uint64_t>();
  EXPECT_EQ(sum, cycles["actual"].get<std::uint64_t>());
  EXPECT_GT(sum, 0U);
  scene::SceneDescription description;
  description.volume = "shells:24";
  description.width = 40, description.height = 32;
  const auto base = driver::load_config("base");
  const scene::Scene scene = scene::build_scene(description);
  const driver::CompiledFrame compiled(scene, base);
  std::uint64_t bytes = 0;
  compiled.emit([&](std::span<const cmodel::Beat> beats) { bytes += beats.size_bytes(); });
  EXPECT_EQ(cycles["bytes_in"], bytes);
  EXPECT_EQ(cycles["bytes_out"], 40 * 32 * 16);
  const Json histogram = Json::parse(session.answer(request("histogram").dump()).json);
  std::uint64_t voxels = 0;
  for (const auto& count : histogram["bins"]) voxels += count.get<std::uint64_t>();
  EXPECT_EQ(voxels, 24U * 24U * 24U);
  const Json config = Json::parse(session.answer(request("config").dump()).json);
  EXPECT_EQ(config["values"].size(), cmodel::config_keys().size());
  EXPECT_GT(config["cost"]["adder_bits"].get<double>(), 0.0) << config["cost"];
  std::printf("[figure] cycles = %llu, voxels counted = %llu\n", static_cast<unsigned long long>(sum),
              static_cast<unsigned long long>(voxels));
}

}  // namespace
}  // namespace fastsplat
