// SPDX-License-Identifier: Apache-2.0
// Animations: numbered frames of every engine, frames kept by a second run, files left by Ctrl-C, the video.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

using Json = nlohmann::json;

std::vector<std::string> turning(const std::vector<std::string>& more) {
  std::vector<std::string> all{"render", "--volume", "shells:12", "--size", "32", "--orbit", "0..90", "--frames", "4"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::map<std::string, std::string> contents(const TempFolder& folder) {
  std::map<std::string, std::string> all;
  for (const auto& name : folder.entries()) all[name] = read_bytes(folder / name);
  return all;
}

TEST(Animation, FramesEqualTheStillsOfEveryEngine) {
  int compared = 0;
  const std::vector<std::vector<std::string>> engines{
      {"--engine", "golden"}, {"--engine", "cmodel", "--config", "small"}, {"--engine", "rtl", "--config", "tiny"}};
  for (const auto& engine : engines) {
    const TempFolder folder;
    auto words = turning({"-o", folder / "f.##.exr", "-o", folder / "f.##.png"});
    words.insert(words.end(), engine.begin(), engine.end());
    expect_success(fastsplat(words));
    ASSERT_EQ(folder.entries().size(), 8u) << engine[1];
    for (int frame = 0; frame < 4; ++frame) {
      const std::string number = "0" + std::to_string(frame);
      std::vector<std::string> still{"render", "--volume", "shells:12", "--size", "32"};
      still.insert(still.end(), engine.begin(), engine.end());
      still.insert(still.end(),
                   {"--azimuth", std::to_string(30 * frame), "-o", folder / "s.exr", "-o", folder / "s.png"});
      expect_success(fastsplat(still));
      for (const std::string ending : {".exr", ".png"}) {
        EXPECT_EQ(read_bytes(folder / ("f." + number + ending)), read_bytes(folder / ("s" + ending)))
            << engine[1] << " " << frame << ending;
        ++compared;
      }
    }
  }
  std::printf("[figure] animation_frames_compared = %d (all equal to their stills, byte for byte)\n", compared);
  ASSERT_EQ(compared, 24);
}

TEST(Animation, ASecondRunRendersMissingTornAndStaleFramesOnly) {
  const TempFolder folder;
  const auto words = turning({"-o", folder / "f.#.exr", "-o", folder / "f.#.png", "--json", "-"});
  expect_success(fastsplat(words));
  const auto whole = contents(folder);
  ASSERT_EQ(whole.size(), 8u);

  const auto again = Json::parse(fastsplat(words).out);
  EXPECT_EQ(again["kept"], 4);
  EXPECT_EQ(again["rendered"], 0);

  std::filesystem::remove(folder / "f.0.png");
  folder.write("f.1.exr", whole.at("f.1.exr").substr(0, 700));
  folder.write("f.2.png", whole.at("f.3.png"));  // another frame's picture
  const auto mended = Json::parse(fastsplat(words).out);
  EXPECT_EQ(mended["kept"], 1);
  EXPECT_EQ(mended["rendered"], 3);
  EXPECT_EQ(contents(folder), whole);

  // Another scene, another engine, other contents of the same files: no frame is kept.
  for (const std::vector<std::string>& change :
       {std::vector<std::string>{"--zoom", "1.1"}, {"--engine", "cmodel", "--config", "small"}}) {
    auto changed = words;
    changed.insert(changed.end(), change.begin(), change.end());
    EXPECT_EQ(Json::parse(fastsplat(changed).out)["rendered"], 4) << change[0];
  }
}

TEST(Animation, AnEditedTransferFunctionMakesFramesStale) {
  const TempFolder folder;
  const auto tf = [](const char* red) {
    return std::string("domain = \"range\"\npoints = [{at = 0.0, colour = [") + red +
           ", 0, 0], opacity = 0.0}, {at = 1.0, colour = [0, 1, 0], opacity = 0.5}]\n";
  };
  const auto words = turning({"--tf", folder.write("tf.toml", tf("1")), "-o", folder / "f.#.exr", "--json", "-"});
  EXPECT_EQ(Json::parse(fastsplat(words).out)["rendered"], 4);
  EXPECT_EQ(Json::parse(fastsplat(words).out)["kept"], 4);
  folder.write("tf.toml", tf("0.5"));
  EXPECT_EQ(Json::parse(fastsplat(words).out)["rendered"], 4);
}

TEST(Animation, CtrlCLeavesWholeFramesAndTheNextRunGoesOn) {
  const TempFolder folder;
  const std::vector<std::string> words{
      "render", "--volume", "shells:40",         "--size", "200", "--orbit", "0..360", "--frames",
      "500",    "-o",       folder / "f.###.exr"};
  Surroundings interrupted;
  interrupted.signal = SIGINT;
  interrupted.when = [&folder](pid_t) { return std::filesystem::exists(folder / "f.002.exr"); };
  const auto result = fastsplat(words, interrupted);
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.code, 130) << result.err;
  const auto left = folder.entries();
  ASSERT_GE(left.size(), 3u);
  ASSERT_LT(left.size(), 500u);
  const auto before = contents(folder);
  for (const auto& name : left) {
    EXPECT_EQ(name.rfind("f.", 0), 0u) << name;
    expect_success(fastsplat({"compare", folder / name, folder / name}));
  }
  const auto next = static_cast<int>(left.size());
  char wanted[16];
  std::snprintf(wanted, sizeof wanted, "f.%03d.exr", next);
  interrupted.when = [&folder, &wanted](pid_t) { return std::filesystem::exists(folder / wanted); };
  const auto resumed = fastsplat(words, interrupted);
  EXPECT_EQ(resumed.code, 130);
  EXPECT_NE(resumed.out.find("f.000.exr kept"), std::string::npos) << resumed.out;
  for (const auto& [name, bytes] : before) EXPECT_EQ(read_bytes(folder / name), bytes) << name;
  std::printf("[figure] frames_left_by_ctrl_c = %d, kept by the next run (limit >= 3)\n", next);
}

TEST(Animation, OfAScenesOwnSequence) {
  const TempFolder folder;
  const auto scene = folder.write("s.toml",
                                  "volume = \"shells:12\"\n[image]\nsize = 16\n[sequence]\nframes = 3\n"
                                  "camera.zoom = [1, 2]\ncamera.elevation = [0, 30, 0]\n");
  const auto json =
      Json::parse(fastsplat({"render", "--scene", scene, "--sequence", "-o", folder / "f.#.exr", "--json", "-"}).out);
  EXPECT_EQ(json["frames"].size(), 3u);
  expect_success(fastsplat({"render", "--scene", scene, "--zoom", "1.5", "--elevation", "30", "-o", folder / "s.exr"}));
  EXPECT_EQ(read_bytes(folder / "f.1.exr"), read_bytes(folder / "s.exr"));
  expect_success(fastsplat({"render", "--scene", scene, "--sequence", "--frames", "2", "-o", folder / "g.#.exr"}));
  EXPECT_EQ(folder.entries().size(), 3u + 1 + 1 + 2);
}

// Replaces ffmpeg: writes its arguments into the video, or fails with a message.
std::string stand_in(const TempFolder& folder, const std::string& script) {
  std::filesystem::create_directory(folder / "bin");
  folder.write("bin/ffmpeg", "#!/bin/sh\n" + script);
  std::filesystem::permissions(folder / "bin/ffmpeg", std::filesystem::perms::owner_all);
  return "PATH=" + (folder / "bin") + ":/bin:/usr/bin";
}

TEST(Video, IsMadeOfThePngFramesByFfmpeg) {
  const TempFolder folder;
  Surroundings here;
  here.environment = {stand_in(folder, "for last; do :; done\necho \"$@\" > \"${last#file:}\"\n")};
  expect_success(fastsplat(
      turning({"-o", folder / "f.##.exr", "-o", folder / "f.##.png", "--video", folder / "v.mp4", "--rate", "12"}),
      here));
  const auto said = read_bytes(folder / "v.mp4");
  for (const std::string word : {"-framerate 12 ", "-start_number 0 ", "-frames:v 4 ", "f.%02d.png"})
    EXPECT_NE(said.find(word), std::string::npos) << word << " not in " << said;
}

TEST(Video, ThatFfmpegCannotMakeIsOneLineAndNoFile) {
  const TempFolder folder;
  Surroundings here;
  here.environment = {stand_in(folder, "echo noise >&2\necho 'no such codec' >&2\nexit 3\n")};
  const auto result = fastsplat(turning({"--quiet", "-o", folder / "f.##.png", "--video", folder / "v.mp4"}), here);
  expect_error(result, 3, {"v.mp4", "no such codec"});
  EXPECT_FALSE(std::filesystem::exists(folder / "v.mp4"));
  EXPECT_TRUE(std::filesystem::exists(folder / "f.03.png"));
}

TEST(Video, WithoutFfmpegIsRefusedBeforeTheFirstFrame) {
  const TempFolder folder;
  Surroundings nowhere;
  nowhere.environment = {"PATH=" + (folder / "empty")};
  expect_error(fastsplat(turning({"-o", folder / "f.##.png", "--video", folder / "v.mp4"}), nowhere), 3,
               {"ffmpeg is not installed", "--video"});
  EXPECT_TRUE(folder.entries().empty());
}

TEST(Video, OfTheRealFfmpegPlays) {
  const auto found = run_words({"sh", "-c", "command -v ffmpeg && command -v ffprobe"});
  if (found.code != 0) GTEST_SKIP() << "ffmpeg is not installed";
  const TempFolder folder;
  expect_success(fastsplat({"render", "--volume", "shells:12", "--size", "33x31", "--orbit", "0..360", "--frames", "6",
                            "-o", folder / "50%.##.png", "--video", folder / "v.mp4"}));
  const auto probed = run_words({"ffprobe", "-v", "error", "-count_frames", "-show_entries",
                                 "stream=nb_read_frames,width,height", "-of", "csv=p=0", folder / "v.mp4"});
  EXPECT_EQ(probed.out, "34,32,6\n") << probed.err;
}

struct WrongFlags {
  std::vector<std::string> arguments;
  std::vector<std::string> said;
};

TEST(AnimationMisuse, IsOneLineWithTheFixAndNoFile) {
  const TempFolder folder;
  const std::string out = folder / "f.##.png";
  const std::vector<WrongFlags> all{
      {{"--orbit", "30..30", "--frames", "4", "-o", out}, {"same angle"}},
      {{"--orbit", "30-60", "--frames", "4", "-o", out}, {"--orbit", "'30-60'"}},
      {{"--orbit", "0..", "--frames", "4", "-o", out}, {"--orbit", "'0..'"}},
      {{"--orbit", "0..nan", "--frames", "4", "-o", out}, {"--orbit", "'0..nan'"}},
      {{"--orbit", "0..1e9", "--frames", "4", "-o", out}, {"--orbit", "3600"}},
      {{"--orbit", "0..90", "--frames", "0", "-o", out}, {"--frames", "'0'"}},
      {{"--orbit", "0..90", "--frames", "-3", "-o", out}, {"--frames", "'-3'"}},
      {{"--orbit", "0..90", "-o", out}, {"--orbit", "--frames N"}},
      {{"--frames", "4", "-o", out}, {"--frames", "--orbit"}},
      {{"--video", folder / "v.mp4", "-o", out}, {"--video", "--orbit"}},
      {{"--orbit", "0..90", "--frames", "4"}, {"nothing to write"}},
      {{"--orbit", "0..90", "--frames", "4", "--video", folder / "v.mp4"}, {"no frames to write", "frame.####.png"}},
      {{"--orbit", "0..90", "--frames", "4", "--json", "-"}, {"no frames to write"}},
      {{"--orbit", "0..90", "--frames", "4", "-o", folder / "f.png"}, {"no place for the frame number", "####"}},
      {{"--orbit", "0..90", "--frames", "101", "-o", out}, {"write ###"}},
      {{"--orbit", "0..90", "--frames", "4", "-o", folder / "f.##.jpg"}, {".exr"}},
      {{"--orbit", "0..90", "--frames", "4", "-o", out, "--azimuth", "3"}, {"--azimuth"}},
      {{"--orbit", "0..90", "--frames", "4", "-o", out, "--save-scene", folder / "s.toml"}, {"--save-scene"}},
      {{"--orbit", "0..90", "--frames", "4", "-o", out, "--sequence"}, {"--orbit", "--sequence"}},
      {{"--sequence", "-o", out}, {"--sequence", "--scene"}},
      {{"--orbit", "0..90", "--frames", "4", "-o", folder / "f.##.exr", "--video", folder / "v.mp4"}, {"PNG"}},
      {{"--orbit", "0..90", "--frames", "4", "-o", out, "--video", folder / "v.txt"}, {"v.txt", ".mp4"}},
      {{"--orbit", "0..90", "--frames", "4", "-o", out, "--video", folder / "v.mp4", "--rate", "0"}, {"--rate", "0.1"}},
      {{"--orbit", "0..90", "--frames", "4", "-o", out, "--rate", "12"}, {"--rate", "--video"}},
      {{"--orbit", "0..90", "--frames", "4", "-o", out, "-o", folder / "./f.##.png"},
       {"the same name for two outputs"}}};
  for (const auto& misuse : all) {
    std::vector<std::string> words{"render", "--volume", "shells:8", "--size", "8"};
    words.insert(words.end(), misuse.arguments.begin(), misuse.arguments.end());
    SCOPED_TRACE(misuse.said.front());
    expect_error(fastsplat(words), 2, misuse.said);
    EXPECT_TRUE(folder.entries().empty());
  }
}

TEST(AnimationMisuse, AnImpossibleFrameIsReportedBeforeTheFirst) {
  const TempFolder folder;
  std::ofstream(folder / "s.toml") << "volume = \"shells:8\"\n[camera]\nprojection = \"perspective\"\n[image]\nsize = "
                                      "16\n[lens]\ndepth_of_field = \"splats\"\naperture = 2.0\n[sequence]\nframes = "
                                      "5\nlens.focus = [0, -5000]\n";
  expect_error(fastsplat({"render", "--scene", folder / "s.toml", "--sequence", "-o", folder / "f#.png"}), 2,
               {"frame 1", "focus is behind the eye"});
  EXPECT_EQ(folder.entries().size(), 1u);
}

TEST(AnimationMisuse, UnwritableFoldersAreReportedBeforeTheFirstFrame) {
  const TempFolder folder;
  expect_error(fastsplat(turning({"-o", folder / "none/f.##.png"})), 3, {"none", "does not exist"});
  std::filesystem::create_directory(folder / "f.02.png");
  expect_error(fastsplat(turning({"-o", folder / "f.##.png"})), 3, {"f.02.png", "directory"});
  EXPECT_EQ(folder.entries().size(), 1u);
}

}  // namespace
}  // namespace fastsplat::cli_test
