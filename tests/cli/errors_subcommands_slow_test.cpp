// SPDX-License-Identifier: Apache-2.0
// fastsplat errors ranges, errors propose and pixel as a user runs them: their output, files and refusals.
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>

#include "base/images/image_file.hpp"
#include "tests/cli/words_helper.hpp"
#include "tests/paths.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

using Json = nlohmann::json;

const Words kRanges{"errors", "ranges"}, kPropose{"errors", "propose", "--target", "psnr>=40"};

TEST(ErrorsRanges, SuggestsFormatsAndAgreesWithTheDevicesCounters) {
  const TempFolder folder;
  const auto result = fastsplat(with(kRanges, with(kSmall, {"--config", "tiny", "--json", folder / "r.json"})));
  expect_success(result);
  EXPECT_NE(result.out.find("would suffice: "), std::string::npos) << result.out;
  const Json json = Json::parse(read_bytes(folder / "r.json"));
  EXPECT_EQ(json.at("schema"), "fastsplat.ranges/1");
  const auto rendered = fastsplat(with({"render", "--engine", "cmodel", "--config", "tiny", "-o", folder / "a.exr",
                                        "--quiet", "--json", folder / "a.json"},
                                       kSmall));
  expect_success(rendered);
  EXPECT_EQ(json.at("counters"), Json::parse(read_bytes(folder / "a.json")).at("counters"));
  int sites = 0;
  for (const Json& site : json.at("sites")) {
    std::uint64_t values = site.at("zeros").get<std::uint64_t>();
    for (const Json& bin : site.at("histogram")) values += bin.at("values").get<std::uint64_t>();
    EXPECT_EQ(values, site.at("values").get<std::uint64_t>()) << site.at("site");
    ++sites;
  }
  std::printf("[figure] sites listed = %d (limit >= 9)\n", sites);
  EXPECT_GE(sites, 9);
}

TEST(ErrorsRanges, MergesScenes) {
  const TempFolder folder;
  const auto a = folder.write("a.toml", "volume = \"shells:12\"\n");
  const auto one = fastsplat(with(kRanges, {"--scenes", a, "--size", "24", "--json", "-", "--quiet"}));
  expect_success(one);
  const auto b = folder.write("b.toml", read_bytes(a));
  const auto two = fastsplat(with(kRanges, {"--scenes", a + "," + b, "--size", "24", "--json", "-", "--quiet"}));
  expect_success(two);
  const Json single = Json::parse(one.out), both = Json::parse(two.out);
  ASSERT_EQ(both.at("scenes").size(), 2u);
  for (std::size_t i = 0; i < single.at("sites").size(); ++i) {
    EXPECT_EQ(2 * single.at("sites")[i].at("values").get<std::uint64_t>(),
              both.at("sites")[i].at("values").get<std::uint64_t>());
    EXPECT_EQ(single.at("sites")[i].at("lost"), both.at("sites")[i].at("lost"));
  }
  EXPECT_EQ(single.at("needs"), both.at("needs"));
}

TEST(ErrorsPropose, WritesAConfigurationThatIsSoundAndResumes) {
  const TempFolder folder;
  const Words words = with(kPropose, with(kSmall, {"-o", folder / "p.toml", "--journal", folder / "j.jsonl"}));
  const auto first = fastsplat(with(words, {"--json", folder / "p.json"}));
  expect_success(first);
  expect_success(fastsplat({"config", "check", folder / "p.toml"}));
  const std::string bytes = read_bytes(folder / "p.toml"), journal = read_bytes(folder / "j.jsonl");
  const Json json = Json::parse(read_bytes(folder / "p.json"));
  EXPECT_TRUE(json.at("met").get<bool>());
  EXPECT_GE(json.at("error").at("psnr_db").get<double>(), 40.0);
  const auto again = fastsplat(words);
  expect_success(again);
  EXPECT_NE(again.out.find(" 0 frames simulated"), std::string::npos) << again.out;
  EXPECT_EQ(read_bytes(folder / "p.toml"), bytes);
  EXPECT_EQ(read_bytes(folder / "j.jsonl"), journal);
  // The proposed device, by the program's own compare.
  expect_success(fastsplat(with({"render", "-o", folder / "g.exr", "--quiet"}, kSmall)));
  expect_success(fastsplat(with(
      {"render", "--engine", "cmodel", "--config", folder / "p.toml", "-o", folder / "d.exr", "--quiet"}, kSmall)));
  expect_success(fastsplat({"compare", folder / "g.exr", folder / "d.exr", "--min-psnr", "40"}));
}

TEST(ErrorsPropose, FramesASecondOfTheResultAreThoseThatCyclesCounts) {
  const TempFolder folder;
  const Words scene{"--volume", "shells:16", "--size", "96"};  // two devices
  const auto told = fastsplat(with(kPropose, with(scene, {"--target", "fps>=1200", "--clock", "100", "-o",
                                                          folder / "p.toml", "--json", folder / "p.json"})));
  expect_success(told);
  const Json speed = Json::parse(read_bytes(folder / "p.json")).at("speed"), &best = speed.at("proposed");
  Words words{"cycles",  "--config", folder / "p.toml", "--devices",      best.at("devices").dump(),
              "--clock", "100",      "--json",          folder / "c.json"};
  if (best.at("cull_map") != "off") words = with(words, {"--fetch", "40"});
  expect_success(fastsplat(with(words, scene)));
  const Json scaling = Json::parse(read_bytes(folder / "c.json")).at("scaling");
  EXPECT_EQ(scaling.at("frame_cycles"), best.at("cycles").at(0));
  EXPECT_EQ(scaling.at("fps"), best.at("fps"));
  EXPECT_EQ(scaling.at("milliseconds"), best.at("milliseconds"));
  EXPECT_GE(scaling.at("fps").get<double>(), 1200.0);
  ASSERT_EQ(speed.at("others").size(), 2U);
  for (const auto& [other, rate] : {std::pair{0, 600.0}, {1, 2400.0}}) {
    EXPECT_EQ(speed.at("others")[other].at("target_fps"), rate);
    EXPECT_GE(speed.at("others")[other].at("fps"), rate);
  }
  const int number = best.at("devices");
  EXPECT_EQ(number, 2);
  /// The first numbers behind a text of the output.
  const auto numbers = [&](const std::string& behind, std::size_t count) {
    const auto place = told.out.find(behind);
    std::istringstream rest(place == std::string::npos ? "" : told.out.substr(place + behind.size()));
    std::vector<double> out(count, -1.0);
    for (double& each : out) rest >> each;
    return out;
  };
  const auto rates = numbers("fps  scene\n", 3);
  std::printf("[figure] printed: %.0f cycles, %.3f ms, %.2f fps\n", rates[0], rates[1], rates[2]);
  EXPECT_EQ(rates[0], scaling.at("frame_cycles"));
  EXPECT_NEAR(rates[1], scaling.at("milliseconds"), 0.0005);
  EXPECT_NEAR(rates[2], scaling.at("fps"), 0.005);
  // Areas are those of the configuration, times the devices, rounded to whole cells.
  for (const auto& [row, config] :
       {std::pair<std::string, std::string>{"from", "base"}, {"proposed", folder / "p.toml"}}) {
    const Json area = Json::parse(fastsplat({"config", "show", config, "--json", "-"}).out).at("area");
    const double devices = speed.at(row).at("devices");
    const auto printed = numbers("\n" + row + " ", 6);
    std::printf("[figure] %s: %.0f devices, %.0f LUT, %.0f RAMB36\n", row.c_str(), printed[0], printed[1], printed[3]);
    EXPECT_EQ(printed[0], devices) << row;
    int place = 0;
    for (const auto& [key, of_one] : {std::pair{"lut", area.at("lut").get<double>()},
                                      {"ff", area.at("ff")},
                                      {"ramb36", area.at("half_bram").get<double>() / 2},
                                      {"dsp", area.at("dsp")},
                                      {"equivalent_luts", area.at("equivalent_luts")}}) {
      EXPECT_NEAR(speed.at(row).at("area").at(key), devices * of_one, 0.5 * devices) << row << " " << key;
      EXPECT_NEAR(printed[++place], speed.at(row).at("area").at(key), 0.5) << row << " " << key;
    }
  }
  const std::string devices = std::to_string(number) + (number == 1 ? " device" : " devices");
  EXPECT_NE(told.out.find(" fps with " + devices), std::string::npos) << told.out;
  const auto page = fastsplat({"report", folder / "p.json", "-o", folder / "p.html"});
  EXPECT_NE((page.out + page.err).find("psnr>=40, fps>=1200 is met by " + devices), std::string::npos) << page.out;
}

TEST(ErrorsPropose, CtrlCLeavesAJournalThatIsGoneOnWith) {
  const TempFolder folder;
  const Words words{"errors", "propose", "--target", "psnr>=45",        "--volume",  "shells:24",
                    "--size", "48",      "-o",       folder / "p.toml", "--journal", folder / "j.jsonl"};
  Surroundings interrupted;
  interrupted.signal = SIGINT;
  interrupted.when = [&](pid_t) {
    return std::filesystem::exists(folder / "j.jsonl") && read_bytes(folder / "j.jsonl").size() > 1000;
  };
  const auto result = fastsplat(words, interrupted);
  EXPECT_EQ(result.code, 130) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "p.toml"));
  const std::string journal = read_bytes(folder / "j.jsonl");
  ASSERT_GT(journal.size(), 1000u);
  EXPECT_EQ(journal.back(), '\n') << "lines are written whole";
  const auto resumed = fastsplat(with(words, {"--quiet", "--json", "-"}));
  expect_success(resumed);
  const auto kept = std::count(journal.begin(), journal.end(), '\n') - 1;
  EXPECT_GE(Json::parse(resumed.out).at("recalled").get<long>(), kept);
  EXPECT_TRUE(read_bytes(folder / "j.jsonl").starts_with(journal.substr(0, journal.rfind('\n') + 1)));
  std::printf("[figure] journal at Ctrl-C = %zu bytes\n", journal.size());
}

TEST(ErrorsPropose, AnUnreachableTargetIsExit1AndWritesNothing) {
  const TempFolder folder;
  const auto result = fastsplat(with({"errors", "propose", "--target", "psnr>=250", "-o", folder / "p.toml"}, kSmall));
  EXPECT_EQ(result.code, 1) << result.err;
  EXPECT_NE(result.out.find("psnr>=250 is not met: the best result is PSNR "), std::string::npos) << result.out;
  EXPECT_TRUE(folder.entries().empty());
}

TEST(ErrorsPropose, BadInputIsOneLine) {
  const TempFolder folder;
  const auto no_config = folder.write("c.toml", "name = 3\n"), no_journal = folder.write("j.jsonl", "hello\n");
  const auto refused = [&](const Words& words, int code, const Words& said) {
    SCOPED_TRACE(
        std::accumulate(words.begin(), words.end(), std::string{}, [](auto a, auto& b) { return a + " " + b; }));
    const auto before = folder.entries();
    expect_error(fastsplat(words), code, said);
    EXPECT_EQ(folder.entries(), before);
  };
  const Words propose{"errors", "propose"};
  refused(with(propose, kSmall), 2, {"--target"});
  refused(with(propose, {"--target", "good"}), 2, {"--target", "not a target", "'good'", "psnr>="});
  refused(with(propose, {"--target", "psnr>=high"}), 2, {"--target", "not a number"});
  refused(with(propose, {"--target", "max<=-1"}), 2, {"--target", "above 0"});
  refused(with(kPropose, with(kSmall, {"--target", "psnr>=50"})), 2, {"--target", "a second target", "'psnr>=50'"});
  refused(with(kPropose, with(kSmall, {"--target", "fps>=60"})), 2, {"--clock", "is needed", "--clock 200"});
  refused(with(kPropose, with(kSmall, {"--clock", "200"})), 2, {"--clock", "fps>=RATE"});
  refused(with(kPropose, {"--scenes", "demo:nonsuch"}), 2, {"nonsuch", "fire"});
  refused(with(kPropose, {"--scenes", folder / "none.toml"}), 3, {"none.toml"});
  refused(with(kPropose, {"--scenes", "demo:fire,,demo:fire"}), 2, {"--scenes", "empty"});
  refused(with(kPropose, {"--scenes", "demo:fire,demo:fire"}), 2, {"--scenes", "twice"});
  refused(with(kPropose, {"--scene", "demo:fire", "--scenes", "demo:fire"}), 2, {"--scenes"});
  refused(with(kPropose, with(kSmall, {"--method", "raycast"})), 2, {"raycast"});
  refused(with(kPropose, with(kSmall, {"--from", "bose"})), 2, {"bose", "base"});
  refused(with(kPropose, with(kSmall, {"--from", no_config})), 3, {"c.toml"});
  const auto linear = folder.write("linear.toml", read_bytes(std::string(FASTSPLAT_SOURCE_DIR) + "/configs/base.toml") +
                                                      "[index]\nkind = \"linear\"\n");
  refused(with(kPropose, with(kSmall, {"--from", linear})), 2, {"index.kind = rlut", "linear", "family"});
  refused(with(kPropose, with(kSmall, {"--journal", no_journal})), 3, {"j.jsonl:1", "journal"});
  refused(with(kPropose, with(kSmall, {"-o", folder / "no/p.toml"})), 3, {"no/p.toml"});
  refused(with(kPropose, with(kSmall, {"-o", folder / "x", "--journal", folder / "x"})), 2,
          {"the same name for two outputs"});
  refused(with(kRanges, {"--scenes", "demo:nonsuch"}), 2, {"nonsuch", "fire"});
  refused(with(kRanges, with(kSmall, {"--method", "raycast"})), 2, {"raycast"});
  refused(with(kRanges, with(kSmall, {"--config", "bose"})), 2, {"bose", "base"});
}

// The words are those of `render --raw`; every sheet, splat and step of the pixel is in the JSON.
TEST(Pixel, AgreesWithThePicture) {
  const TempFolder folder;
  const Words device{"--config", "tiny", "--quiet"};
  const auto pixel = fastsplat(with({"pixel", "9,11", "--json", folder / "p.json"}, with(kSmall, device)));
  expect_success(pixel);
  const Json json = Json::parse(read_bytes(folder / "p.json"));
  EXPECT_EQ(json.at("schema"), "fastsplat.pixel/1");
  expect_success(fastsplat(with({"render", "--engine", "cmodel", "-o", folder / "a.exr"}, with(kSmall, device))));
  const auto picture = images::read_image(folder / "a.exr").image;
  int compared = 0;
  for (const char* channel : {"R", "G", "B", "A"}) {
    EXPECT_EQ(json.at("pixel").at(channel).at("device").get<float>(), picture.pixel(9, 11)[compared]) << channel;
    ++compared;
  }
  double sum = 0.0;
  for (const Json& step : json.at("steps")) sum += step.at("error_lsb8")[3].get<double>();
  EXPECT_NEAR(sum, json.at("error_lsb8")[3].get<double>(), 1e-12);
  std::printf("[figure] channels %d, splats %zu, sheets %zu\n", compared, json.at("splats").size(),
              json.at("sheets").size());
  EXPECT_GT(json.at("splats").size(), 3U);
  EXPECT_GT(json.at("sheets").size(), 3U);
}

// The same of 3-D Gaussians, and `errors` finds the picture's error.
TEST(Pixel, OfGaussiansAgreesWithThePicture) {
  const TempFolder folder;
  const Words view{"--gaussians", "shells:300", "--size", "48x40", "--quiet"};
  expect_success(fastsplat(with({"pixel", "22,19", "--json", folder / "p.json"}, view)));
  const Json json = Json::parse(read_bytes(folder / "p.json"));
  expect_success(fastsplat(with({"render", "--engine", "cmodel", "-o", folder / "a.exr"}, view)));
  expect_success(fastsplat(with({"render", "-o", folder / "g.exr"}, view)));
  const auto device = images::read_image(folder / "a.exr").image, golden = images::read_image(folder / "g.exr").image;
  int compared = 0;
  for (const char* channel : {"R", "G", "B", "A"}) {
    EXPECT_EQ(json.at("pixel").at(channel).at("device").get<float>(), device.pixel(22, 19)[compared]) << channel;
    EXPECT_NEAR(json.at("pixel").at(channel).at("real").get<double>(), golden.pixel(22, 19)[compared], 1e-7) << channel;
    ++compared;
  }
  EXPECT_GT(json.at("splats").size(), 3U);
  EXPECT_EQ(json.at("splats").size(), json.at("sheets").size());

  expect_success(fastsplat(with({"errors", "--quick", "--json", folder / "e.json", "--maps", folder / "m"}, view)));
  const Json errors = Json::parse(read_bytes(folder / "e.json"));
  double square = 0.0;
  for (std::size_t i = 0; i < device.data.size(); ++i)
    square += std::pow(static_cast<double>(device.data[i]) - golden.data[i], 2.0);
  const double rms = std::sqrt(square / static_cast<double>(device.data.size())) * 255.0;
  std::printf("[figure] channels %d, Gaussians %zu, RMS of errors %.6f, of the pictures %.6f LSB8\n", compared,
              json.at("splats").size(), errors.at("total").at("rms_lsb8").get<double>(), rms);
  EXPECT_NEAR(errors.at("total").at("rms_lsb8").get<double>(), rms, 1e-5);
  EXPECT_EQ(errors.at("steps").size(), 11U);
  EXPECT_EQ(images::read_image(folder / "m.index.exr").image.width, 48);
}

TEST(Pixel, RefusesWhatIsNoPixel) {
  for (const auto& [place, line] : {std::pair{"12", "expected X,Y, two whole numbers, got '12'"},
                                    {"1.5,2", "expected X,Y, two whole numbers, got '1.5,2'"},
                                    {"24,0", "expected 0,0 to 23,23, got 24,0"}}) {
    const auto result = fastsplat(with({"pixel", place, "--config", "tiny"}, kSmall));
    expect_error(result, 2, {line});
  }
  expect_error(fastsplat(with({"pixel", "9,11", "--config", "tiny", "--sheet", "900"}, kSmall)), 2,
               {"--sheet: no splat of the pixel is in this sheet", "got 900"});
  const Words view{"--gaussians", "shells:300", "--size", "48x40"};
  expect_error(fastsplat(with({"pixel", "22,19", "--sheet", "900"}, view)), 2,
               {"--sheet: this Gaussian has no sample at the pixel", "got 900"});
  expect_error(fastsplat(with({"errors", "--order", "pixels"}, view)), 2, {"--order", "leave it out"});
  expect_error(fastsplat(with({"errors", "--config", "base"}, view)), 2, {"base", "composite.every_sample"});
  expect_error(fastsplat(with({"errors", "--up", "z"}, kSmall)), 2, {"--up", "without 3-D Gaussians"});
}

}  // namespace
}  // namespace fastsplat::cli_test
