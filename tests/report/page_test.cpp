// SPDX-License-Identifier: Apache-2.0
// Injection: with any results, the page stays a page and its data keep their values.
#include "report/page.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace fastsplat::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kPage = "<p>before</p>\r\n<!--FASTSPLAT-DATA-->\n<script>if (1 < 2) $& '</script>";

TEST(Page, HostileTextStaysText) {
  const Json hostile{{"a", "</script><script>alert(1)</script>"},
                     {"b", "<!-- <script> swallows the rest"},
                     {"c", "line\u2028and paragraph\u2029 ends, & an ampersand"},
                     {"d", "$& $1 \\ \" quotes"},
                     {"<key>", Json::array({1, 0.1, nullptr})}};
  const std::string page = filled(kPage, hostile.dump(), {});
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const auto from = page.find(begin) + begin.size();
  const std::string data = page.substr(from, page.find("</script>", from) - from);
  EXPECT_EQ(Json::parse(data), hostile);
  EXPECT_EQ(data.find_first_of("<>&"), std::string::npos);
  EXPECT_EQ(data.find("\u2028"), std::string::npos);
  EXPECT_EQ(page.find("<!--"), std::string::npos);
}

TEST(Page, EveryOtherByteIsAsItWas) {
  const std::string data =
      "<script type=\"application/json\" id=\"data\">{}</script>\n"
      "<script type=\"text/plain\" id=\"picture-0\">YWJj</script>\n";
  EXPECT_EQ(filled(kPage, "{}", {{"picture-0", "abc"}}),
            "<p>before</p>\r\n" + data + "\n<script>if (1 < 2) $& '</script>");
}

TEST(Page, TheMarkIsThereOnce) {
  EXPECT_THROW(filled("nothing", "{}", {}), std::logic_error);
  EXPECT_THROW(filled(std::string(kPage) + kPage, "{}", {}), std::logic_error);
}

/// The template that the program carries: its own policy lets nothing in or out, and it is plain ASCII.
TEST(Page, TheTemplateIsWhole) {
  const std::string& page = page_template();
  std::printf("[figure] template bytes = %zu (limit 10000..200000)\n", page.size());
  EXPECT_GT(page.size(), 10'000u);
  EXPECT_LT(page.size(), 200'000u);
  EXPECT_NO_THROW(filled(page, "{}", {}));
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  EXPECT_LT(page.find("<meta charset"), 1024u);
  for (const char c : page) ASSERT_TRUE(c == '\n' || c == '\t' || (c >= ' ' && c <= '~')) << static_cast<int>(c);
}

}  // namespace
}  // namespace fastsplat::report
