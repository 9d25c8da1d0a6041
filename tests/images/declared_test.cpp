// SPDX-License-Identifier: Apache-2.0
// Declarations of files about their numbers are followed, or refused by name.
#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/images/image_file.hpp"
#include "tests/images/image_helper.hpp"
#include "tests/images/png_helper.hpp"

namespace fastsplat::images {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Declares = std::pair<std::string, std::string>;

std::string cicp(char primaries, char transfer) { return chunk("cICP", {primaries, transfer, '\0', '\1'}); }

/// White, red, green, blue.
std::string chrm(const std::array<int, 8>& numbers) {
  std::string data;
  for (const int number : numbers) data += big_endian(static_cast<std::uint32_t>(number));
  return chunk("cHRM", data);
}

class Declared : public ::testing::Test {
 protected:
  /// A PNG of `lines` with more chunks before its pixels.
  LoadedImage png(int width, int depth, int colour, const std::vector<std::string>& lines, const std::string& more = {},
                  int interlace = 0) const {
    write_bytes(folder_ / "a.png", kSignature +
                                       header(static_cast<std::uint32_t>(width), height_, depth, colour, interlace) +
                                       more + chunk("IDAT", deflated(rows(lines))) + kEnd);
    return read_image(folder_ / "a.png");
  }
  std::string refused(const std::string& name) const {
    return refusal(ExitCode::Input, [&] { read_image(folder_ / name); });
  }
  /// An 8 x 8 file whose channel c holds c/8.
  void write(const std::string& name, const std::vector<std::string>& channels,
             const std::function<void(OIIO::ImageSpec&)>& change = {}) const {
    const auto count = static_cast<int>(channels.size());
    OIIO::ImageSpec spec(8, 8, count, OIIO::TypeDesc::FLOAT);
    spec.channelnames = channels;
    spec.alpha_channel = -1;
    if (change) change(spec);
    std::vector<float> samples;
    for (int i = 0; i < 64 * count; ++i) samples.push_back(static_cast<float>(i % count) / 8.0f);
    const auto output = OIIO::ImageOutput::create(name);
    ASSERT_TRUE(output && output->open((folder_ / name).string(), spec)) << OIIO::geterror();
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, samples.data())) << output->geterror();
    ASSERT_TRUE(output->close());
  }
  /// The file again, with its channel list changed.
  void change_channels(const std::string& name, const std::function<void(std::string&, std::size_t)>& change) const {
    std::string bytes = file_text(folder_ / name);
    const std::string before = std::string("channels\0chlist\0", 16);
    const auto at = bytes.find(before);
    ASSERT_NE(at, std::string::npos);
    change(bytes, at + before.size() + 4);
    write_bytes(folder_ / name, bytes);
  }

  TempFolder folder_;
  std::uint32_t height_ = 1;
};

TEST_F(Declared, ThePngTransferIsRead) {
  const std::string linear = chunk("gAMA", big_endian(100000)), half = chunk("gAMA", big_endian(50000)),
                    srgb = chunk("sRGB", std::string(1, '\0')),
                    usual = chrm({31270, 32900, 64000, 33000, 30000, 60000, 15000, 6000}),
                    wide = chrm({31270, 32900, 68000, 32000, 26500, 69000, 15000, 6000});
  const std::vector<Declares> all{{"", ""},
                                  {linear, "linear"},
                                  {chunk("gAMA", big_endian(45455)), "sRGB"},
                                  {half, "gamma 0.500000"},
                                  {half + srgb, "sRGB"},
                                  {srgb, "sRGB"},
                                  {usual, "sRGB"},
                                  {linear + usual, "linear"},
                                  {wide, "sRGB with primaries 0.68 0.32 0.265 0.69 0.15 0.06 0.3127 0.329"},
                                  {cicp(9, 16), "video code points 9, 16"},
                                  {cicp(1, 13), "sRGB"},
                                  {cicp(1, 13) + half, "sRGB"}};
  for (const auto& [chunks, encoding] : all) {
    const auto read = png(3, 8, 0, {"abc"}, chunks);
    EXPECT_EQ(read.encoding, encoding);
    EXPECT_EQ(encoding_of(read), encoding.empty() ? "sRGB" : encoding);
  }
  std::printf("[figure] declarations = %zu\n", all.size());
}

TEST_F(Declared, EveryPngLayoutIsRead) {
  const std::string palette = chunk("PLTE", std::string("\x00\x00\x00\xff\x00\x33", 6));
  EXPECT_THAT(png(2, 1, 0, {"\x40"}).image.data, ElementsAre(0.0f, 1.0f));
  EXPECT_THAT(png(4, 2, 0, {"\x1b"}).image.data, ElementsAre(0.0f, 85 / 255.0f, 170 / 255.0f, 1.0f));
  EXPECT_THAT(png(2, 4, 0, {"\x5f"}).image.data, ElementsAre(85 / 255.0f, 1.0f));
  EXPECT_THAT(png(2, 8, 3, {std::string("\1\0", 2)}, palette).image.data,
              ElementsAre(1.0f, 0.0f, 0.2f, 0.0f, 0.0f, 0.0f));
  const auto clear = png(2, 8, 3, {std::string("\1\0", 2)}, palette + chunk("tRNS", std::string("\x33", 1)));
  EXPECT_THAT(clear.image.data, ElementsAre(1.0f, 0.0f, 0.2f, 1.0f, 0.0f, 0.0f, 0.0f, 0.2f));
  EXPECT_TRUE(clear.unassociated);
  // One grey is transparent.
  const auto key = png(2, 8, 0, {"\x33\xff"}, chunk("tRNS", std::string("\0\x33", 2)));
  EXPECT_THAT(key.image.data, ElementsAre(0.2f, 0.2f, 0.2f, 0.0f, 1.0f, 1.0f, 1.0f, 1.0f));
  const auto grey = png(2, 8, 4, {std::string("\x33\xff\xff\0", 4)});
  EXPECT_EQ(grey.image.channels, 4);
  EXPECT_THAT(grey.image.data, ElementsAre(0.2f, 0.2f, 0.2f, 1.0f, 1.0f, 1.0f, 1.0f, 0.0f));
  height_ = 2;
  // Adam7 of 2 x 2: the first pixel, then that on its right, then the row below.
  EXPECT_THAT(png(2, 8, 0, {"\x33", "\x66", "\x99\xcc"}, {}, 1).image.data, ElementsAre(0.2f, 0.4f, 0.6f, 0.8f));
}

TEST_F(Declared, AnAnimatedPngIsRefused) {
  const std::string frames = big_endian(2) + big_endian(0);
  EXPECT_THAT(refusal(ExitCode::Input, [&] { png(3, 8, 0, {"abc"}, chunk("acTL", frames)); }),
              HasSubstr("several images in one file"));
}

TEST_F(Declared, ExrChannelsAreFoundByName) {
  for (const std::string prefix : {"", "Le", "diffuse.", "A.", "R"}) {
    write("a.exr", {prefix + "R", prefix + "G", prefix + "B"});
    const auto read = read_image(folder_ / "a.exr");
    ASSERT_EQ(read.image.channels, 3) << prefix;
    EXPECT_EQ(read.image.pixel(3, 3)[0], 0.0f) << prefix;
    EXPECT_EQ(read.image.pixel(3, 3)[1], 0.125f) << prefix;
    EXPECT_EQ(read.image.pixel(3, 3)[2], 0.25f) << prefix;
  }
  write("a.exr", {"LR", "LG", "LB", "LA"});
  EXPECT_EQ(read_image(folder_ / "a.exr").image.pixel(7, 0)[3], 0.375f);
  write("a.exr", {"Y", "A"});
  const auto grey = read_image(folder_ / "a.exr");
  EXPECT_EQ(std::vector(grey.image.pixel(1, 1), grey.image.pixel(1, 1) + 4), (std::vector{0.0f, 0.0f, 0.0f, 0.125f}));
  write("a.exr", {"Z"});
  EXPECT_EQ(read_image(folder_ / "a.exr").grey, "Z");
  for (const std::vector<std::string>& names :
       std::vector<std::vector<std::string>>{{"x.R", "y.G", "z.B"}, {"R", "G"}, {"R", "G", "B", "A", "Z"}}) {
    write("a.exr", names);
    EXPECT_THAT(refused("a.exr"), HasSubstr("RGB or RGBA"));
  }
}

TEST_F(Declared, ExrChannelsThatAreNotSortedAreDamage) {
  write("a.exr", {"R", "G", "B", "A"});
  // Names and words of a channel are 18 bytes: A, B, G, R.
  change_channels("a.exr", [](std::string& bytes, std::size_t at) { std::swap(bytes[at], bytes[at + 3 * 18]); });
  EXPECT_THAT(refused("a.exr"), HasSubstr("corrupt or truncated EXR: the channel list is not sorted by name"));
  write("a.exr", {"R", "G", "B", "A"});
  change_channels("a.exr", [](std::string& bytes, std::size_t at) { bytes[at + 18] = 'A'; });
  EXPECT_THAT(refused("a.exr"), HasSubstr("not sorted by name")) << "twice the same";
}

TEST_F(Declared, SubsampledExrIsCalledSo) {
  for (const std::size_t word : {10u, 14u}) {
    write("a.exr", {"R", "G", "B"});
    change_channels("a.exr", [&](std::string& bytes, std::size_t at) { bytes[at + word] = 2; });
    EXPECT_THAT(refused("a.exr"), HasSubstr("luminance/chroma EXR")) << word;
  }
  write("a.exr", {"BY", "RY", "Y"});
  EXPECT_THAT(refused("a.exr"), HasSubstr("luminance/chroma EXR"));
}

TEST_F(Declared, ExrPrimariesAreNamed) {
  std::array<float, 8> primaries{0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
  const auto encoding = [&] {
    write("a.exr", {"R", "G", "B"}, [&](OIIO::ImageSpec& spec) {
      spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), primaries.data());
    });
    return encoding_of(read_image(folder_ / "a.exr"));
  };
  EXPECT_EQ(encoding(), "linear");
  primaries[0] = 0.7347f;
  EXPECT_THAT(encoding(), HasSubstr("linear with primaries 0.7347 0.33"));
}

TEST_F(Declared, ExrColourSpacesAreNamed) {
  const auto encoding = [&](const auto& declare) {
    write("a.exr", {"R", "G", "B"}, declare);
    return encoding_of(read_image(folder_ / "a.exr"));
  };
  const auto interop = [&](const char* id) {
    return encoding([&](OIIO::ImageSpec& spec) { spec.attribute("colorInteropID", id); });
  };
  EXPECT_EQ(interop("lin_rec709_scene"), "linear");
  EXPECT_EQ(interop("srgb_rec709_scene"), "sRGB");
  EXPECT_EQ(interop("g22_rec709_scene"), "colour space 'g22_rec709_scene'");
  EXPECT_THAT(encoding([](OIIO::ImageSpec& spec) { spec.attribute("acesImageContainerFlag", 1); }),
              HasSubstr("linear with primaries 0.7347 0.2653"));
  EXPECT_EQ(encoding([](OIIO::ImageSpec& spec) { spec.attribute("whiteLuminance", 100.0f); }), "linear");
}

TEST_F(Declared, AnExrOfThisProgramDeclaresItsPrimaries) {
  Image image(2, 2);
  write_image(folder_ / "a.exr", image, {}, {.kind = PixelKind::Half});
  const auto file = OIIO::ImageInput::open((folder_ / "a.exr").string());
  ASSERT_TRUE(file);
  const auto* declared = file->spec().find_attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8));
  ASSERT_NE(declared, nullptr);
  EXPECT_EQ(static_cast<const float*>(declared->data())[0], 0.64f);
  EXPECT_EQ(encoding_of(read_image(folder_ / "a.exr")), "linear");
}

TEST_F(Declared, ATurnedImageIsRefused) {
  for (const char* name : {"a.tif", "a.exr", "a.jpg"}) {
    write(name, {"R", "G", "B"}, [](OIIO::ImageSpec& spec) { spec.attribute("Orientation", 6); });
    EXPECT_THAT(refused(name), HasSubstr("orientation 6")) << name;
  }
  // EXIF of either byte order: a list of one entry, orientation (274), one SHORT.
  const std::string big("MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0", 26),
      little("II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0\0\0\0\0\0\0", 26);
  for (const std::string& exif : {big, little}) {
    const std::string why = refusal(ExitCode::Input, [&] { png(3, 8, 0, {"abc"}, chunk("eXIf", exif)); });
    EXPECT_THAT(why, HasSubstr("orientation 6"));
  }
  std::string upright = big;
  upright[19] = 1;
  EXPECT_EQ(png(3, 8, 0, {"abc"}, chunk("eXIf", upright)).image.width, 3);
  EXPECT_EQ(png(3, 8, 0, {"abc"}, chunk("eXIf", big.substr(0, 12))).image.width, 3) << "cut: no orientation";
}

/// A TIFF of one 8-bit strip by its tags, each of one or more SHORTs.
std::string tiff(const std::map<int, std::vector<int>>& more, const std::string& pixels) {
  const auto little = [](std::uint32_t value, int bytes) {
    std::string out;
    for (int i = 0; i < bytes; ++i) out += static_cast<char>(value >> 8 * i & 0xff);
    return out;
  };
  std::map<int, std::vector<int>> tags{{256, {2}}, {257, {1}}, {259, {1}}, {262, {1}},
                                       {273, {8}}, {277, {1}}, {278, {1}}, {279, {static_cast<int>(pixels.size())}}};
  for (const auto& [tag, values] : more) tags[tag] = values;
  tags.emplace(258, std::vector<int>(static_cast<std::size_t>(tags[277][0]), 8));
  const std::string strip = pixels + std::string(pixels.size() % 2, '\0');
  std::string directory = little(static_cast<std::uint32_t>(tags.size()), 2), far;
  const std::size_t behind = 8 + strip.size() + 2 + 12 * tags.size() + 4;
  for (const auto& [tag, values] : tags) {
    std::string data;
    for (const int value : values) data += little(static_cast<std::uint32_t>(value), 2);
    directory += little(static_cast<std::uint32_t>(tag), 2) + little(3, 2) +
                 little(static_cast<std::uint32_t>(values.size()), 4);
    if (data.size() > 4) {
      directory += little(static_cast<std::uint32_t>(behind + far.size()), 4);
      far += data;
    } else {
      directory += data + std::string(4 - data.size(), '\0');
    }
  }
  return "II*" + std::string(1, '\0') + little(static_cast<std::uint32_t>(8 + strip.size()), 4) + strip + directory +
         little(0, 4) + far;
}

TEST_F(Declared, TiffModelsAreFollowedOrRefused) {
  const auto read = [&](const std::map<int, std::vector<int>>& tags, const std::string& pixels) {
    write_bytes(folder_ / "a.tif", tiff(tags, pixels));
    return read_image(folder_ / "a.tif");
  };
  constexpr int kBits = 258, kPhotometric = 262, kSamples = 277, kExtra = 338, kColours = 320;
  EXPECT_THAT(read({}, "\x33\xff").image.data, ElementsAre(0.2f, 1.0f));
  EXPECT_THAT(read({{kPhotometric, {0}}}, "\x33\xff").image.data, ElementsAre(0.8f, 0.0f)) << "white is zero";
  EXPECT_THAT(read({{kPhotometric, {0}}, {kBits, {1}}}, "\x40").image.data, ElementsAre(1.0f, 0.0f));
  EXPECT_THAT(read({{kBits, {4}}}, "\x3f").image.data, ElementsAre(0.2f, 1.0f));
  std::vector<int> colours(3 * 256, 0);
  colours[1] = 0xffff;
  colours[256 + 1] = 0x3333;
  EXPECT_THAT(read({{kPhotometric, {3}}, {kColours, colours}}, std::string("\1\0", 2)).image.data,
              ElementsAre(1.0f, 0.2f, 0.0f, 0.0f, 0.0f, 0.0f));
  const std::string rgba = "\x33\x33\x33\x33\xff\xff\xff\xff";
  const auto with_alpha = [&](int kind) {
    return read({{kPhotometric, {2}}, {kSamples, {4}}, {kExtra, {kind}}}, rgba);
  };
  for (const int kind : {1, 2}) {
    EXPECT_EQ(with_alpha(kind).image.data[0], 0.2f) << "as stored, whatever the association";
    EXPECT_EQ(with_alpha(kind).unassociated, kind == 2);
  }
  for (const auto& [model, pixels] : {std::pair{5, rgba}, {6, rgba.substr(0, 6)}, {8, rgba.substr(0, 6)}}) {
    EXPECT_THAT(refusal(ExitCode::Input,
                        [&, &model = model, &pixels = pixels] {
                          read({{kPhotometric, {model}}, {kSamples, {static_cast<int>(pixels.size()) / 2}}}, pixels);
                        }),
                HasSubstr("colour model"))
        << model;
  }
  EXPECT_THAT(refusal(ExitCode::Input,
                      [&] {
                        read({{kPhotometric, {0}}, {kBits, {16}}}, "\x33\x33\xff\xff");
                      }),
              HasSubstr("WhiteIsZero"));
  for (const auto& [tag, name] : {std::pair{291, "GrayResponseCurve"},
                                  {301, "TransferFunction"},
                                  {318, "WhitePoint"},
                                  {319, "PrimaryChromaticities"}}) {
    EXPECT_THAT(refusal(ExitCode::Input,
                        [&, &tag = tag] {
                          read({{tag, {1, 2, 3, 4}}}, "\x33\xff");
                        }),
                HasSubstr("unsupported TIFF tag " + std::string(name)));
  }
}

}  // namespace
}  // namespace fastsplat::images
