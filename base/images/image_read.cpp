// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <new>
#include <span>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/images/codec.hpp"
#include "base/images/encoding.hpp"
#include "base/images/exr_check.hpp"
#include "base/images/exr_codec.hpp"
#include "base/images/image_file.hpp"
#include "base/images/png_check.hpp"
#include "base/images/png_codec.hpp"
#include "base/images/png_declared.hpp"
#include "base/images/tiff_declared.hpp"
#include "base/machine_error.hpp"
#include "base/read_file.hpp"

namespace fastsplat::images {
namespace {

constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 34;  // bytes; twice 2^31 float values

// The format by its magic number: extensions may lie, and trying every reader on hostile bytes adds risk.
const char* format_of(std::span<const unsigned char> bytes) {
  struct Magic {
    const char* format;
    std::array<unsigned char, 4> bytes;
  };
  static constexpr std::array<unsigned char, 3> kJpeg{0xff, 0xd8, 0xff};  // three bytes; the fourth may be any
  if (bytes.size() >= 3 && std::equal(kJpeg.begin(), kJpeg.end(), bytes.begin())) return "jpeg";
  static constexpr std::array<Magic, 6> kMagic{{{"openexr", {0x76, 0x2f, 0x31, 0x01}},
                                                {"png", {0x89, 'P', 'N', 'G'}},
                                                {"tiff", {'I', 'I', 42, 0}},
                                                {"tiff", {'M', 'M', 0, 42}},
                                                {"tiff", {'I', 'I', 43, 0}},
                                                {"tiff", {'M', 'M', 0, 43}}}};
  for (const auto& magic : kMagic) {
    if (bytes.size() >= 4 && std::equal(magic.bytes.begin(), magic.bytes.end(), bytes.begin())) return magic.format;
  }
  return nullptr;
}

/// The name of a format that is recognised but not read; nullptr for none.
const char* other_format_of(std::string_view bytes) {
  static constexpr std::array<std::pair<std::string_view, const char*>, 10> kStarts{
      {{"GIF8", "GIF"},
       {"BM", "BMP"},
       {"#?RADIANCE", "Radiance HDR"},
       {"#?RGBE", "Radiance HDR"},
       {"SDPX", "DPX"},
       {"XPDS", "DPX"},
       {"8BPS", "Photoshop"},
       {"\xff\x0a", "JPEG XL"},
       {"qoif", "QOI"},
       {std::string_view("\0\0\0\x0cjP  ", 8), "JPEG 2000"}}};
  for (const auto& [start, name] : kStarts) {
    if (bytes.starts_with(start)) return name;
  }
  if (bytes.starts_with("RIFF") && bytes.substr(0, 12).ends_with("WEBP")) return "WebP";
  const bool pnm = bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '7' &&
                   (bytes[2] == '\n' || bytes[2] == ' ');
  return pnm ? "PNM" : nullptr;
}

}  // namespace

LoadedImage read_image(const std::filesystem::path& path) {
  const auto refuse = [&path](ErrorParts parts) {
    parts.where = path.string();
    throw_input(std::move(parts));
  };
  LoadedImage loaded;
  try {
    const std::string file = read_text_file(path, kLargestFile);
    const std::span bytes(reinterpret_cast<const unsigned char*>(file.data()), file.size());
    const char* format = format_of(bytes);
    if (format == nullptr) {
      if (const char* other = other_format_of(file))
        refuse({{}, "unsupported image format", "EXR, PNG, TIFF or JPEG", other, "convert it, for example to .png"});
      refuse({{}, "not an image", "EXR, PNG, TIFF or JPEG", {}, "name an image file, or write the file again"});
    }
    const bool png = std::strcmp(format, "png") == 0, exr = std::strcmp(format, "openexr") == 0;
    if (png || exr) {
      std::string defect = png ? png_defect(bytes) : exr_defect(bytes);
      if (exr && defect.empty()) defect = exr_channel_defect(bytes);
      if (!defect.empty())
        refuse({{},
                std::string("corrupt or truncated ") + (png ? "PNG: " : "EXR: ") + defect,
                {},
                {},
                "write the file again"});
    }
    if (exr && exr_is_luminance_chroma(bytes)) {
      refuse({{},
              "luminance/chroma EXR: chroma channels, or fewer samples than pixels",
              "one sample per channel and pixel",
              {},
              "write it as RGB"});
    }
    if (png && png_is_animated(bytes))
      refuse({{}, "several images in one file (animated PNG)", "one", {}, "write a single image"});
    if (const std::string tag = std::strcmp(format, "tiff") == 0 ? tiff_unfollowed(bytes) : ""; !tag.empty())
      refuse({{}, "unsupported TIFF tag " + tag, "sRGB or linear samples", {}, "convert it to sRGB or linear values"});
    // The decoder fills the missing part of a truncated file with grey.
    if (std::strcmp(format, "jpeg") == 0 && file.rfind("\xff\xd9") == std::string::npos)
      refuse({{}, "corrupt or truncated JPEG: its end is missing", {}, {}, "write the file again"});
    auto refusal = png   ? decode_png(file, loaded)
                   : exr ? decode_exr(file, loaded)
                         : codec().decode(format, file, loaded);
    if (refusal) {
      if (refusal->what == kNoMemory) throw std::bad_alloc();
      refuse(std::move(*refusal));
    }
    loaded.format = format;
    if (png) {
      loaded.encoding = png_encoding(bytes);
      // This program's PNG files hold premultiplied colours, against the PNG specification.
      loaded.unassociated = loaded.image.channels == 4 && loaded.metadata.empty();
    }
    if (loaded.encoding.empty() && loaded.metadata.contains("display")) loaded.encoding = kSrgb;
    if (loaded.encoding.empty() && !loaded.metadata.empty()) loaded.encoding = kLinear;
  } catch (const std::bad_alloc&) {
    throw_machine({path.string(), kNoMemory, {}, {}, {}});
  }
  return loaded;
}

std::string encoding_of(const LoadedImage& loaded) {
  if (!loaded.encoding.empty()) return loaded.encoding;
  return loaded.format == "png" || loaded.format == "jpeg" ? kSrgb : kLinear;
}

const char* to_string(PixelKind kind) {
  switch (kind) {
    case PixelKind::Float:
      return "float";
    case PixelKind::Half:
      return "half";
    case PixelKind::Uint8:
      return "uint8";
    case PixelKind::Uint16:
      return "uint16";
    case PixelKind::RawWords:
      return "raw words";
  }
  return "";
}

}  // namespace fastsplat::images
