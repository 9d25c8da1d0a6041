// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cassert>
#include <cctype>
#include <cmath>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "base/images/codec.hpp"
#include "base/images/exr_codec.hpp"
#include "base/images/image_file.hpp"
#include "base/images/png_codec.hpp"
#include "base/lower_case.hpp"
#include "base/srgb.hpp"
#include "base/version.hpp"

namespace fastsplat::images {
namespace {

std::string format_of(const std::filesystem::path& path) {
  const std::string extension = ending_of(path);
  if (extension == ".exr") return "openexr";
  if (extension == ".png") return "png";
  if (extension == ".tif" || extension == ".tiff") return "tiff";
  throw_input({path.string(),
               "unknown image extension",
               ".exr, .png, .tif or .tiff",
               extension.empty() ? "none" : extension,
               {}});
}

void check_kind(const std::filesystem::path& path, const std::string& format, PixelKind kind) {
  const bool integer = kind == PixelKind::Uint8 || kind == PixelKind::Uint16;
  const bool fits = format == "openexr" ? !integer : integer || (format == "tiff" && kind == PixelKind::Float);
  if (fits) return;
  throw_input({path.string(), "the file format cannot hold these pixels",
               format == "openexr" ? "half or float" : (format == "png" ? "uint8 or uint16" : "uint8, uint16 or float"),
               to_string(kind), "choose another extension"});
}

/// Encodes to memory first, so that every byte that reaches the disk goes through one checked, atomic write.
void write_encoded(const std::filesystem::path& path, Encoding picture) {
  picture.name = path.filename().string();
  picture.software = "FastSplat " + program_version();
  std::vector<unsigned char> bytes;
  const std::string defect = picture.format == "png"       ? encode_png(picture, bytes)
                             : picture.format == "openexr" ? encode_exr(picture, bytes)
                                                           : codec().encode(picture, bytes);
  if (!defect.empty()) throw_input({path.string(), "cannot encode as " + picture.format + ": " + defect, {}, {}, {}});
  write_text_file(path, std::string(bytes.begin(), bytes.end()));
}

/// Clamps to [lowest, highest]; NaN becomes 0. Counts both.
double clamp_counted(double value, double lowest, double highest, std::size_t& clamped) {
  if (value >= lowest && value <= highest) return value;
  ++clamped;
  return std::isnan(value) ? 0.0 : std::clamp(value, lowest, highest);
}

template <typename T>
std::vector<T> quantised(const std::vector<float>& values, double one, std::size_t& clamped) {
  std::vector<T> out(values.size());
  std::transform(values.begin(), values.end(), out.begin(), [&](float value) {
    return static_cast<T>(std::floor(clamp_counted(value, 0.0, 1.0, clamped) * one + 0.5));
  });
  return out;
}

/// Premultiplied colours are colours over black: drops alpha and applies the sRGB curve.
Image display_image(const Image& image, std::size_t& clamped) {
  Image shown(image.width, image.height, image.channels == 4 ? 3 : image.channels);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      for (int c = 0; c < shown.channels; ++c) {
        shown.pixel(x, y)[c] = static_cast<float>(srgb_encode(clamp_counted(image.pixel(x, y)[c], 0.0, 1.0, clamped)));
      }
    }
  }
  return shown;
}

}  // namespace

std::size_t write_image(const std::filesystem::path& path, const Image& image, const Metadata& metadata,
                        const WriteOptions& options) {
  assert(image.width > 0 && image.height > 0 && (image.channels == 1 || image.channels == 3 || image.channels == 4));
  assert(image.data.size() == static_cast<std::size_t>(image.width) * image.height * image.channels);
  const std::string format = format_of(path);
  const PixelKind usual =
      options.display ? PixelKind::Uint8 : (format == "openexr" ? PixelKind::Float : PixelKind::Uint16);
  const PixelKind kind = options.kind.value_or(usual);
  if (options.display && (format == "openexr" || kind == PixelKind::Float)) {
    throw_input({path.string(), "a display image has 8 or 16 bits a sample", ".png or .tif", format, {}});
  }
  check_kind(path, format, kind);

  std::size_t clamped = 0;
  const Image shown = options.display ? display_image(image, clamped) : Image();
  const Image& source = options.display ? shown : image;
  const auto write = [&](const void* samples) {
    write_encoded(path, {.format = format,
                         .name = {},
                         .width = source.width,
                         .height = source.height,
                         .channels = source.channels,
                         .kind = kind,
                         .samples = samples,
                         .srgb = options.display,
                         .software = {},
                         .metadata = metadata});
  };
  switch (kind) {
    case PixelKind::Float:
      write(source.data.data());
      break;
    case PixelKind::Half: {
      constexpr double kLargestHalf = 65504.0;
      std::vector<float> samples = source.data;
      for (float& v : samples) v = static_cast<float>(clamp_counted(v, -kLargestHalf, kLargestHalf, clamped));
      write(samples.data());
      break;
    }
    case PixelKind::Uint8:
      write(quantised<std::uint8_t>(source.data, 255.0, clamped).data());
      break;
    case PixelKind::Uint16:
      write(quantised<std::uint16_t>(source.data, 65535.0, clamped).data());
      break;
    case PixelKind::RawWords:
      assert(!"raw words are written by write_raw");
      break;
  }
  return clamped;
}

void write_raw(const std::filesystem::path& path, const RawImage& image, Metadata metadata) {
  assert(image.words.size() == static_cast<std::size_t>(image.width) * image.height * 4 && !image.words.empty());
  const std::string format = format_of(path);
  if (format != "openexr") {
    throw_input({path.string(), "raw words need EXR", ".exr", path.extension().string(), "choose the extension .exr"});
  }
  metadata["config_hash"] = hash_text(image.config_hash);
  metadata["int_bits"] = std::to_string(image.int_bits);
  metadata["frac_bits"] = std::to_string(image.frac_bits);
  metadata["format"] = "U" + metadata["int_bits"] + "." + metadata["frac_bits"];
  write_encoded(path, {.format = format,
                       .name = {},
                       .width = image.width,
                       .height = image.height,
                       .channels = 4,
                       .kind = PixelKind::RawWords,
                       .samples = image.words.data(),
                       .srgb = false,
                       .software = {},
                       .metadata = std::move(metadata)});
}

}  // namespace fastsplat::images
