// SPDX-License-Identifier: Apache-2.0
// The rules of docs/architecture.md: who may include whom, and what the device may not contain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "tests/architecture/draws_helper.hpp"
#include "tests/architecture/source_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::architecture {
namespace {

/// Rooms as docs/architecture.md draws them: each with the rooms that it may include directly. What those may include
/// follows.
const Arrows kDrawn{
    {"base", {}},
    {"base/parallel", {"base"}},
    {"base/toml", {"base"}},
    {"base/images", {"base"}},
    {"base/images/openimageio", {"base/images"}},
    {"scene", {"scene/volume", "base/toml"}},
    {"scene/volume", {"base"}},
    {"scene/gaussians", {"scene", "base/parallel"}},
    {"golden", {"golden/splat", "scene/gaussians"}},
    {"golden/splat", {"scene"}},
    {"cmodel/numbers", {"base"}},
    {"cmodel/stream", {"cmodel/numbers"}},
    {"cmodel/splat", {"cmodel/stream"}},
    {"cmodel/composite", {"cmodel/splat"}},
    {"cmodel/classify", {"cmodel/splat"}},
    {"cmodel/cull", {"cmodel/stream"}},
    {"cmodel/decode", {"cmodel/classify", "cmodel/cull"}},
    {"cmodel/io", {"cmodel/cull"}},
    {"cmodel", {"cmodel/composite", "cmodel/decode"}},
    {"cmodel/cycles", {"cmodel/decode", "cmodel/io"}},
    {"cmodel/fast", {"cmodel/composite", "cmodel/decode"}},
    {"cmodel/rtl_package", {"cmodel/cycles"}},
    {"driver/config", {"cmodel/numbers", "base/toml"}},
    {"driver/tables", {"scene", "cmodel/classify", "base/parallel"}},
    {"driver/splats", {"driver/tables"}},
    {"driver/tiles", {"driver/splats", "scene/gaussians", "cmodel", "cmodel/cycles", "cmodel/fast"}},
    {"driver/files", {"driver/tiles"}},
    {"driver/tools", {"driver/config", "cmodel/rtl_package"}},
    {"testbench/module", {}},
    {"testbench/device", {"cmodel/rtl_package", "testbench/module"}},
    {"testbench/coverage", {"cmodel", "testbench/device"}},
    {"testbench/check", {"testbench/coverage"}},
    {"testbench/faults", {"testbench/device"}},
    {"testbench/stimulus", {"testbench/check", "base/parallel"}},
    {"testbench/triage", {"testbench/stimulus"}},
    {"testbench/closure", {"testbench/stimulus", "base/toml"}},
    {"testbench/capi", {"driver/config", "testbench/check"}},
    {"analysis", {"base/images", "scene", "base/parallel"}},
    {"analysis/pipeline", {"golden", "driver/tiles"}},
    {"analysis/errors", {"analysis", "analysis/pipeline", "cmodel/rtl_package"}},
    {"analysis/index_kinds", {"analysis/errors", "driver/config"}},
    {"analysis/sweep", {"base/toml"}},
    {"report", {"base/images"}},
    {"report/formats", {"report"}},
    {"lab", {"driver/config", "analysis/errors"}},
    {"cli",
     {"golden", "driver/config", "driver/files", "testbench/triage", "testbench/closure", "testbench/faults",
      "analysis/index_kinds", "analysis/sweep", "report/formats", "lab"}},
    {"docs/examples", {"base/images", "driver/config", "driver/files", "testbench/device"}},
};

/// The transitive closure of `drawn`; a room on a cycle reaches itself.
Arrows reached(const Arrows& drawn) {
  Arrows all = drawn;
  for (bool grown = true; grown;) {
    grown = false;
    for (auto& [room, targets] : all) {
      const auto before = targets;
      for (const auto& target : before) targets.insert(all.at(target).begin(), all.at(target).end());
      grown = grown || targets.size() != before.size();
    }
  }
  return all;
}

const Arrows kArrows = reached(kDrawn);

std::vector<std::string> product_rooms() {
  std::vector<std::string> names;
  for (const auto& [name, unused] : kArrows) names.push_back(name);
  return names;
}

/// The folders at the top of the tree.
std::vector<std::string> product_folders() {
  std::set<std::string> names;
  for (const auto& room : product_rooms()) names.insert(room.substr(0, room.find('/')));
  return {names.begin(), names.end()};
}

std::vector<SourceFile> product() { return read_sources(FASTSPLAT_SOURCE_DIR, product_folders()); }

std::vector<SourceFile> all_sources() {
  auto folders = product_folders();
  folders.insert(folders.end(), {"tests", "tools"});
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
  for (const auto& room : product_rooms()) {
    EXPECT_TRUE(
        std::any_of(files.begin(), files.end(), [&](const auto& file) { return room_of(file.path, kArrows) == room; }))
        << room << " holds no source: was it renamed?";
  }
  for (const auto& file : files)
    EXPECT_FALSE(room_of(file.path, kArrows).empty()) << file.path << " lies in no room of docs/architecture.md";
}

TEST(Architecture, TheArrowsThemselvesHaveNoCircle) {
  figure("rooms", static_cast<int>(kArrows.size()));
  for (const auto& [room, allowed] : kArrows) EXPECT_FALSE(allowed.contains(room)) << room << " reaches itself";
}

/// The tree of docs/architecture.md names every room with what it may include.
TEST(Architecture, TheDocumentDrawsTheseArrows) {
  std::ifstream page(FASTSPLAT_SOURCE_DIR "/docs/architecture.md");
  Arrows drawn;
  std::string line;
  // "testbench/check/  tells ...  -> testbench/coverage, base/parallel"
  const std::regex entry(R"(^([a-z_/]+)/\s.*->\s*([a-z_/, ]+)$)");
  std::smatch match;
  while (std::getline(page, line)) {
    if (!std::regex_match(line, match, entry)) continue;
    auto& targets = drawn[match[1].str()];
    std::string list = match[2].str();
    std::replace(list.begin(), list.end(), ',', ' ');
    std::istringstream names(list);
    for (std::string name; names >> name;) {
      if (name != "nothing" && name != "all") targets.insert(name);
    }
  }
  for (const char* not_product : {"tests", "tools/benchmarks", "tools/benchmarks/peers"}) drawn.erase(not_product);
  figure("rooms_drawn", static_cast<int>(drawn.size()));
  EXPECT_EQ(drawn, kDrawn);
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

/// Every program that links the image library loads hundreds of others.
TEST(Architecture, TheImageLibraryIsIncludedByItsModuleAlone) {
  int inside = 0;
  for (const auto& file : product()) {
    for (const auto& include : includes_of(file.text)) {
      if (!include.target.starts_with("OpenImageIO/")) continue;
      if (room_of(file.path, kArrows) == "base/images/openimageio") {
        ++inside;
      } else {
        ADD_FAILURE() << file.path << ":" << include.line << ": includes " << include.target;
      }
    }
  }
  figure("includes_of_its_module", inside);
}

TEST(Architecture, NoTwoDrawsDependOnTheCompiler) {
  int draws = 0;
  auto files = read_sources(FASTSPLAT_SOURCE_DIR,
                            {"scene", "golden", "cmodel", "driver", "testbench", "analysis", "bench", "tests"});
  std::erase_if(files, [](const SourceFile& file) {  // half a second for the others
    return file.text.find("andom") == std::string::npos && file.text.find("uniform(") == std::string::npos;
  });
  const auto offences = draw_offences(files, draws);
  std::printf("[figure] random draws read = %d\n", draws);
  EXPECT_GT(draws, 500);
  EXPECT_TRUE(offences.empty()) << joined(offences);
}

TEST(Architecture, NoFileIsLongerThan600Lines) {
  auto files = all_sources();
  const auto rtl = read_sources(FASTSPLAT_SOURCE_DIR, {"rtl", "testbench", "tests", "tools"}, kSystemVerilog);
  figure("rtl_files", static_cast<int>(rtl.size()));
  files.insert(files.end(), rtl.begin(), rtl.end());
  figure("files", static_cast<int>(files.size()));
  for (const auto& file : files) {
    const auto lines = std::count(file.text.begin(), file.text.end(), '\n');
    EXPECT_LE(lines, 600) << file.path << ": split it";
  }
}

/// Otherwise a module would compile only after another one that includes the file.
TEST(Architecture, RtlIncludesTheMacrosItUses) {
  const std::regex use("`FASTSPLAT_(FAULT|NARROW|ASSERT|ASSUME|COVER|INIT)");
  int uses = 0;
  for (const auto& [path, source] : read_sources(FASTSPLAT_SOURCE_DIR, {"rtl"}, {".sv"})) {
    for (std::sregex_iterator match(source.begin(), source.end(), use), end; match != end; ++match, ++uses) {
      const std::string macro = (*match)[1].str();
      const std::string file = macro == "FAULT" ? "fault" : macro == "NARROW" ? "narrow" : "assertions";
      EXPECT_NE(source.find("\n`include \"" + file + ".svh\"\n"), std::string::npos)
          << path << " uses `FASTSPLAT_" << macro << " without " << file << ".svh";
    }
  }
  figure("uses_of_macros", uses);
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

TEST(Architecture, EveryFileNamesItsLicenceAndAHeaderWhatItIsFor) {
  const std::string licence = "// SPDX-License-Identifier: Apache-2.0\n";
  int files = 0, headers = 0;
  for (const auto& file : product()) {
    ++files;
    EXPECT_TRUE(file.text.starts_with(licence)) << file.path << ": expected '" << licence << "' as its first line";
    if (!file.is_header()) continue;
    ++headers;
    EXPECT_EQ(file.text.find("//", 1), licence.size())
        << file.path << ": expected its purpose in the line behind the licence";
  }
  figure("files", files);
  figure("headers", headers);
}

// The checks above must notice violations: each is run on a small tree that breaks its rule.
TEST(ArchitectureMustFail, AnIncludeAgainstTheArrowIsNamed) {
  int checked = 0;
  const auto offences = arrow_offences(
      {{"cmodel/bad.cpp", "// ok\n#include \"base/error.hpp\"\n#include \"scene/scene.hpp\"\n"}}, kArrows, checked);
  ASSERT_EQ(offences.size(), 1u);
  EXPECT_NE(offences[0].find("cmodel/bad.cpp:3: includes scene/scene.hpp"), std::string::npos) << offences[0];
  EXPECT_EQ(checked, 2);
}

TEST(ArchitectureMustFail, ARoomWithinARoomHasWallsOfItsOwn) {
  int checked = 0;
  const auto offences = arrow_offences({{"testbench/coverage/bad.cpp", "#include \"testbench/check/verify.hpp\"\n"},
                                        {"golden/splat/bad.hpp", "#include \"golden/render.hpp\"\n"},
                                        {"base/bad.cpp", "#include \"base/parallel/parallel.hpp\"\n"},
                                        {"golden/good.cpp", "#include \"golden/splat/footprint.hpp\"\n"}},
                                       kArrows, checked);
  EXPECT_EQ(offences.size(), 3u) << joined(offences);
  EXPECT_EQ(checked, 4);
}

TEST(ArchitectureMustFail, ACircleOfArrowsIsSeen) {
  const Arrows all = reached({{"a", {"b"}}, {"b", {"c"}}, {"c", {"a"}}, {"d", {"a"}}});
  EXPECT_TRUE(all.at("a").contains("a"));
  EXPECT_FALSE(all.at("d").contains("d"));
}

TEST(ArchitectureMustFail, AnIncludeInAngleBracketsIsSeen) {
  int checked = 0;
  EXPECT_EQ(arrow_offences({{"scene/bad.hpp", "#  include <golden/render.hpp>\n"}}, kArrows, checked).size(), 1u);
}

TEST(ArchitectureMustFail, ARelativeIncludeIsSeen) {
  int checked = 0;
  EXPECT_EQ(arrow_offences({{"scene/bad.hpp", "#include \"../golden/render.hpp\"\n#include \"camera.hpp\"\n"}}, kArrows,
                           checked)
                .size(),
            2u);
}

TEST(ArchitectureMustFail, AnIncludeInACommentIsIgnored) {
  int checked = 0;
  EXPECT_TRUE(
      arrow_offences({{"cmodel/good.cpp", "/* \n#include \"scene/scene.hpp\"\n*/ // #include \"cli/output.hpp\"\n"}},
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

TEST(ArchitectureMustFail, DrawsWithoutAnOrderAreNamed) {
  const auto offences = [](const std::string& code) {
    int draws = 0;
    return draw_offences({{"scene/x.cpp", "// fine\n" + code + "\n"}}, draws);
  };
  for (const char* bad : {"f(random.between(0, 1), random.next());", "f(a, g(r.next()), h(r.next()));",
                          "int x = random.next() + random.next();", "f(a ? random.next() : 0, random.next());",
                          "Kernel k(uniform(0, 1), uniform(2, 3));", "x = (1 + rng.unit()) * rng.unit();"}) {
    ASSERT_EQ(offences(bad).size(), 1U) << bad;
    EXPECT_EQ(offences(bad)[0].substr(0, 14), "scene/x.cpp:2:") << bad;
  }
  for (const char* good : {"f(random.between(0, random.next()));", "Kernel k{uniform(0, 1), uniform(2, 3)};",
                           "int x = random.next(), y = random.next();", "x = r.chance(50) ? r.next() : r.next();",
                           "x = r.next() >> r.between(0, 3);", "v = {r.next(), r.next()};",
                           "if (r.chance(9)) f(r.next());", "a[r.next()] = r.next();",
                           "f([&] { return r.next(); }, r.next());", "for (int i = r.next(); i < r.next();) f();"})
    EXPECT_TRUE(offences(good).empty()) << good;
}

TEST(ArchitectureMustFail, IntegersCommentsAndStringsAreAllowed) {
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
