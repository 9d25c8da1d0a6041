// The walls of docs/architecture.md: who may include whom, and what the device may not contain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/architecture/source_helper.hpp"

namespace fastsplat::architecture {
namespace {

const Arrows kArrows{
    {"base", {}},
    {"scene", {"base"}},
    {"golden", {"base", "scene"}},
    {"cmodel", {"base"}},
    {"driver", {"base", "scene", "cmodel"}},
    {"testbench", {"base", "cmodel"}},
    {"analysis", {"base", "scene", "golden", "cmodel", "driver"}},
    {"cli", {"base", "scene", "golden", "cmodel", "driver", "testbench", "analysis"}},
};

std::vector<std::string> product_folders() {
  std::vector<std::string> names;
  for (const auto& [name, unused] : kArrows) names.push_back(name);
  return names;
}

std::vector<SourceFile> product() { return read_sources(FASTSPLAT_SOURCE_DIR, product_folders()); }

std::vector<SourceFile> all_sources() {
  auto folders = product_folders();
  folders.insert(folders.end(), {"tests", "bench"});
  return read_sources(FASTSPLAT_SOURCE_DIR, folders);
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const auto& line : lines) text += line + "\n";
  return text;
}

void figure(const char* name, int value) {
  std::printf("[figure] %s = %d (limit > 0)\n", name, value);
  ::testing::Test::RecordProperty(name, value);
  ASSERT_GT(value, 0) << "nothing was checked";
}

TEST(Architecture, IncludesFollowTheArrows) {
  const auto files = product();
  int includes = 0;
  const auto offences = arrow_offences(files, kArrows, includes);
  figure("files", static_cast<int>(files.size()));
  figure("project_includes", includes);
  EXPECT_TRUE(offences.empty()) << joined(offences);
  for (const auto& folder : product_folders()) {
    EXPECT_TRUE(std::any_of(files.begin(), files.end(), [&](const auto& file) { return file.folder() == folder; }))
        << folder << " holds no source: was it renamed?";
  }
}

TEST(Architecture, TheArrowsThemselvesHaveNoCircle) {
  // A folder's list must contain the lists of the folders in it; a circle would make a folder contain itself.
  for (const auto& [folder, allowed] : kArrows) {
    EXPECT_FALSE(allowed.contains(folder));
    for (const auto& name : allowed) {
      for (const auto& further : kArrows.at(name))
        EXPECT_TRUE(allowed.contains(further)) << folder << " -> " << name << " -> " << further;
    }
  }
}

TEST(Architecture, NoFilesIncludeEachOtherInARing) {
  const auto files = all_sources();
  figure("files", static_cast<int>(files.size()));
  EXPECT_EQ(include_ring(files), "");
}

TEST(Architecture, TheDeviceIsIntegerOnlyAndDeterministic) {
  const auto files = read_sources(FASTSPLAT_SOURCE_DIR, {"cmodel"});
  int words = 0;
  const auto offences = device_word_offences(files, words);
  figure("cmodel_files", static_cast<int>(files.size()));
  figure("cmodel_words", words);
  EXPECT_TRUE(offences.empty()) << joined(offences);
}

TEST(Architecture, NoFileIsLongerThan600Lines) {
  const auto files = all_sources();
  figure("files", static_cast<int>(files.size()));
  for (const auto& file : files) {
    const auto lines = std::count(file.text.begin(), file.text.end(), '\n');
    EXPECT_LE(lines, 600) << file.path << ": split it";
  }
}

TEST(Architecture, EveryHeaderIsIncludedOnce) {
  int headers = 0;
  for (const auto& file : all_sources()) {
    if (!file.is_header()) continue;
    ++headers;
    EXPECT_NE(file.text.find("#pragma once"), std::string::npos) << file.path;
  }
  figure("headers", headers);
}

TEST(Architecture, EveryFileSaysWhatItIsFor) {
  int headers = 0;
  for (const auto& file : product()) {
    if (!file.is_header()) continue;
    ++headers;
    EXPECT_TRUE(file.text.starts_with("//")) << file.path << ": a header begins with a line that tells what it is for";
  }
  figure("headers", headers);
}

// The checks above are only worth something if they notice: each against a small tree that breaks its rule.

TEST(ArchitectureMustFail, AnIncludeAgainstTheArrowIsNamed) {
  int checked = 0;
  const auto offences = arrow_offences(
      {{"cmodel/bad.cpp", "// ok\n#include \"base/error.hpp\"\n#include \"scene/image.hpp\"\n"}}, kArrows, checked);
  ASSERT_EQ(offences.size(), 1u);
  EXPECT_NE(offences[0].find("cmodel/bad.cpp:3: includes scene/image.hpp"), std::string::npos) << offences[0];
  EXPECT_EQ(checked, 2);
}

TEST(ArchitectureMustFail, AnIncludeInAngleBracketsIsNoEscape) {
  int checked = 0;
  EXPECT_EQ(arrow_offences({{"scene/bad.hpp", "#  include <golden/render.hpp>\n"}}, kArrows, checked).size(), 1u);
}

TEST(ArchitectureMustFail, ARelativeIncludeIsNoEscape) {
  int checked = 0;
  EXPECT_EQ(arrow_offences({{"scene/bad.hpp", "#include \"../golden/render.hpp\"\n#include \"camera.hpp\"\n"}}, kArrows,
                           checked)
                .size(),
            2u);
}

TEST(ArchitectureMustFail, AnIncludeInACommentIsNoOffence) {
  int checked = 0;
  EXPECT_TRUE(
      arrow_offences({{"cmodel/good.cpp", "/* \n#include \"scene/image.hpp\"\n*/ // #include \"cli/output.hpp\"\n"}},
                     kArrows, checked)
          .empty());
  EXPECT_EQ(checked, 0);
}

TEST(ArchitectureMustFail, ARingIsNamed) {
  EXPECT_EQ(include_ring({{"a/x.hpp", "#include \"a/y.hpp\"\n"},
                          {"a/y.hpp", "#include \"a/z.hpp\"\n"},
                          {"a/z.hpp", "#include \"a/y.hpp\"\n"}}),
            "a/y.hpp -> a/z.hpp -> a/y.hpp");
}

TEST(ArchitectureMustFail, RealNumbersThreadsClocksAndChanceAreNamed) {
  for (const std::string bad :
       {"float x;", "double y = 0;", "glm::vec3 v;", "auto z = 1.5;", "auto z = 1e3;", "auto z = .5;", "auto z = 2.;",
        "#include <thread>", "#include <chrono>", "#include <glm/glm.hpp>", "#include \"glm/vec3.hpp\"",
        "std::random_device d;", "int t = rand();", "#include <cmath>"}) {
    int checked = 0;
    const auto offences = device_word_offences({{"cmodel/bad.cpp", "// fine\n" + bad + "\n"}}, checked);
    EXPECT_GE(offences.size(), 1u) << bad;
    ASSERT_FALSE(offences.empty());
    EXPECT_NE(offences[0].find("cmodel/bad.cpp:2"), std::string::npos) << offences[0];
  }
}

TEST(ArchitectureMustFail, IntegersCommentsAndStringsAreNoOffence) {
  for (const std::string good :
       {"// a float, 1.5, std::thread", "/* double\n 2.5 */ int x = 0x1e5;", "auto s = \"float 1.5\";",
        "auto n = 1'000'000u;", "int floating = 0xFFu;", "char c = '\"'; int e = 10; // float",
        "auto r = R\"(double 1.5)\";", "int doubled = 1 << 16;", "auto x = 1'0; char d = 'f';"}) {
    int checked = 0;
    const auto offences = device_word_offences({{"cmodel/good.cpp", good + "\n"}}, checked);
    EXPECT_TRUE(offences.empty()) << good << "\n" << joined(offences);
  }
}

}  // namespace
}  // namespace fastsplat::architecture
