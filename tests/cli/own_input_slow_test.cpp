// SPDX-License-Identifier: Apache-2.0
// No result replaces an input file of its command: exit 2 before any work, whatever the file is called.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cli/subcommand.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

class OwnInput : public ::testing::Test {
 protected:
  void SetUp() override {
    expect_success(fastsplat({"volume", "convert", "shells:8", volume_}));
    expect_success(fastsplat({"volume", "convert", "shells:8", header_}));
    expect_success(fastsplat({"render", "--volume", "shells:8", "--size", "8", "-o", picture_, "--json", result_}));
    expect_success(fastsplat({"gaussians", "convert", "shells:8", gaussians_}));
    folder_.write("plan.json", "{}");
    folder_.write("cameras.json", "[]");
    expect_success(
        fastsplat({"stream", "record", "--volume", "shells:8", "--size", "8", "--config", "tiny", "-o", stream_}));
    const auto shown = fastsplat({"config", "show", "tiny"});
    folder_.write("config.toml", shown.out);
    folder_.write(
        "tf.toml",
        "points = [{at = 0.0, colour = [1, 1, 1], opacity = 0.0}, {at = 1.0, colour = [1, 1, 1], opacity = 0.5}]\n");
    folder_.write("scene.toml",
                  "# kept\nvolume = \"in.nrrd\"\ntransfer_function = \"tf.toml\"\n[image]\nsize = "
                  "8\n[sequence]\nframes = 2\ncamera.zoom = [1, 2]\n");
  }

  /// The file in danger, and the command.
  struct Danger {
    std::string file;
    std::vector<std::string> command;
  };

  std::vector<Danger> dangers() const {
    const std::vector<std::string> still{"render", "--size", "8", "--volume", "shells:8"};
    const auto with = [](std::vector<std::string> words, const std::vector<std::string>& more) {
      words.insert(words.end(), more.begin(), more.end());
      return words;
    };
    const std::vector<std::string> model{"--engine", "cmodel", "--config", config_};
    return {
        {volume_, {"volume", "info", volume_, "--json", volume_}},
        {data_, {"volume", "info", header_, "--json", data_}},
        {volume_, {"volume", "convert", volume_, volume_}},
        {volume_, {"volume", "convert", volume_, folder_ / "a.nii", "--json", volume_}},
        {data_, {"volume", "convert", header_, header_}},
        {gaussians_, {"gaussians", "info", gaussians_, "--json", gaussians_}},
        {gaussians_, {"gaussians", "convert", gaussians_, gaussians_}},
        {gaussians_, {"gaussians", "convert", gaussians_, folder_ / "a.spz", "--json", gaussians_}},
        {gaussians_, {"errors", "file", gaussians_, "shells:8", "--size", "8", "--json", gaussians_}},
        {gaussians_, {"errors", "file", "shells:8", gaussians_, "--size", "8", "--json", gaussians_}},
        {cameras_, {"render", "--gaussians", "shells:8", "--size", "8", "--cameras", cameras_, "--json", cameras_}},
        {volume_, {"render", "--size", "8", "--volume", volume_, "--json", volume_}},
        {config_, with(still, with(model, {"--json", config_}))},
        {tf_, with(still, {"--tf", tf_, "--json", tf_})},
        {scene_, {"render", "--scene", scene_, "--save-scene", scene_}},
        {scene_, {"render", "--scene", scene_, "--json", scene_}},
        {volume_, {"render", "--scene", scene_, "--json", volume_}},
        {tf_, {"render", "--scene", scene_, "--json", tf_}},
        {scene_, {"render", "--scene", scene_, "--sequence", "-o", folder_ / "f#.png", "--json", scene_}},
        {tf_, {"render", "--scene", scene_, "--sequence", "-o", folder_ / "f#.png", "--json", tf_}},
        {picture_, {"compare", picture_, folder_ / "other.exr", "--json", picture_}},
        {config_,
         {"stream", "record", "--volume", "shells:8", "--size", "8", "--config", config_, "-o", folder_ / "b.fss",
          "--json", config_}},
        {volume_, {"stream", "record", "--volume", volume_, "--size", "8", "-o", folder_ / "b.fss", "--json", volume_}},
        {stream_, {"stream", "dump", stream_, "--json", stream_}},
        {stream_, {"stream", "replay", stream_, "--config", config_, "--json", stream_}},
        {stream_, {"stream", "vectors", stream_, "--config", config_, "-o", folder_ / "v", "--json", stream_}},
        {config_, {"stream", "vectors", stream_, "--config", config_, "-o", folder_ / "v", "--json", config_}},
        {config_, {"stream", "replay", stream_, "--config", config_, "--json", config_}},
        {stream_, {"cycles", "--stream", stream_, "--config", config_, "--trace", stream_}},
        {config_, {"cycles", "--stream", stream_, "--config", config_, "--json", config_}},
        {volume_, {"cycles", "--volume", volume_, "--size", "8", "--json", volume_}},
        {volume_, {"errors", "--volume", volume_, "--size", "8", "--json", volume_}},
        {volume_, {"pixel", "1,1", "--volume", volume_, "--size", "8", "--json", volume_}},
        {config_, {"pixel", "1,1", "--volume", "shells:8", "--size", "8", "--config", config_, "--json", config_}},
        {config_, {"errors", "bound", "--volume", "shells:8", "--size", "8", "--config", config_, "--json", config_}},
        {config_, {"errors", "ranges", "--volume", "shells:8", "--size", "8", "--config", config_, "--json", config_}},
        {scene_, {"errors", "ranges", "--scenes", scene_, "--json", scene_}},
        {config_,
         {"errors", "propose", "--target", "psnr>=20", "--volume", "shells:8", "--size", "8", "--from", config_, "-o",
          config_}},
        {scene_, {"errors", "propose", "--target", "psnr>=20", "--scenes", scene_, "--journal", scene_}},
        {stream_, {"verify", "--stream", stream_, "--config", config_, "--json", stream_}},
        {config_, {"verify", "--random", "10", "--config", config_, "--coverage", config_}},
        {volume_, {"verify", "--volume", volume_, "--size", "8", "--config", config_, "--json", volume_}},
        {volume_, {"errors", "--volume", volume_, "--size", "8", "--json", volume_}},
        {config_, {"config", "show", config_, "--json", config_}},
        {config_, {"config", "check", config_, "--json", config_}},
        {config_, {"config", "diff", "base", config_, "--json", config_}},
        {plan_, {"plan", "make", plan_, "-o", plan_}},
        {plan_, {"plan", "run", plan_, "--json", plan_}},
        {plan_, {"plan", "status", plan_, "--json", plan_}},
        {plan_, {"plan", "merge", plan_, "-o", plan_}},
        {plan_, {"plan", "submit", plan_, "--engine", "slurm", "-o", plan_}},
        {plan_, {"plan", "submit", plan_, "--engine", "script", "--json", plan_}},
        {plan_, {"plan", "table", plan_, "-o", plan_}},
        {plan_, {"plan", "csv", plan_, "-o", plan_}},
        {plan_, {"plan", "pareto", plan_, "--x", "a", "--y", "b", "--json", plan_}},
        {result_, {"report", result_, "-o", folder_ / "r.html", "--json", result_}},
        {picture_, {"report", result_, "-o", folder_ / "r.html", "--json", picture_}},
    };
  }

  void expect_untouched(const Danger& danger) const {
    SCOPED_TRACE(danger.command[0] + " " + danger.command[1] + " ... " + danger.command.back());
    const auto bytes = read_bytes(danger.file);
    const auto before = folder_.entries();
    expect_error(fastsplat(danger.command), 2, {"the same name for an input and an output", "another name"});
    EXPECT_TRUE(read_bytes(danger.file) == bytes) << danger.file << " was replaced";
    EXPECT_EQ(folder_.entries(), before);
  }

  TempFolder folder_;
  const std::string volume_ = folder_ / "in.nrrd", header_ = folder_ / "detached.nhdr",
                    data_ = folder_ / "detached.raw.gz", picture_ = folder_ / "in.exr", stream_ = folder_ / "in.fss",
                    config_ = folder_ / "config.toml", tf_ = folder_ / "tf.toml", scene_ = folder_ / "scene.toml",
                    result_ = folder_ / "result.json", gaussians_ = folder_ / "in.ply",
                    cameras_ = folder_ / "cameras.json", plan_ = folder_ / "plan.json";
};

TEST_F(OwnInput, IsReplacedByNoSubcommand) {
  for (const auto& danger : dangers()) expect_untouched(danger);
  std::printf("[figure] commands refused = %zu\n", dangers().size());
}

TEST_F(OwnInput, EveryVerbThatReadsFilesIsAmongThem) {
  std::set<std::string> tried;
  for (const auto& danger : dangers()) {
    tried.insert(danger.command[0]);
    tried.insert(danger.command[0] + " " + danger.command[1]);
  }
  for (const auto& subcommand : cli::all_subcommands()) {
    const std::string name = subcommand.name;
    if (subcommand.declare == nullptr || name == "doctor" || name == "config list" || name == "family" ||
        name == "completion" || name == "help" || name == "lab")
      continue;  // these read no files
    EXPECT_TRUE(tried.contains(name)) << name << " reads files: what does it do to them?";
  }
}

// By the file's identity: a link, a hard link, another path.
TEST_F(OwnInput, UnderAnotherNameIsTheSameFile) {
  std::filesystem::create_symlink("in.nrrd", folder_ / "link.nrrd");
  std::filesystem::create_hard_link(volume_, folder_ / "hard.nrrd");
  std::filesystem::create_directory(folder_ / "sub");
  for (const auto& name : {folder_ / "link.nrrd", folder_ / "hard.nrrd", folder_ / "sub/../in.nrrd"}) {
    expect_untouched({volume_, {"volume", "info", volume_, "--json", name}});
    expect_untouched({volume_, {"volume", "info", name, "--json", volume_}});
    expect_untouched({volume_, {"volume", "convert", volume_, name}});
  }
}

// A built-in name is not a file, even if the command is about to write a file of that name.
TEST_F(OwnInput, BuiltInNamesAreNotFiles) {
  Surroundings here;
  here.folder = folder_.path();
  expect_success(fastsplat({"config", "show", "tiny", "--json", "tiny"}, here));
  expect_success(fastsplat({"render", "--volume", "shells:8", "--size", "8", "--tf", "bone", "--json", "bone"}, here));
}

}  // namespace
}  // namespace fastsplat::cli_test
