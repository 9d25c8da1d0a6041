// Image files through OpenImageIO: EXR (float, half, raw integer words), PNG (8/16), TIFF (8/16/float).
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "cmodel/frame.hpp"
#include "scene/image.hpp"

namespace fastsplat::analysis {

/// Metadata carried in the file's attributes under "fastsplat:<key>": engine, method, scene (one-line TOML or path),
/// config, config_hash (16 hex digits), version, format ("float", "U1.16"), ...
using Metadata = std::map<std::string, std::string>;

enum class PixelKind { Float, Half, Uint8, Uint16, RawWords };
const char* to_string(PixelKind kind);

struct LoadedImage {
  Image image;           ///< decoded to value (integer files divided by their maximum; raw words by 2^frac_bits)
  PixelKind kind = PixelKind::Float;
  int frac_bits = 0;     ///< raw words only
  std::vector<std::uint32_t> words;  ///< raw words only, as in the file
  Metadata metadata;
};

/// UserError (Input) when missing, not an image, truncated, too large (> 2^31 values) or of unsupported channels.
LoadedImage read_image(const std::filesystem::path& path);

/// By extension: .exr float; .png/.tif 16 bit (clamped to [0,1], round half up; clamped values are counted and returned).
/// Atomic; every failure (unknown extension, read-only, disk full) is a UserError (Input).
struct WriteOptions {
  PixelKind kind = PixelKind::Float;   ///< Float/Half for .exr, Uint8/Uint16 for .png/.tif
  bool display = false;                ///< apply the sRGB curve and composite over black (for looking, not measuring)
};
std::size_t write_image(const std::filesystem::path& path, const Image& image, const Metadata& metadata, WriteOptions options);

/// EXR with one uint32 channel per colour: the device's raw words, bit for bit; frac_bits and config hash in the metadata.
void write_frame(const std::filesystem::path& path, const cmodel::Frame& frame, Metadata metadata);

}  // namespace fastsplat::analysis
