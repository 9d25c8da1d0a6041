// Bytes that are no UTF-8, in the names of files and in what pictures carry: results are told all the same.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/images/image_file.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

const std::string kName = "caf\xe9";            // Latin-1
const std::string kAsUtf8 = "caf\xef\xbf\xbd";  // what JSON can say of it

/// The run's JSON, once from a file and once from stdout; `--json` and `--quiet` are added here.
nlohmann::json told(const TempFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--json", folder / "told.json"});
  const auto run = fastsplat(arguments);
  EXPECT_EQ(run.code, 0) << arguments[0] << ": " << run.err;
  EXPECT_EQ(run.err.find("internal"), std::string::npos) << run.err;
  return nlohmann::json::parse(read_bytes(folder / "told.json"), nullptr, false);
}

TEST(ForeignBytes, NamesOfFilesComeThroughEveryVerb) {
  const TempFolder folder;
  const std::string volume = folder / (kName + ".nrrd"), picture = folder / (kName + ".png"),
                    stream = folder / (kName + ".fss");
  const std::vector<std::vector<std::string>> commands{
      {"volume", "convert", "shells:8", volume},
      {"volume", "info", volume},
      {"render", "--volume", volume, "--size", "16", "-o", picture, "-o", folder / "a.exr"},
      {"compare", picture, picture},
      {"stream", "record", "--volume", volume, "--size", "16", "--config", "tiny", "-o", stream},
      {"stream", "dump", stream},
      {"stream", "replay", stream, "--config", "tiny", "-o", folder / (kName + ".exr")},
      {"cycles", "--stream", stream, "--config", "tiny", "--trace", folder / (kName + ".json")},
      {"verify", "--stream", stream, "--config", "tiny", "--coverage", folder / (kName + "-coverage.json")},
  };
  int said = 0;
  for (const auto& command : commands) {
    SCOPED_TRACE(command[0] + " " + command[1]);
    const auto json = told(folder, command);
    EXPECT_FALSE(json.is_discarded()) << "no JSON";
    said += json.dump().find(kAsUtf8) != std::string::npos ? 1 : 0;
  }
  std::printf("[figure] verbs whose JSON names such a file = %d of %zu\n", said, commands.size());
  EXPECT_GE(said, 6);
}

TEST(ForeignBytes, WhatAPictureCarriesComesThroughCompare) {
  const TempFolder folder;
  Image image(4, 4);
  for (const std::string ending : {".exr", ".tif", ".png"}) {
    SCOPED_TRACE(ending);
    images::write_image(folder / ("a" + ending), image, {{"scene", kName}});
    const auto json = told(folder, {"compare", folder / ("a" + ending), folder / ("a" + ending)});
    EXPECT_FALSE(json.is_discarded()) << "no JSON";
  }
}

TEST(ForeignBytes, ASceneThatTomlCannotHoldIsRefusedBeforeTheWork) {
  const TempFolder folder;
  const std::string volume = folder / (kName + ".nrrd");
  expect_success(fastsplat({"volume", "convert", "shells:8", volume}));
  const auto before = folder.entries();
  expect_error(fastsplat({"render", "--volume", volume, "--size", "16", "-o", folder / "a.exr", "--save-scene",
                          folder / "s.toml"}),
               2, {"--save-scene", "UTF-8", "rename"});
  EXPECT_EQ(folder.entries(), before);
}

}  // namespace
}  // namespace fastsplat::cli_test
