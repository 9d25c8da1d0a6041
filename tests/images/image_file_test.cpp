// SPDX-License-Identifier: Apache-2.0
// Written files read back: values, words, metadata; unsupported ones are refused.
#include "base/images/image_file.hpp"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <random>

#include "base/srgb.hpp"
#include "base/version.hpp"
#include "tests/images/image_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::images {
namespace {

using testing::HasSubstr;

const Metadata kMetadata{
    {"engine", "golden"},  {"scene", "volume = \"shells:64\"\n[camera]\nazimuth = 30.0 # 30\xc2\xb0, back\\slash\n"},
    {"empty", ""},         {"carriage", "a\r\nb\r"},
    {"spaces", "  two  "}, {"config_hash", "0123456789abcdef"}};

struct Case {
  const char* name;
  PixelKind kind;
  double step;  ///< of the stored values; 0: every float is kept
};

// One test for all formats and channels: every test is a process that has to load the image library.
void for_each_format(const std::function<void(const Case&, int channels)>& body) {
  for (const Case& format : {Case{"f.exr", PixelKind::Float, 0.0}, Case{"h.exr", PixelKind::Half, 0.0},
                             Case{"8.png", PixelKind::Uint8, 1.0 / 255}, Case{"16.png", PixelKind::Uint16, 1.0 / 65535},
                             Case{"8.tif", PixelKind::Uint8, 1.0 / 255},
                             Case{"16.tiff", PixelKind::Uint16, 1.0 / 65535}, Case{"f.TIF", PixelKind::Float, 0.0}}) {
    for (const int channels : {1, 3, 4}) {
      SCOPED_TRACE(std::string(format.name) + " with " + std::to_string(channels) + " channels");
      body(format, channels);
    }
  }
}

TEST(ImageFile, ValuesAndMetadataComeBack) {
  const TempFolder folder;
  for_each_format([&](const Case& format, int channels) {
    Image image = random_image(37, 23, channels, 7);
    if (format.kind == PixelKind::Half) {
      // Eleven bits fit half exactly, so that nothing may change.
      for (float& value : image.data) value = std::floor(value * 2048) / 2048;
    }
    // Alpha 0 under a visible colour: (un)premultiplication would destroy it.
    if (channels == 4) image.pixel(3, 2)[3] = 0.0f;

    EXPECT_EQ(write_image(folder / format.name, image, kMetadata, {.kind = format.kind}), 0u);
    const LoadedImage loaded = read_image(folder / format.name);
    EXPECT_EQ(loaded.kind, format.kind);
    EXPECT_EQ(loaded.metadata, kMetadata);
    ASSERT_EQ(loaded.image.width, 37);
    ASSERT_EQ(loaded.image.height, 23);
    ASSERT_EQ(loaded.image.channels, channels);
    if (format.step == 0.0) {
      EXPECT_EQ(loaded.image.data, image.data);
      return;
    }
    // Round half up to the grid, then the nearest float of code/maximum.
    for (std::size_t i = 0; i < image.data.size(); ++i) {
      const double code = std::floor(image.data[i] / format.step + 0.5);
      ASSERT_EQ(loaded.image.data[i], static_cast<float>(code * format.step)) << i;
    }
  });
}

TEST(ImageFile, SameInputSameBytes) {
  const TempFolder folder;
  for_each_format([&](const Case& format, int channels) {
    const auto first = folder / (std::string("a") + format.name);
    const auto second = folder / (std::string("b") + format.name);
    const Image image = random_image(9, 5, channels, 3);
    write_image(first, image, kMetadata, {.kind = format.kind});
    write_image(second, image, kMetadata, {.kind = format.kind});
    EXPECT_EQ(file_text(first), file_text(second));
    // A second later the clock would make a difference.
    EXPECT_EQ(OIIO::ImageInput::open(first.string())->spec().find_attribute("DateTime"), nullptr);
  });
}

TEST(ImageFile, EveryCodeOfAnIntegerFileSurvivesReadingAndWriting) {
  const TempFolder folder;
  Image image(256, 256, 1);
  for (int i = 0; i < 65536; ++i) image.data[static_cast<std::size_t>(i)] = static_cast<float>(i / 65535.0);
  for (const char* name : {"a.png", "a.tif"}) {
    write_image(folder / name, image, {});
    EXPECT_EQ(read_image(folder / name).image, image) << name;
  }
}

TEST(ImageFile, FloatKeepsEveryBit) {
  const TempFolder folder;
  std::mt19937 generator(11);
  Image image(64, 64, 4);
  for (float& value : image.data) {
    const std::uint32_t bits = generator();
    std::memcpy(&value, &bits, sizeof(value));  // NaN payloads, infinities and denormals among them
  }
  for (const char* name : {"a.exr", "a.tif"}) {
    EXPECT_EQ(write_image(folder / name, image, {}, {.kind = PixelKind::Float}), 0u);
    const Image back = read_image(folder / name).image;
    ASSERT_EQ(back.data.size(), image.data.size());
    EXPECT_EQ(std::memcmp(back.data.data(), image.data.data(), image.data.size() * sizeof(float)), 0) << name;
  }
}

TEST(ImageFile, RawWordsBitForBit) {
  const TempFolder folder;
  std::mt19937 generator(5);
  std::vector<std::uint32_t> words;
  for (int i = 0; i < 33 * 21 * 4; ++i) words.push_back(generator());
  words[0] = 1u << 16;
  write_raw(
      folder / "w.exr",
      {.width = 33, .height = 21, .int_bits = 1, .frac_bits = 16, .words = words, .config_hash = 0xfedcba9876543210},
      {{"engine", "cmodel"}});
  const LoadedImage loaded = read_image(folder / "w.exr");
  EXPECT_EQ(loaded.kind, PixelKind::RawWords);
  EXPECT_EQ(loaded.words, words);
  EXPECT_EQ(loaded.frac_bits, 16);
  EXPECT_EQ(loaded.image.data[0], 1.0f);
  for (std::size_t i = 0; i < words.size(); ++i) {
    ASSERT_EQ(loaded.image.data[i], static_cast<float>(words[i] / 65536.0)) << i;
  }
  const Metadata expected{{"engine", "cmodel"},
                          {"config_hash", "fedcba9876543210"},
                          {"format", "U1.16"},
                          {"frac_bits", "16"},
                          {"int_bits", "1"}};
  EXPECT_EQ(loaded.metadata, expected);
}

TEST(ImageFile, ClampingIsCounted) {
  const TempFolder folder;
  Image image(2, 2, 1);
  image.data = {-0.1f, 1.5f, std::numeric_limits<float>::quiet_NaN(), 0.5f};
  EXPECT_EQ(write_image(folder / "a.png", image, {}), 3u);
  EXPECT_EQ(read_image(folder / "a.png").image.data, (std::vector<float>{0.0f, 1.0f, 0.0f, 32768 / 65535.0f}));

  image.data = {1e6f, -std::numeric_limits<float>::infinity(), 65504.0f, 0.5f};
  EXPECT_EQ(write_image(folder / "a.exr", image, {}, {.kind = PixelKind::Half}), 2u);
  EXPECT_EQ(read_image(folder / "a.exr").image.data, (std::vector<float>{65504.0f, -65504.0f, 65504.0f, 0.5f}));
}

TEST(ImageFile, DisplayIsOpaqueSrgbOverBlack) {
  const TempFolder folder;
  Image image(2, 1, 4);
  image.data = {0.5f, 0.25f, 0.0f, 0.5f, 1.0f, 0.0f, 0.0021f, 0.0f};
  EXPECT_EQ(write_image(folder / "a.png", image, {}, {.display = true}), 0u);
  const LoadedImage loaded = read_image(folder / "a.png");
  EXPECT_EQ(loaded.kind, PixelKind::Uint8);
  // IEC 61966-2-1 by hand: 0.5 -> 187.5, 0.25 -> 136.96, 0.0021 -> 12.92 * 0.0021 * 255 = 6.92.
  const std::vector<float> expected{188 / 255.0f, 137 / 255.0f, 0, 1, 0, 7 / 255.0f};
  EXPECT_EQ(loaded.image.channels, 3);
  EXPECT_EQ(loaded.image.data, expected);
}

TEST(ImageFile, SrgbCodesSurviveTheLinearDetour) {
  for (int code = 0; code < 256; ++code) {
    const auto linear = static_cast<float>(srgb_decode(code / 255.0));
    EXPECT_EQ(std::lround(srgb_encode(linear) * 255), code);
  }
}

TEST(ImageFile, DefaultsGoByExtension) {
  const TempFolder folder;
  const Image image = random_image(4, 4, 4, 1);
  for (const auto& [name, kind] :
       {std::pair{"a.exr", PixelKind::Float}, {"a.png", PixelKind::Uint16}, {"a.tif", PixelKind::Uint16}}) {
    write_image(folder / name, image, {});
    EXPECT_EQ(read_image(folder / name).kind, kind);
  }
}

TEST(ImageFile, ReadsFilesOfOtherPrograms) {
  const TempFolder folder;
  // Straight alpha, sRGB tag, metadata that is not ours: the samples as stored, nothing else.
  for (const std::string name : {"a.png", "a.tif"}) {
    const std::vector<std::uint8_t> samples{200, 100, 50, 128, 10, 20, 30, 0};
    auto output = OIIO::ImageOutput::create((folder / name).string());
    OIIO::ImageSpec spec(2, 1, 4, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:UnassociatedAlpha", 1);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("ImageDescription", "a holiday\nfastsplat:Bad Key=1\nnot fastsplat:x=2");
    ASSERT_TRUE(output->open((folder / name).string(), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, samples.data()));
    ASSERT_TRUE(output->close());
    const LoadedImage loaded = read_image(folder / name);
    for (std::size_t i = 0; i < samples.size(); ++i)
      EXPECT_EQ(loaded.image.data[i], static_cast<float>(samples[i] / 255.0));
    EXPECT_TRUE(loaded.metadata.empty());
  }
}

TEST(ImageFile, ContentDecidesNotTheName) {
  const TempFolder folder;
  const Image image = random_image(4, 4, 4, 1);
  write_image(folder / "a.exr", image, {});
  std::filesystem::rename(folder / "a.exr", folder / "a.png");
  EXPECT_EQ(read_image(folder / "a.png").image, image);
}

/// A file with one property that this program does not read.
void write_foreign(const std::filesystem::path& path, const std::function<void(OIIO::ImageSpec&)>& change,
                   int subimages = 1) {
  auto output = OIIO::ImageOutput::create(path.string());
  OIIO::ImageSpec spec(8, 8, 4, OIIO::TypeDesc::FLOAT);
  change(spec);
  const std::vector<OIIO::ImageSpec> specs(static_cast<std::size_t>(subimages), spec);
  const std::vector<float> samples(8 * 8 * 8, 0.25f);
  ASSERT_TRUE(output->open(path.string(), subimages, specs.data())) << output->geterror();
  for (int s = 0; s < subimages; ++s) {
    if (s > 0) {
      ASSERT_TRUE(output->open(path.string(), spec, OIIO::ImageOutput::AppendSubimage));
    }
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, samples.data()));
  }
  ASSERT_TRUE(output->close());
}

std::string read_refusal(const std::filesystem::path& path) {
  return refusal(ExitCode::Input, [&] { read_image(path); });
}

TEST(ImageFile, RefusesPicturesThatItCannotMeasure) {
  const TempFolder folder;
  write_foreign(folder / "xyz.exr", [](auto& spec) {
    spec.nchannels = 3;
    spec.channelnames = {"X", "Y", "Z"};
    spec.alpha_channel = -1;
  });
  EXPECT_THAT(read_refusal(folder / "xyz.exr"),
              HasSubstr("expected channels named Y, YA, RGB or RGBA, or a single channel, got X, Y, Z"));
  write_foreign(folder / "depth.exr", [](auto& spec) {
    spec.channelnames = {"R", "G", "B", "Z"};
    spec.alpha_channel = -1;
  });
  EXPECT_THAT(read_refusal(folder / "depth.exr"), HasSubstr("fourth is not alpha"));
  write_foreign(folder / "crop.exr", [](auto& spec) { spec.full_width = 16; });
  EXPECT_THAT(read_refusal(folder / "crop.exr"), HasSubstr("display window"));
  write_foreign(folder / "uint.exr", [](auto& spec) { spec.set_format(OIIO::TypeDesc::UINT32); });
  EXPECT_THAT(read_refusal(folder / "uint.exr"), HasSubstr("fastsplat:frac_bits"));
  write_foreign(
      folder / "parts.exr", [](auto&) {}, 2);
  EXPECT_THAT(read_refusal(folder / "parts.exr"), HasSubstr("several images"));
  write_foreign(folder / "double.tif", [](auto& spec) { spec.set_format(OIIO::TypeDesc::DOUBLE); });
  EXPECT_THAT(read_refusal(folder / "double.tif"), HasSubstr("sample type"));
  // Written by OpenImageIO 2.4; 2.5 writes none.
  EXPECT_THAT(read_refusal(FASTSPLAT_SOURCE_DIR "/tests/images/files/lossy.tif"), HasSubstr("got jpeg"));
}

TEST(ImageFile, ReadsJpegOfOtherPrograms) {
  const TempFolder folder;
  const auto path = folder / "a.jpg";
  write_foreign(path, [](auto& spec) {
    spec.set_format(OIIO::TypeDesc::UINT8);
    spec.nchannels = 3;
    spec.channelnames = {"R", "G", "B"};
    spec.alpha_channel = -1;
    spec.attribute("CompressionQuality", 100);
  });
  const auto loaded = read_image(path);
  EXPECT_EQ(loaded.format, "jpeg");
  EXPECT_EQ(loaded.kind, PixelKind::Uint8);
  EXPECT_EQ(loaded.image.channels, 3);
  EXPECT_TRUE(loaded.metadata.empty());
  ASSERT_FALSE(loaded.image.data.empty());
  // A cut file is refused, not filled up with grey.
  std::ifstream in(path, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  int cuts = 0;
  for (const std::size_t left : {std::size_t{3}, whole.size() / 2, whole.size() - 1}) {
    std::ofstream(folder / "cut.jpg", std::ios::binary) << whole.substr(0, left);
    EXPECT_THAT(read_refusal(folder / "cut.jpg"), HasSubstr("truncated")) << left;
    ++cuts;
  }
  std::printf("[figure] JPEG of %zu bytes read, cuts refused = %d\n", whole.size(), cuts);
}

TEST(ImageFile, ReadsTiledFiles) {
  const TempFolder folder;
  const Image image = random_image(70, 45, 4, 8);
  for (const std::string name : {"a.exr", "a.tif"}) {
    auto output = OIIO::ImageOutput::create((folder / name).string());
    OIIO::ImageSpec spec(70, 45, 4, OIIO::TypeDesc::FLOAT);
    spec.tile_width = spec.tile_height = 16;
    ASSERT_TRUE(output->open((folder / name).string(), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, image.data.data()));
    ASSERT_TRUE(output->close());
    EXPECT_EQ(read_image(folder / name).image, image);
  }
}

TEST(ImageFile, RefusesPathsThatAreNotImages) {
  const TempFolder folder;
  EXPECT_THAT(read_refusal(folder / "missing.exr"), HasSubstr("missing.exr"));
  std::filesystem::create_directory(folder / "folder.exr");
  EXPECT_THAT(read_refusal(folder / "folder.exr"), HasSubstr("folder.exr"));
  write_bytes(folder / "empty.exr", "");
  EXPECT_THAT(read_refusal(folder / "empty.exr"), HasSubstr("empty"));
  write_bytes(folder / "text.exr", "volume = \"shells\"\n");
  EXPECT_THAT(read_refusal(folder / "text.exr"), HasSubstr("not an image (expected EXR, PNG, TIFF or JPEG)"));
  for (const auto& [start, name] :
       {std::pair{"GIF89a", "GIF"}, {"BM6", "BMP"}, {"RIFF....WEBPVP8", "WebP"}, {"P6\n2 2\n", "PNM"}}) {
    write_bytes(folder / "other.png", std::string(start) + std::string(60, ' '));
    EXPECT_THAT(read_refusal(folder / "other.png"),
                HasSubstr(std::string("unsupported image format (expected EXR, PNG, TIFF or JPEG, got ") + name));
  }
  EXPECT_THAT(read_refusal("/dev/zero"), HasSubstr("/dev/zero"));
}

TEST(ImageFile, RefusesToWriteValuesOutsideTheFormat) {
  const TempFolder folder;
  const Image image = random_image(4, 4, 4, 1);
  const auto write_refusal = [&](const char* name, WriteOptions options) {
    return refusal(ExitCode::Input, [&] { write_image(folder / name, image, {}, options); });
  };
  EXPECT_THAT(write_refusal("a.jpg", {}), HasSubstr("expected .exr, .png, .tif or .tiff, got .jpg"));
  EXPECT_THAT(write_refusal("a", {}), HasSubstr("got none"));
  EXPECT_THAT(write_refusal("a.png", {.kind = PixelKind::Float}), HasSubstr("expected uint8 or uint16, got float"));
  EXPECT_THAT(write_refusal("a.exr", {.kind = PixelKind::Uint8}), HasSubstr("expected half or float, got uint8"));
  EXPECT_THAT(write_refusal("a.exr", {.display = true}), HasSubstr("display"));
  EXPECT_THAT(write_refusal("no/such/folder/a.exr", {}), HasSubstr("folder"));
  EXPECT_THAT(refusal(ExitCode::Input,
                      [&] {
                        const std::vector<std::uint32_t> words{1, 2, 3, 4};
                        write_raw(
                            folder / "w.png",
                            {.width = 1, .height = 1, .int_bits = 1, .frac_bits = 16, .words = words, .config_hash = 0},
                            {});
                      }),
              HasSubstr("raw words need EXR"));
  EXPECT_THAT(refusal(ExitCode::Input, [&] { write_image("/proc/fastsplat.png", image, {}); }),
              HasSubstr("/proc/fastsplat.png"));
  EXPECT_EQ(folder.file_count(), 0u);
}

}  // namespace
}  // namespace fastsplat::images
