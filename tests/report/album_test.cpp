// SPDX-License-Identifier: Apache-2.0
// Pictures of a report: what they stand for, which are identical, and how they are cropped.
#include "report/album.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/error.hpp"
#include "base/images/image_file.hpp"
#include "report/report.hpp"
#include "tests/images/image_helper.hpp"

namespace fastsplat::report {
namespace {

class Pictures : public ::testing::Test {
 protected:
  static Image noise(int side, unsigned seed) {
    std::mt19937 random(seed);
    Image image(side, side);
    for (auto& value : image.data) value = static_cast<float>(random() % 65536) / 65536.0f;
    return image;
  }
  std::string exr(const std::string& name, const Image& image, const images::Metadata& metadata = {}) const {
    images::write_image(folder_ / name, image, metadata, {.kind = images::PixelKind::Float});
    return (folder_ / name).string();
  }
  std::string raw(const std::string& name, const Image& image, images::Metadata metadata = {}) const {
    std::vector<std::uint32_t> words;
    for (const float value : image.data) words.push_back(static_cast<std::uint32_t>(std::lround(value * 65536.0f)));
    images::write_raw(folder_ / name,
                      {.width = image.width, .height = image.height, .int_bits = 0, .frac_bits = 16, .words = words},
                      std::move(metadata));
    return (folder_ / name).string();
  }
  static NamedPicture named(const std::string& role, const std::string& file) {
    return {.role = role, .file = file, .otherwise = role, .wanted = true};
  }
  images::TempFolder folder_;
};

TEST_F(Pictures, RawWordsAndFloatsOfTheSameValuesAreOne) {
  const Image image = noise(16, 1);
  const images::Metadata same{{"scene", "s"}};
  const auto of_raw = load_picture("integer", raw("raw.exr", image, same));
  EXPECT_EQ(of_raw.scale, 65536);
  EXPECT_EQ(of_raw.frac_bits, 16);
  EXPECT_EQ(of_raw.int_bits, 0);
  auto of_float = load_picture("integer", exr("f.exr", image, same));
  EXPECT_TRUE(of_float.exact);
  EXPECT_TRUE(same_values(of_raw, of_float));
  of_float.words[7] += 1;
  EXPECT_FALSE(same_values(of_raw, of_float));
}

TEST_F(Pictures, ValuesBetweenWordsAreRoundedAndMarked) {
  Image image(4, 1, 1);
  image.data = {1.0f / 3.0f, -0.5f, 70000.0f, std::nanf("")};
  const auto picture = load_picture("golden", exr("f.exr", image));
  EXPECT_FALSE(picture.exact);
  EXPECT_EQ(picture.nonfinite, 1u);
  EXPECT_LT(picture.frac_bits, 16) << "70000 leaves fewer bits of 32";
  EXPECT_NEAR(static_cast<double>(picture.words[0]) / static_cast<double>(picture.scale), 1.0 / 3.0,
              0.5 / static_cast<double>(picture.scale));
  EXPECT_EQ(picture.words[1] * 2, -picture.scale);
  const Pages pages = fit({{picture}, {}}, {}, 1000000);
  EXPECT_EQ(pages.entries[0]["signed"], true);
  EXPECT_EQ(pages.entries[0]["nonfinite"], 1);
}

TEST_F(Pictures, EqualOnesLieInThePageOnce) {
  const Image image = noise(16, 2);
  const auto album = load_album({named("rtl", raw("rtl.exr", image)), named("integer", raw("cmodel.exr", image)),
                                 named("golden", exr("golden.exr", noise(16, 3)))});
  ASSERT_EQ(album.pictures.size(), 3u);
  EXPECT_EQ(album.pictures[0].role, "golden") << "in the viewer's order";
  const Pages pages = fit(album, {}, 1000000);
  EXPECT_EQ(pages.blocks.size(), 2u);
  EXPECT_EQ(pages.entries[2]["role"], "rtl");
  EXPECT_EQ(pages.entries[2]["same_as"], pages.entries[1]["id"]);
}

TEST_F(Pictures, TheWindowThatFitsKeepsTheWorstPixel) {
  const auto album =
      load_album({named("golden", exr("a.exr", noise(256, 4))), named("integer", raw("b.exr", noise(256, 5)))});
  const std::size_t limit = 300'000;
  const Pages pages = fit(album, {.x = 250, .y = 3}, limit);
  std::size_t bytes = 0;
  for (const auto& block : pages.blocks) bytes += (block.bytes.size() + 2) / 3 * 4;
  std::printf("[figure] bytes of two cropped pictures = %zu (limit %zu)\n", bytes, limit);
  EXPECT_LE(bytes, limit);
  EXPECT_GT(bytes, limit / 2) << "smaller than it need be";
  for (const Json& entry : pages.entries) {
    const int x = entry["crop"]["x"], y = entry["crop"]["y"], width = entry["width"], height = entry["height"];
    EXPECT_TRUE(x <= 250 && 250 < x + width && y <= 3 && 3 < y + height) << entry.dump();
    EXPECT_EQ(entry["crop"], pages.entries[0]["crop"]) << "every pane shows the same window";
    EXPECT_EQ(entry["crop"]["full_width"], 256);
  }
  EXPECT_EQ(pages.remarks.size(), 2u) << "the page says so";
}

TEST_F(Pictures, AResultsPicturesAreFoundBesideIt) {
  exr("golden.exr", noise(8, 6), {{"engine", "golden"}, {"scene", "s"}});
  raw("raw.exr", noise(8, 7), {{"engine", "cmodel"}, {"scene", "s"}});
  const Json render{{"verb", "render"},
                    {"engine", "cmodel"},
                    {"raw", "/elsewhere/raw.exr"},
                    {"outputs", Json::array({"/elsewhere/a.png"})}};
  const Json compare{
      {"verb", "compare"}, {"ref", {{"file", "/elsewhere/golden.exr"}}}, {"test", {{"file", "/elsewhere/gone.exr"}}}};
  std::vector<NamedPicture> pictures;
  for (const Json& json : {render, compare}) {
    for (auto& picture : pictures_of({folder_ / "r.json", json["verb"], json})) pictures.push_back(picture);
  }
  const Album album = load_album(pictures);
  ASSERT_EQ(album.pictures.size(), 2u);
  EXPECT_EQ(album.pictures[0].role, "golden");
  EXPECT_EQ(album.pictures[1].role, "integer");
  ASSERT_EQ(album.missing.size(), 1u);
  EXPECT_NE(album.missing[0].find("gone.exr"), std::string::npos);
}

/// Two files of one name: the compare's order decides which is the reference, not the name.
TEST_F(Pictures, NameTheirSideAndCompare) {
  std::filesystem::create_directory(folder_ / "a");
  std::filesystem::create_directory(folder_ / "b");
  const std::string ref = exr("a/out.exr", noise(8, 9)), test = exr("b/out.exr", noise(8, 10));
  const Json compare{{"verb", "compare"},
                     {"verdict", "pass"},
                     {"identical", false},
                     {"psnr_db", 40.0},
                     {"max_abs_lsb", 1.0},
                     {"ref", {{"file", ref}}},
                     {"test", {{"file", test}}},
                     {"percentiles_lsb", Json::object()},
                     {"floor", Json::object()},
                     {"histogram", Json::array()},
                     {"clusters", Json::array()},
                     {"limits", Json::array()},
                     {"width", 8u},
                     {"height", 8u},
                     {"lsb_bits", 8u}};
  const Json other{{"verb", "stream record"}, {"stream", "s.fss"}};
  const std::string html =
      make_report({.results = {{folder_ / "s.json", "stream record", other}, {folder_ / "c.json", "compare", compare}},
                   .pictures = {}})
          .html;
  const std::string mark = "id=\"data\">";
  const auto from = html.find(mark) + mark.size();
  const Json data = Json::parse(html.substr(from, html.find("</script>", from) - from));
  ASSERT_EQ(data["pictures"].size(), 2u);
  EXPECT_EQ(data["pictures"][0]["compared"], Json::array({"1.ref"}));
  EXPECT_EQ(data["pictures"][1]["compared"], Json::array({"1.test"}));
  EXPECT_EQ(data["pictures"][0]["from"], data["results"][1]["ref"]["file"]);
  EXPECT_EQ(data["pictures"][1]["from"], data["results"][1]["test"]["file"]);
  EXPECT_NE(data["pictures"][0]["from"], data["pictures"][1]["from"]);
  EXPECT_EQ(data["pictures"][0]["group"], data["pictures"][1]["group"]) << "pictures of one compare are seen together";
}

/// A scene of Gaussians is not one of a volume: the two are not compared, nor are two views of one cloud.
TEST_F(Pictures, OfGaussiansAreAGroupByTheirView) {
  const auto cloud = [&](const char* name, const char* view, unsigned seed) {
    return named("golden",
                 exr(name, noise(8, seed), {{"gaussians", "built-in"}, {"content_hash", "1"}, {"view", view}}));
  };
  const Pages pages =
      fit(load_album({named("golden", exr("volume.exr", noise(8, 11), {{"scene", "s"}})), cloud("a.exr", "front", 12),
                      cloud("b.exr", "front", 13), cloud("c.exr", "side", 14)}),
          {}, 1000000);
  std::vector<int> groups;
  for (const Json& entry : pages.entries) groups.push_back(entry["group"].get<int>());
  EXPECT_EQ(groups, (std::vector{0, 1, 1, 2}));
  EXPECT_EQ(pages.entries[1]["gaussians"], "built-in");
}

TEST_F(Pictures, OfTheUserMustBeThereAndHaveARole) {
  EXPECT_THROW(load_album({picture_from("golden=" + (folder_ / "none.exr").string())}), UserError);
  for (const std::string bad : {"golden.exr", "=a.exr", "golden=", "Golden=a.exr", "a b=c"})
    EXPECT_THROW(picture_from(bad), UserError) << bad;
  EXPECT_EQ(picture_from("step-2=a=b.exr").file, "a=b.exr");
}

TEST_F(Pictures, TheSameRequestGivesTheSameBytes) {
  const Request request{.results = {}, .pictures = {named("golden", exr("a.exr", noise(32, 8)))}};
  const Report first = make_report(request), second = make_report(request);
  EXPECT_EQ(first.html, second.html);
  EXPECT_EQ(first.pictures, 1u);
  EXPECT_EQ(first.verdict.status, Status::Measured);
}

}  // namespace
}  // namespace fastsplat::report
