// SPDX-License-Identifier: Apache-2.0
// The plots as XML: series, points, words; and the places of points.
#include "tools/pages/family/plot.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <stdexcept>

#include "tests/index_kinds/xml_helper.hpp"
#include "tests/paths.hpp"
#include "tools/pages/family/family_plots.hpp"

namespace fastsplat::analysis {
namespace {

std::vector<std::pair<double, double>> points_of(const XmlElement& polyline) {
  std::vector<std::pair<double, double>> out;
  std::istringstream text(polyline.attributes.at("points"));
  double x = 0.0, y = 0.0;
  for (char comma = 0; text >> x >> comma >> y;) out.emplace_back(x, y);
  return out;
}

bool says(const XmlElement& svg, const std::string& words) {
  for (const XmlElement* text : svg.all("text")) {
    if (text->text == words) return true;
  }
  return false;
}

Plot two_lines() {
  return {.title = "a < b & c",
          .x_axis = "x, bits",
          .y_axis = "y, 1/255",
          .x_ticks = {},
          .series = {{"one", {{1e4, 1.0}, {1e5, 10.0}, {1e6, 100.0}}}, {"two", {{1e4, 50.0}, {1e6, 0.5}}}}};
}

TEST(Plot, HasEverySeriesEveryPointAndItsWords) {
  const XmlElement svg = parse_xml(to_svg(two_lines()));
  EXPECT_EQ(svg.name, "svg");
  const auto lines = svg.all("polyline");
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(points_of(*lines[0]).size(), 3U);
  EXPECT_EQ(points_of(*lines[1]).size(), 2U);
  for (const char* words :
       {"a < b & c", "x, bits", "y, 1/255", "one", "two", "10000", "100000", "1000000", "1", "10", "100"})
    EXPECT_TRUE(says(svg, words)) << words;
  std::printf("[figure] words = %zu\n", svg.all("text").size());
}

// A decade is a decade: equal steps along both axes, x to the right, y upwards, all within the picture.
TEST(Plot, AxesAreLogarithmic) {
  const XmlElement svg = parse_xml(to_svg(two_lines()));
  const auto line = points_of(*svg.all("polyline").at(0));
  ASSERT_EQ(line.size(), 3U);
  EXPECT_NEAR(line[1].first - line[0].first, line[2].first - line[1].first, 0.11);
  EXPECT_NEAR(line[1].second - line[0].second, line[2].second - line[1].second, 0.11);
  EXPECT_GT(line[1].first, line[0].first);
  EXPECT_LT(line[1].second, line[0].second);
  for (const auto& [x, y] : line) {
    EXPECT_TRUE(x > 0.0 && x < std::stod(svg.attributes.at("width")));
    EXPECT_TRUE(y > 0.0 && y < std::stod(svg.attributes.at("height")));
  }
  std::printf("[figure] a decade = %.1f pixels\n", line[1].first - line[0].first);
}

TEST(Plot, TheReaderRejectsInvalidXml) {
  for (const char* text : {"<a><b></a></b>", "<a x=1/>", "<a>&nbsp;</a>", "<a/><b/>", "<a x=\"1\" x=\"2\"/>", "<a>"})
    EXPECT_THROW(parse_xml(text), std::runtime_error) << text;
}

// The plots in docs/: six kinds; over the grid five points each.
TEST(Plot, ThePagesPicturesAreWhole) {
  int pictures = 0, points = 0;
  for (const char* file : kFamilyPictures) {
    std::ostringstream text;
    text << std::ifstream(std::string(FASTSPLAT_SOURCE_DIR "/docs/images/") + file).rdbuf();
    const XmlElement svg = parse_xml(text.str());
    const auto lines = svg.all("polyline");
    EXPECT_EQ(lines.size(), whole_family().kinds.size()) << file;
    for (const cmodel::IndexKind kind : whole_family().kinds) EXPECT_TRUE(says(svg, name_of(kind))) << file;
    for (const XmlElement* line : lines) {
      const auto count = points_of(*line).size();
      points += static_cast<int>(count);
      if (std::string(file) == "family-grid.svg")
        EXPECT_EQ(count, whole_family().grids.size());
      else
        EXPECT_GE(count, 3U) << file;
    }
    ++pictures;
  }
  std::printf("[figure] pictures = %d, points = %d\n", pictures, points);
}

}  // namespace
}  // namespace fastsplat::analysis
