// SPDX-License-Identifier: Apache-2.0
// Bytes that are not UTF-8, in file names and in metadata of pictures: results are still printed.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/images/image_file.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

const std::string kName = "caf\xe9";            // Latin-1
const std::string kAsUtf8 = "caf\xef\xbf\xbd";  // as JSON can hold it

/// The run's JSON, once from a file and once from stdout; `--json` and `--quiet` are added here.
nlohmann::json result_of(const TempFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.end(), {"--json", folder / "result.json"});
  const auto run = fastsplat(arguments);
  EXPECT_EQ(run.code, 0) << arguments[0] << ": " << run.err;
  EXPECT_EQ(run.err.find("internal"), std::string::npos) << run.err;
  return nlohmann::json::parse(read_bytes(folder / "result.json"), nullptr, false);
}

TEST(ForeignBytes, NamesOfFilesComeThroughEverySubcommand) {
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
    const auto json = result_of(folder, command);
    EXPECT_FALSE(json.is_discarded()) << "no JSON";
    said += json.dump().find(kAsUtf8) != std::string::npos ? 1 : 0;
  }
  std::printf("[figure] verbs whose JSON names such a file = %d of %zu\n", said, commands.size());
  EXPECT_GE(said, 6);
}

TEST(ForeignBytes, MetadataOfAPictureComesThroughCompare) {
  const TempFolder folder;
  Image image(4, 4);
  for (const std::string ending : {".exr", ".tif", ".png"}) {
    SCOPED_TRACE(ending);
    images::write_image(folder / ("a" + ending), image, {{"scene", kName}});
    const auto json = result_of(folder, {"compare", folder / ("a" + ending), folder / ("a" + ending)});
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

/// Neither stdout nor stderr nor a page holds terminal control bytes.
TEST(ForeignBytes, ControlBytesOfNamesAreEscapedEverywhere) {
  const TempFolder folder;
  const std::string name =
                        "a\x1b[31mred\xc2\x9b"
                        "0m\xff",
                    picture = folder / (name + ".png"), volume = folder / (name + ".nrrd"),
                    result = folder / (name + ".json");
  const std::vector<std::vector<std::string>> commands{
      {"volume", "convert", "shells:8", volume},
      {"volume", "info", volume},
      {"render", "--volume", volume, "--size", "16", "-o", picture},
      {"compare", picture, picture, "--json", result},
      {"report", result, "--markdown", folder / "r.md", "--csv", folder / "r.csv", "--junit", folder / "r.xml", "-o",
       folder / "r.html"},
      {"report", result, "--markdown", folder / (name + ".md")},
      {"compare", picture, picture, "--json", "-"},
      {"volume", "info", folder / (name + "x.nrrd")},
      {"render", "--volume", volume, "--size", "16", "-o", folder / (name + ".gif")},
  };
  std::size_t texts = 0;
  const auto check = [&](const std::string& text, const std::string& of) {
    EXPECT_EQ(text.find('\x1b'), std::string::npos) << of;
    EXPECT_EQ(text.find("\xc2\x9b"), std::string::npos) << of;
    texts += text.empty() ? 0 : 1;
  };
  for (const auto& command : commands) {
    const auto run = fastsplat(command);
    const std::string& last = command.back();
    EXPECT_EQ(run.code, last.ends_with("x.nrrd") ? 3 : last.ends_with(".gif") ? 2 : 0) << run.err;
    check(run.out, command[0] + " " + command[1] + ", stdout");
    check(run.err, command[0] + " " + command[1] + ", stderr");
  }
  check(read_bytes(result), "JSON");
  for (const char* file : {"r.md", "r.csv", "r.xml", "r.html"}) check(read_bytes(folder / file), file);
  std::printf("[figure] texts looked at = %zu (limit 10)\n", texts);
  EXPECT_GE(texts, 10u);
}

TEST(ForeignBytes, NoNameIsSuggestedForItself) {
  const TempFolder folder;
  const std::string picture = folder / (kName + ".png");
  expect_success(fastsplat({"render", "--volume", "shells:8", "--size", "16", "-o", picture}));
  expect_error(fastsplat({"compare", folder / (kAsUtf8 + ".png"), picture}), 3, {"no such file", "rename the file"});
  const auto near = fastsplat({"compare", folder / "cafe.png", picture});
  EXPECT_EQ(near.err.find("did you mean"), std::string::npos) << near.err;
}

}  // namespace
}  // namespace fastsplat::cli_test
