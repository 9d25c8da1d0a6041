// SPDX-License-Identifier: Apache-2.0
// docs/gallery.md is generated from docs/gallery.toml; its pictures exist and are small; its commands run.
#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <sstream>

#include "tests/paths.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = FASTSPLAT_SOURCE_DIR;

/// The first group of every match.
std::vector<std::string> all_in(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at) found.push_back((*at)[1]);
  return found;
}

TEST(Gallery, PageIsWhatTheManifestGenerates) {
  const auto generated = run_words({kSource / "tools/helpers/gallery_page", "--markdown", kSource});
  ASSERT_EQ(generated.code, 0) << generated.err;
  EXPECT_EQ(generated.out, read_bytes(kSource / "docs/gallery.md"))
      << "run tools/gallery, look at the pictures, commit";
}

TEST(Gallery, PicturesAndPagesAreThere) {
  constexpr std::uintmax_t kLargest = 60000;  // bytes
  const auto page = read_bytes(kSource / "docs/gallery.md");
  const auto pictures = all_in(page, R"(\]\((images/gallery/[^)]+)\))");
  std::uintmax_t largest = 0;
  for (const auto& picture : pictures) {
    ASSERT_TRUE(fs::exists(kSource / "docs" / picture)) << picture;
    EXPECT_EQ(read_bytes(kSource / "docs" / picture).substr(1, 3), "PNG") << picture;
    EXPECT_LE(fs::file_size(kSource / "docs" / picture), kLargest) << picture;
    largest = std::max(largest, fs::file_size(kSource / "docs" / picture));
  }
  const auto pages = all_in(page, R"(\[How and how well\]\(([^)]+)\))");
  for (const auto& name : pages) EXPECT_TRUE(fs::exists(kSource / "docs" / name)) << name;
  std::printf("[figure] gallery_pictures = %zu, largest %ju bytes (limit %ju)\n", pictures.size(), largest, kLargest);
  ASSERT_GT(pictures.size(), 0u);
  ASSERT_GT(pages.size(), 0u);
  // No picture without an entry.
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(kSource / "docs/images/gallery")) ++files;
  EXPECT_EQ(files, pictures.size());
}

std::size_t number_at(const std::string& bytes, std::size_t at) {
  std::size_t number = 0;
  for (std::size_t i = at; i < at + 4; ++i) number = number << 8 | static_cast<unsigned char>(bytes.at(i));
  return number;
}

/// The origin in the PNG (its tEXt chunks "fastsplat:...") in lines, without its size.
std::vector<std::string> origin_of(const fs::path& png) {
  const std::string bytes = read_bytes(png);
  std::vector<std::string> lines;
  for (std::size_t at = 8; at + 12 <= bytes.size(); at += 12 + number_at(bytes, at)) {
    const std::string chunk = bytes.substr(at + 8, number_at(bytes, at));
    if (bytes.compare(at + 4, 4, "tEXt") != 0 || !chunk.starts_with("fastsplat:")) continue;
    std::istringstream text(chunk.substr(std::string("fastsplat:").size()));
    std::string table;
    for (std::string line; std::getline(text, line);) {
      if (line.starts_with("[")) table = line;
      if (!line.empty() && table != "[image]") lines.push_back(table + line);
    }
  }
  return lines;
}

// When a command or a built-in scene changes, its picture is out of date; the picture records its inputs. Settings
// newer than the picture are at their default, or it would have been rendered again.
TEST(Gallery, EveryCommandRunsAndMakesItsPicture) {
  const TempFolder folder;
  const bool scans = fastsplat({"volume", "info", "ch2bet"}).code == 0;
  const auto page = read_bytes(kSource / "docs/gallery.md");
  const auto commands = all_in(page, "`fastsplat ((?:render|compare) [^`]+)`");
  const auto pictures = all_in(page, R"(\]\((images/gallery/[^)]+)\))");
  ASSERT_EQ(commands.size(), pictures.size());
  int ran = 0, skipped = 0, differences = 0;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    const std::string& command = commands[i];
    if (command.starts_with("compare ")) {  // of two pictures of this page
      ++differences;
      for (const std::string& name : all_in(command, R"(([^ ]+)\.exr)"))
        EXPECT_NE(std::ranges::find(pictures, "images/gallery/" + name + ".png"), pictures.end()) << command;
      continue;
    }
    if (!scans && command.find("ch2") != std::string::npos) {
      ++skipped;
      continue;
    }
    // As small as possible: this tests the flags, not the picture.
    std::istringstream words(std::regex_replace(command, std::regex(" --size [^ ]+"), "") + " --size 20 --quiet");
    std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
    arguments.insert(arguments.end(), {"--out", folder / "picture.png"});
    SCOPED_TRACE(command);
    expect_success(fastsplat(arguments));
    const auto now = origin_of(folder / "picture.png");
    const auto then = origin_of(kSource / "docs" / pictures[i]);
    // A scene of Gaussians has fewer lines, because its view is one of them.
    const bool gaussians = command.find("--gaussians") != std::string::npos;
    EXPECT_GT(then.size(), gaussians ? 6u : 10u) << pictures[i] << " does not state its origin";
    for (const auto& line : then) {
      if (line.starts_with("version")) continue;  // a release changes no picture
      EXPECT_NE(std::find(now.begin(), now.end(), line), now.end())
          << pictures[i] << " was made by another command or scene: " << line << "; run tools/gallery";
    }
    ++ran;
  }
  std::printf("[figure] gallery_commands = %d (limit > 0), differences = %d%s\n", ran, differences,
              skipped > 0 ? ", those on mricron-data's scans skipped: package not installed" : "");
  ASSERT_GT(ran, 0);
  EXPECT_GT(differences, 0);
}

TEST(GalleryMustFail, AnErrorInAManifestIsLocated) {
  const TempFolder folder;
  fs::create_directory(folder / "docs");
  const std::string good =
      "[[picture]]\nsection = \"a\"\npage = \"b\"\nname = \"c\"\ntitle = \"d\"\narguments = \"e\"\ncaption = \"f\"\n";
  struct Bad {
    std::string text, said;
  };
  for (const Bad& bad : {Bad{good + "captoin = \"g\"\n", ":8: unknown key captoin"},
                         Bad{good + "[[picture]]\nname = \"x\"\n", "lacks the key section"},
                         Bad{good + good, "duplicate picture name c"}, Bad{good + "enlarge = 3\n", ":8: expected"}}) {
    folder.write("docs/gallery.toml", bad.text);
    const auto result = run_words({kSource / "tools/helpers/gallery_page", "--markdown", folder.path()});
    EXPECT_NE(result.err.find(bad.said), std::string::npos) << result.err;
  }
  folder.write("docs/gallery.toml", good);
  EXPECT_NE(
      run_words({kSource / "tools/helpers/gallery_page", "--markdown", folder.path()}).out.find("images/gallery/c.png"),
      std::string::npos);
}

}  // namespace
}  // namespace fastsplat::cli_test
