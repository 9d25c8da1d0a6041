// SPDX-License-Identifier: Apache-2.0
// compare of pictures of other programs, of display pictures, and of an all-black one.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "base/images/image_file.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

Image ramp(int channels, float scale) {
  Image image(16, 16, channels);
  for (std::size_t at = 0; at < image.data.size(); ++at) {
    const auto pixel = at / static_cast<std::size_t>(channels);
    image.data[at] = scale * static_cast<float>(pixel) / 255.0f;
    if (channels == 4 && at % 4 == 3) image.data[at] = 1.0f;
  }
  return image;
}

class ComparePictures : public ::testing::Test {
 protected:
  /// As another program writes it: without a program name and without a declaration of its numbers.
  std::string foreign(const std::string& name, const Image& image) const {
    return undeclared(declared_linear(name, image));
  }
  /// The PNG without its declarations.
  static std::string undeclared(const std::string& path) {
    std::string bytes = read_bytes(path);
    if (const auto gamma = bytes.find("gAMA"); gamma != std::string::npos) bytes.erase(gamma - 4, 16);
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
  }
  /// The same, declared as linear.
  std::string declared_linear(const std::string& name, const Image& image) const {
    images::write_image(folder_ / name, image, {}, {.kind = images::PixelKind::Uint8});
    return folder_ / name;
  }
  Result compare(std::vector<std::string> words) const {
    words.insert(words.begin(), "compare");
    words.insert(words.end(), {"--json", folder_ / "c.json"});
    return fastsplat(words);
  }
  nlohmann::json json_of() const { return nlohmann::json::parse(read_bytes(folder_ / "c.json")); }
  TempFolder folder_;
};

TEST_F(ComparePictures, APngOfAnotherProgramIsForLooking) {
  expect_success(fastsplat(
      {"render", "--volume", "shells:8", "--size", "16", "-o", folder_ / "ours.png", "-o", folder_ / "ours.exr"}));
  const auto ours = images::read_image(folder_ / "ours.png");
  const auto theirs = foreign("theirs.png", ours.image);
  expect_success(compare({folder_ / "ours.png", theirs}));
  EXPECT_TRUE(json_of().at("identical").get<bool>());
  const auto mixed = compare({folder_ / "ours.exr", theirs});
  EXPECT_EQ(mixed.code, 4);
  EXPECT_NE(mixed.err.find("is read as a display picture"), std::string::npos) << mixed.err;
  EXPECT_EQ(mixed.err.find("--srgb"), std::string::npos) << "--srgb would refuse floats: " << mixed.err;
}

TEST_F(ComparePictures, SrgbSaysThatBothAre) {
  expect_success(fastsplat(
      {"render", "--volume", "shells:8", "--size", "16", "-o", folder_ / "ours.png", "-o", folder_ / "ours.exr"}));
  const auto tiff = foreign("theirs.tif", images::read_image(folder_ / "ours.png").image);
  expect_error(compare({folder_ / "ours.png", tiff}), 4, {"or use --srgb if both are display pictures"});
  expect_success(compare({folder_ / "ours.png", tiff, "--srgb"}));
  EXPECT_TRUE(json_of().at("identical").get<bool>());
  const auto real = compare({folder_ / "ours.png", folder_ / "ours.exr", "--srgb"});
  EXPECT_EQ(real.code, 4);
  EXPECT_NE(real.err.find("holds float values"), std::string::npos) << real.err;
}

TEST_F(ComparePictures, GreyAndOpaqueAlphaAreTheSameColours) {
  const auto grey = foreign("grey.png", ramp(1, 1.0f)), rgb = foreign("rgb.png", ramp(3, 1.0f)),
             rgba = foreign("rgba.png", ramp(4, 1.0f));
  for (const auto& other : {rgb, rgba}) {
    expect_success(compare({grey, other}));
    EXPECT_TRUE(json_of().at("identical").get<bool>()) << other;
  }
  Image glass = ramp(4, 1.0f);
  glass.data[3] = 0.5f;
  const auto refused = compare({rgb, foreign("glass.png", glass)});
  EXPECT_EQ(refused.code, 4);
  EXPECT_NE(refused.err.find("channels"), std::string::npos) << refused.err;
  EXPECT_EQ(refused.err.find("same size"), std::string::npos) << refused.err;
}

TEST_F(ComparePictures, AnAllBlackPictureIsReported) {
  const auto dim = foreign("dim.png", ramp(3, 0.02f)), black = foreign("black.png", Image(16, 16, 3));
  const auto run = compare({dim, black, "--min-psnr", "30"});
  EXPECT_EQ(run.code, 0) << "far above the limit, and yet nothing: " << run.err;
  EXPECT_NE(run.err.find("black.png is all black"), std::string::npos) << run.err;
  EXPECT_EQ(json_of().at("all_black"), black);
  EXPECT_EQ(compare({black, black}).err.find("all black"), std::string::npos);
  EXPECT_EQ(compare({dim, dim}).err.find("all black"), std::string::npos);
  EXPECT_TRUE(json_of().at("all_black").is_null());
  // Alpha is not light.
  Image veil(16, 16, 4);
  for (std::size_t at = 3; at < veil.data.size(); at += 4) veil.data[at] = 1.0f;
  EXPECT_NE(compare({foreign("lit.tif", ramp(4, 0.5f)), foreign("veil.tif", veil)}).err.find("veil.tif is all black"),
            std::string::npos);
}

TEST_F(ComparePictures, DeclarationsOfTheFilesMustAgree) {
  const auto linear = declared_linear("linear.png", ramp(3, 1.0f)), plain = foreign("plain.png", ramp(3, 1.0f));
  expect_success(compare({linear, linear}));
  const auto mixed = compare({linear, plain});
  expect_error(mixed, 4, {"linear.png: declares the encoding linear", "plain.png declares no encoding", "sRGB"});
  EXPECT_EQ(mixed.err.find("--srgb"), std::string::npos) << "--srgb would refuse it: " << mixed.err;
  expect_error(compare({linear, linear, "--srgb"}), 4, {"declares the encoding linear, which contradicts --srgb"});
  expect_success(compare({plain, plain, "--srgb"}));
}

TEST_F(ComparePictures, AlphaThatMultipliesAndAlphaThatDoesNotAreRefused) {
  Image glass = ramp(4, 1.0f);
  glass.data[3] = 0.5f;
  const auto theirs = foreign("theirs.png", glass);
  images::write_image(folder_ / "ours.png", glass, {{"display", "srgb"}}, {.kind = images::PixelKind::Uint8});
  const auto ours = undeclared(folder_ / "ours.png");
  expect_error(compare({ours, theirs}), 4, {"colours multiplied by alpha", "colours not multiplied by alpha"});
  expect_success(compare({theirs, theirs}));
}

TEST_F(ComparePictures, AHiddenErrorIsReported) {
  Image a = ramp(4, 1.0f);
  a.data[3] = 0.0f;
  Image b = a;
  b.data[0] = 1.0f;
  const auto hidden = compare({foreign("a.png", a), foreign("b.png", b)});
  EXPECT_EQ(hidden.code, 0) << hidden.err;
  EXPECT_NE(hidden.err.find("alpha is 0 in both"), std::string::npos) << hidden.err;
  EXPECT_EQ(json_of().at("worst_is_hidden"), true);
  b.data[3] = 1.0f;
  EXPECT_EQ(compare({folder_ / "a.png", foreign("b.png", b)}).err.find("alpha is 0"), std::string::npos);
  EXPECT_EQ(json_of().at("worst_is_hidden"), false);
}

TEST_F(ComparePictures, GreyWithAlphaIsRgbWithAlpha) {
  Image grey(16, 16, 4), rgb(16, 16, 3);
  for (std::size_t pixel = 0; pixel < 256; ++pixel) {
    for (std::size_t c = 0; c < 3; ++c)
      grey.data[pixel * 4 + c] = rgb.data[pixel * 3 + c] = static_cast<float>(pixel) / 255.0f;
    grey.data[pixel * 4 + 3] = 1.0f;
  }
  const auto four = foreign("four.png", grey), two = folder_ / "two.png";
  ASSERT_EQ(run_words({"oiiotool", four, "--ch", "R,A", "--chnames", "Y,A", "-d", "uint8", "-o", two}).code, 0);
  expect_success(compare({undeclared(two), foreign("three.png", rgb)}));
  EXPECT_TRUE(json_of().at("identical").get<bool>());
}

}  // namespace
}  // namespace fastsplat::cli_test
