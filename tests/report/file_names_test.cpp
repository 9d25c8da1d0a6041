// SPDX-License-Identifier: Apache-2.0
// A report to be sent names files, not the folders and users of the machine.
#include "report/file_names.hpp"

#include <gtest/gtest.h>

#include "base/images/image_file.hpp"
#include "report/report.hpp"
#include "tests/images/image_helper.hpp"

namespace fastsplat::report {
namespace {

std::string shown(const std::string& text) { return without_folders(Json(text)).get<std::string>(); }

TEST(FileNames, PathsBecomeNamesWhereverTheyStand) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"/Users/jane/scan.nii.gz", "scan.nii.gz"},
      {"/Users/jane/my scans/scan 1.nii", "scan 1.nii"},
      {"/home/O'Neil/scan.nii", "scan.nii"},
      {"~/scans/a.nii", "a.nii"},
      {"~jane/a.nii", "a.nii"},
      {"../jane/a.nii", "a.nii"},
      {"../../a.nii", "a.nii"},
      {"file:///Users/jane/a.html", "a.html"},
      {"/Users/jane", "."},
      {"/Users/jane/", "."},
      {"/srv/jane/results/", "results/"},
      {"fastsplat compare /Users/jane/a.exr '/Users/jane doe/b c.exr' --map=/srv/jane/m.png -o/srv/jane/x.png --quiet",
       "fastsplat compare a.exr 'b c.exr' --map=m.png -ox.png --quiet"},
      {"fastsplat info '/home/O'\\''Neil/x.exr' --json", "fastsplat info 'x.exr' --json"},
      {"volume = \"/Users/jane doe/a \\\"b\\\".nii\"\nwidth = 8\n", "volume = \"a \\\"b\\\".nii\"\nwidth = 8\n"},
      {"/Users/jane/a.exr: no such file (expected /srv/jane/b.exr, or ../x/c.exr).",
       "a.exr: no such file (expected b.exr, or c.exr)."},
      {"ROLE=/Users/jane/a.exr,/Users/jane/b.exr", "ROLE=a.exr,b.exr"},
      {"C:/Users/jane/a.exr", "C:a.exr"}};
  for (const auto& [text, wanted] : cases) EXPECT_EQ(shown(text), wanted);
  std::printf("[figure] texts with paths = %zu (limit > 0)\n", cases.size());
}

TEST(FileNames, OtherTextStaysAsItIs) {
  for (const std::string text :
       {"demo/golden.exr", "golden.exr", "1/255 of full brightness", "a / b", "and/or", "n/m and -1/255 of it",
        "https://example.org/a/b", "about ~5/8", "// a comment of the RTL", "/* as /such */", "a ~ b/c", "", "/",
        "12 KB/s", "2026/11/27", "rtl/cull/fastsplat_cull.sv:12"})
    EXPECT_EQ(shown(text), text);
}

TEST(FileNames, ValuesAndKeysOfAnyDepthAreSeen) {
  const Json data{{"/Users/jane/key.sv", Json::array({1, nullptr, true, {{"file", "/Users/jane/a.exr"}}})},
                  {"number", 0.25}};
  EXPECT_EQ(without_folders(data),
            Json({{"key.sv", Json::array({1, nullptr, true, {{"file", "a.exr"}}})}, {"number", 0.25}}));
}

TEST(FileNames, EqualNamesOfTwoFoldersAreDisambiguated) {
  const Json data{
      {"command", "fastsplat compare /Users/jane/a/out.exr /Users/jane/b/out.exr --map /Users/jane/b/map.png"},
      {"ref", "/Users/jane/a/out.exr"},
      {"test", "/Users/jane/b/out.exr"}};
  const Json cut = without_folders(data);
  EXPECT_EQ(cut["command"], "fastsplat compare out.exr folder-2/out.exr --map folder-2/map.png");
  EXPECT_EQ(cut["ref"], "out.exr");
  EXPECT_EQ(cut["test"], "folder-2/out.exr");
}

/// A shell's quotes within quotes are not another folder.
TEST(FileNames, AFolderIsOneInACommandAndElsewhere) {
  const Json data{{"command", "fastsplat compare '/home/O'\\''Neil/a.exr' '/home/O'\\''Neil/b.exr'"},
                  {"file", "/home/O'Neil/b.exr"}};
  EXPECT_EQ(without_folders(data)["command"], "fastsplat compare 'a.exr' 'b.exr'");
  EXPECT_EQ(without_folders(data)["file"], "b.exr");
}

/// A message does not quote its files; the text around a path shows where it ends.
TEST(FileNames, FoldersWithBlanksLeaveMessagesToo) {
  const Json data{{"file", "/Users/jane doe/a.exr"}, {"remark", "cannot open /Users/jane doe/b.exr: no such file"}};
  EXPECT_EQ(without_folders(data)["remark"], "cannot open b.exr: no such file");
}

/// The whole page: its data as well as what describes its pictures.
TEST(FileNames, NoFolderIsInAPage) {
  const images::TempFolder folder;
  const std::string here = (folder / "a").parent_path().string();
  Image image(8, 8);
  for (auto& value : image.data) value = 0.5f;
  for (const char* name : {"a.exr", "b.exr"})
    images::write_image(folder / name, image, {{"volume", (folder / "scan.nii").string()}},
                        {.kind = images::PixelKind::Float});
  const auto path = [&](const char* name) { return (folder / name).string(); };
  const Json compare{{"verb", "compare"},
                     {"verdict", "pass"},
                     {"identical", true},
                     {"max_abs_lsb", 0.0},
                     {"ref", {{"file", path("a.exr")}}},
                     {"test", {{"file", path("gone.exr")}}},
                     {"percentiles_lsb", Json::object()},
                     {"floor", Json::object()},
                     {"histogram", Json::array()},
                     {"clusters", Json::array()},
                     {"limits", Json::array()},
                     {"width", 8u},
                     {"height", 8u},
                     {"lsb_bits", 8u},
                     {"command", "fastsplat compare " + path("a.exr") + " " + path("gone.exr")}};
  const Request request{
      .results = {{folder / "compare.json", "compare", compare}},
      .pictures = {{.role = "other", .file = folder / "b.exr", .otherwise = "other", .wanted = true}}};
  const Report report = make_report(request);
  EXPECT_EQ(report.pictures, 2u);
  EXPECT_NE(report.remarks.at(0).find(here), std::string::npos) << "the terminal shows where";
  const std::string parent = std::filesystem::path(here).filename().string();
  std::size_t found = 0;
  for (auto at = report.html.find(parent); at != std::string::npos; at = report.html.find(parent, at + 1)) ++found;
  std::printf("[figure] folder names in a page = %zu (limit 0)\n", found);
  EXPECT_EQ(found, 0u);
  EXPECT_NE(report.html.find("\"from\":\"a.exr\""), std::string::npos);
}

}  // namespace
}  // namespace fastsplat::report
