// SPDX-License-Identifier: Apache-2.0
// EXR headers built attribute by attribute, and headers written by OpenImageIO.
#include "base/images/exr_check.hpp"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "base/images/image_file.hpp"
#include "tests/images/image_helper.hpp"

namespace fastsplat::images {
namespace {

using testing::HasSubstr;

std::string word(std::uint32_t value) {
  std::string out;
  for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(value >> shift & 0xff);
  return out;
}

std::string text(const std::string& characters) { return characters + '\0'; }

std::string attribute(const std::string& type, const std::string& value) {
  return text("a") + text(type) + word(static_cast<std::uint32_t>(value.size())) + value;
}

const std::string kOnePart = word(20000630) + word(2);
const std::string kParts = word(20000630) + word(2 | 1u << 12);
const std::string kNoMore = text("");

std::string exr_defect_of(const std::string& bytes) {
  return exr_defect({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
}

/// A valid value of each type that OpenEXR 3.1 knows.
const std::vector<std::pair<std::string, std::string>>& values() {
  static const std::vector<std::pair<std::string, std::string>> all = [] {
    std::vector<std::pair<std::string, std::string>> of{
        {"string", "any length"},
        {"unheard-of", "any length"},
        {"chlist", text("R") + std::string(16, '\1') + text("G") + std::string(16, '\1') + kNoMore},
        {"stringvector", word(2) + "ab" + word(0) + word(1) + "c"},
        {"floatvector", std::string(12, '\1')},
        {"preview", word(2) + word(3) + std::string(24, '\1')}};
    const std::vector<std::pair<std::string, std::size_t>> fixed{{"box2f", 16},
                                                                 {"box2i", 16},
                                                                 {"chromaticities", 32},
                                                                 {"compression", 1},
                                                                 {"deepImageState", 1},
                                                                 {"double", 8},
                                                                 {"envmap", 1},
                                                                 {"float", 4},
                                                                 {"int", 4},
                                                                 {"keycode", 28},
                                                                 {"lineOrder", 1},
                                                                 {"m33d", 72},
                                                                 {"m33f", 36},
                                                                 {"m44d", 128},
                                                                 {"m44f", 64},
                                                                 {"rational", 8},
                                                                 {"tiledesc", 9},
                                                                 {"timecode", 8},
                                                                 {"v2d", 16},
                                                                 {"v2f", 8},
                                                                 {"v2i", 8},
                                                                 {"v3d", 24},
                                                                 {"v3f", 12},
                                                                 {"v3i", 12}};
    for (const auto& [type, size] : fixed) of.emplace_back(type, std::string(size, '\1'));
    return of;
  }();
  return all;
}

TEST(ExrHeader, RightAttributesPass) {
  std::string all = kOnePart;
  for (const auto& [type, value] : values()) {
    EXPECT_EQ(exr_defect_of(kOnePart + attribute(type, value) + kNoMore), "") << type;
    all += attribute(type, value);
  }
  EXPECT_EQ(exr_defect_of(all + kNoMore + "pixels"), "");
  std::printf("[figure] types that pass = %zu\n", values().size());
}

TEST(ExrHeader, AValueOfAnotherLengthIsNamed) {
  int refused = 0;
  for (const auto& [type, value] : values()) {
    if (type == "string" || type == "unheard-of") continue;
    for (const std::string& other : {value + '\1', value.substr(0, value.size() - 1)}) {
      EXPECT_THAT(exr_defect_of(kOnePart + attribute(type, other) + kNoMore), HasSubstr("at byte 8")) << type;
      ++refused;
    }
  }
  std::printf("[figure] values of another length refused = %d\n", refused);
  EXPECT_EQ(refused, 56);
}

TEST(ExrHeader, ALengthBeyondTheEndIsNamed) {
  for (const std::uint32_t length : {3u, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
    const std::string bytes = kOnePart + text("a") + text("string") + word(length) + "xy";
    EXPECT_EQ(exr_defect_of(bytes),
              "an attribute of " + std::to_string(length) + " bytes exceeds the remaining 2 at byte 8");
  }
  // A list of texts with false lengths.
  EXPECT_NE(exr_defect_of(kOnePart + attribute("stringvector", word(0x7fffffff) + "abc") + kNoMore), "");
  // 2^16 x 2^16 pixels: 0 as a number of 32 bits.
  EXPECT_NE(exr_defect_of(kOnePart + attribute("preview", word(1 << 16) + word(1 << 16)) + kNoMore), "");
}

TEST(ExrHeader, CutAnywhereIsNamed) {
  const std::string whole = kOnePart + attribute("int", "abcd") + attribute("string", "text") + kNoMore;
  for (std::size_t size = 0; size < whole.size(); ++size) EXPECT_NE(exr_defect_of(whole.substr(0, size)), "") << size;
  EXPECT_EQ(exr_defect_of(whole), "");
}

TEST(ExrHeader, EveryPartIsWalked) {
  const std::string good = attribute("int", "abcd") + kNoMore, bad = attribute("int", "abc") + kNoMore;
  EXPECT_EQ(exr_defect_of(kParts + good + good + kNoMore), "");
  EXPECT_NE(exr_defect_of(kParts + good + bad + kNoMore), "");
  EXPECT_NE(exr_defect_of(kParts + good + good), "");
  // Behind the only header of a file of one part are its pixels.
  EXPECT_EQ(exr_defect_of(kOnePart + good + bad), "");
}

/// Attributes of all types that OpenImageIO can write, in files of one part, of tiles, and of two parts.
TEST(ExrHeader, FilesOfOpenImageIoPass) {
  const TempFolder folder;
  OIIO::ImageSpec spec(8, 8, 3, OIIO::TypeDesc::HALF);
  const std::vector<float> numbers(16, 0.5f);
  const std::vector<int> integers{1, 2, 3, 4, 5, 6, 64};  // a key code is checked
  const std::vector<const char*> texts{"one", "", "three"};
  spec.attribute("anInteger", 7);
  spec.attribute("aFloat", 0.5f);
  spec.attribute("aText", "text");
  spec.attribute("textsOfAVector", OIIO::TypeDesc(OIIO::TypeDesc::STRING, 3), texts.data());
  spec.attribute("aMatrix", OIIO::TypeMatrix, numbers.data());
  spec.attribute("aSmallMatrix", OIIO::TypeMatrix33, numbers.data());
  spec.attribute("aVector", OIIO::TypeVector, numbers.data());
  spec.attribute("floats", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 5), numbers.data());
  spec.attribute("aTime", OIIO::TypeTimeCode, integers.data());
  spec.attribute("aKey", OIIO::TypeKeyCode, integers.data());
  spec.attribute("aRatio", OIIO::TypeRational, integers.data());
  spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), numbers.data());
  OIIO::ImageSpec tiled = spec;
  tiled.tile_width = tiled.tile_height = 16;
  const std::vector<float> pixels(8 * 8 * 3, 0.25f);
  const auto write = [&](const char* name, const std::vector<OIIO::ImageSpec>& parts) {
    const std::string path = (folder / name).string();
    const auto out = OIIO::ImageOutput::create("openexr");
    ASSERT_TRUE(out && out->open(path, static_cast<int>(parts.size()), parts.data())) << OIIO::geterror();
    for (std::size_t part = 0; part < parts.size(); ++part) {
      if (part > 0) {
        ASSERT_TRUE(out->open(path, parts[part], OIIO::ImageOutput::AppendSubimage)) << out->geterror();
      }
      ASSERT_TRUE(out->write_image(OIIO::TypeDesc::FLOAT, pixels.data())) << out->geterror();
    }
    ASSERT_TRUE(out->close());
    const std::string bytes = file_text(folder / name);
    EXPECT_EQ(exr_defect_of(bytes), "") << name;
    std::printf("[figure] %s: %zu bytes pass\n", name, bytes.size());
  };
  write("lines.exr", {spec});
  write("tiles.exr", {tiled});
  OIIO::ImageSpec second = spec;
  second.attribute("oiio:subimagename", "second");
  spec.attribute("oiio:subimagename", "first");
  write("parts.exr", {spec, second});
  EXPECT_EQ(read_image(folder / "lines.exr").image.width, 8);
}

}  // namespace
}  // namespace fastsplat::images
