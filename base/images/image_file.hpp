// SPDX-License-Identifier: Apache-2.0
// Image files: EXR (float, half, raw integer words) by OpenEXR, PNG (8/16) by libpng, TIFF (8/16/float) by OpenImageIO;
// JPEG is read only. OpenImageIO is loaded at the first TIFF or JPEG, because loading takes 0.2 s and 100 MB.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/image.hpp"

namespace fastsplat::images {

/// Metadata carried in the file's attributes under "fastsplat:<key>": engine, method, scene (one-line TOML or path),
/// config, config_hash (16 hex digits), version, format ("float", "U1.16"), ...
using Metadata = std::map<std::string, std::string>;

enum class PixelKind { Float, Half, Uint8, Uint16, RawWords };
const char* to_string(PixelKind kind);

struct LoadedImage {
  Image image;  ///< decoded to value (integer files divided by their maximum; raw words by 2^frac_bits)
  PixelKind kind = PixelKind::Float;
  std::string format;  ///< "openexr", "png", "tiff" or "jpeg", by content
  /// The declared colour encoding: "linear", "sRGB", "gamma 0.5", "ICC profile 'x'", ...; empty without a
  /// declaration.
  std::string encoding;
  bool unassociated = false;         ///< the colours are not multiplied by alpha
  std::string grey;                  ///< name of a single channel if it is not Y, such as "Z"
  int frac_bits = 0;                 ///< raw words only
  std::vector<std::uint32_t> words;  ///< raw words only, as in the file
  Metadata metadata;
};

/// Loads OpenImageIO now if a picture of this name needs it, so that a run fails before its work. Throws UserError
/// (Input) if the module or a library it needs is missing, or if it belongs to another build. All functions below may
/// throw it, too.
void require_library(const std::filesystem::path& path);

/// Version of OpenImageIO at run time, "2.4.7". Loads it.
std::string library_version();

/// The values' encoding: as declared, or else the format's default (sRGB for PNG and JPEG, linear for EXR and TIFF).
std::string encoding_of(const LoadedImage& loaded);

/// Reads EXR, PNG, TIFF or JPEG, recognised by content and not by name; 1, 3 (RGB) or 4 (RGBA) channels. Grey with
/// alpha becomes RGBA. Channels are found by name, after a common prefix ("diffuse.R"). Samples are taken as stored: no
/// alpha (un)premultiplication, no colour conversion. `encoding` and `unassociated` hold the file's declarations.
/// Throws UserError (Input) if the file is missing, not an image, truncated, corrupt or too large (a side > 65536 or
/// more than 2^31 values). Unsupported content also throws: channels, sample type, lossy (JPEG in TIFF), cropped, an
/// orientation other than 1, a colour model other than grey and RGB, several images. Memory grows with the decoded
/// data, so that a wrong size in a header costs nothing.
LoadedImage read_image(const std::filesystem::path& path);

/// Without `kind`: .exr Float, .png/.tif/.tiff Uint16; Uint8 if `display` is set.
struct WriteOptions {
  std::optional<PixelKind> kind = {};  ///< .exr Float, Half; .png Uint8, Uint16; .tif Uint8, Uint16, Float
  bool display = false;  ///< .png/.tif only: composite over black, apply the sRGB curve, drop alpha (for viewing)
};

/// Writes premultiplied linear values unchanged (integer kinds: clamped to [0,1], round half up; Half: clamped to
/// +-65504, round half even). Returns the number of clamped values (NaN is written as 0 and counted; Float clamps
/// nothing). Metadata keys are [a-z0-9_]+, values any text without NUL. The same input gives the same bytes. Atomic;
/// every failure (unknown extension, kind that the format lacks, read-only, disk full) is a UserError (Input).
std::size_t write_image(const std::filesystem::path& path, const Image& image, const Metadata& metadata,
                        const WriteOptions& options = {});

/// A device's picture: row-major RGBA words, value = word / 2^frac_bits.
struct RawImage {
  int width = 0, height = 0;
  int int_bits = 0, frac_bits = 0;
  std::span<const std::uint32_t> words;  ///< width*height*4
  std::uint64_t config_hash = 0;
};

/// Writes an EXR with one uint32 channel per colour: the device's raw words, bit for bit. Adds frac_bits, int_bits,
/// config_hash (16 hex digits) and format ("U1.16") to the metadata.
void write_raw(const std::filesystem::path& path, const RawImage& image, Metadata metadata);

}  // namespace fastsplat::images
