// Every relative link of README.md and docs/ leads to a file that is there, and to a heading of it.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "base/read_file.hpp"
#include "tests/paths.hpp"

namespace fastsplat::cli {
namespace {

namespace fs = std::filesystem;

/// A page without its code blocks, whose brackets are no links.
std::string prose_of(const fs::path& page) {
  std::istringstream lines(read_text_file(page.string()));
  std::string text;
  bool code = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("```")) code = !code;
    if (!code) text += line + "\n";
  }
  return text;
}

/// A heading's anchor as GitHub makes it, of ASCII; bytes of other characters are kept.
std::string anchor_of(const std::string& heading) {
  // A link in a heading counts by its text.
  std::string anchor;
  for (const char c : std::regex_replace(heading, std::regex(R"(\[([^\]]*)\]\([^)]*\))"), "$1")) {
    if (c == ' ') anchor += '-';
    if (c >= 'A' && c <= 'Z') anchor += static_cast<char>(c - 'A' + 'a');
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || (c & 0x80)) anchor += c;
  }
  return anchor;
}

const std::set<std::string>& anchors_of(const fs::path& page) {
  static std::map<fs::path, std::set<std::string>> known;
  const auto [at, fresh] = known.try_emplace(fs::canonical(page));
  std::set<std::string>& anchors = at->second;
  if (!fresh) return anchors;
  std::istringstream lines(prose_of(page));
  for (std::string line; std::getline(lines, line);) {
    const auto level = line.find_first_not_of('#');
    if (level == line.npos || level == 0 || line[level] != ' ') continue;
    std::string anchor = anchor_of(line.substr(level + 1));
    for (int again = 1; !anchors.insert(anchor).second; ++again)
      anchor = anchor_of(line.substr(level + 1)) + "-" + std::to_string(again);
  }
  return anchors;
}

/// Links of `page` that lead nowhere.
std::vector<std::string> broken_links(const fs::path& page, int& links) {
  static const std::regex link(R"(\]\(([^)\s]+)\)|(?:src|href)="([^"]+)\")");
  const std::string text = prose_of(page);
  std::vector<std::string> broken;
  for (std::sregex_iterator at(text.begin(), text.end(), link), end; at != end; ++at) {
    const std::string target = (*at)[1].matched ? (*at)[1].str() : (*at)[2].str();
    if (target.find("://") != target.npos) continue;
    ++links;
    const auto hash = target.find('#');
    const fs::path file = hash == 0 ? page : page.parent_path() / target.substr(0, hash);
    if (!fs::exists(file) ||
        (hash != target.npos && file.extension() == ".md" && !anchors_of(file).contains(target.substr(hash + 1))))
      broken.push_back(target);
  }
  return broken;
}

TEST(Links, LeadToFilesAndHeadings) {
  const fs::path root = FASTSPLAT_SOURCE_DIR;
  std::vector<fs::path> pages{root / "README.md"};
  for (const auto& entry : fs::recursive_directory_iterator(root / "docs")) {
    if (entry.path().extension() == ".md") pages.push_back(entry.path());
  }
  int links = 0;
  for (const auto& page : pages) {
    for (const auto& target : broken_links(page, links))
      ADD_FAILURE() << fs::relative(page, root).string() << ": " << target;
  }
  std::printf("[figure] links = %d (limit > 100), pages = %zu\n", links, pages.size());
  EXPECT_GT(links, 100) << "nothing was checked";
}

TEST(LinksMustFail, SeeAFileAndAHeadingThatAreNotThere) {
  const fs::path page = fs::path(::testing::TempDir()) / "links_page.md";
  std::ofstream(page)
      << "# One: `two` [three](x)\n[a](#one-two-three) [b](#two) [c](not-there.md) [d](links_page.md#one)\n"
         "```\n[e](code.md)\n```\n";
  int links = 0;
  EXPECT_EQ(broken_links(page, links), (std::vector<std::string>{"x", "#two", "not-there.md", "links_page.md#one"}));
  EXPECT_EQ(links, 5);
  fs::remove(page);
}

}  // namespace
}  // namespace fastsplat::cli
