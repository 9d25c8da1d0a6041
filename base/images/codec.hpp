// SPDX-License-Identifier: Apache-2.0
// The interface between base/images/ and OpenImageIO: a table of functions in a module that is opened when a TIFF or
// JPEG is first read or written. Only that module, base/images/openimageio/, includes OpenImageIO.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/images/image_file.hpp"

namespace fastsplat::images {

/// A picture to encode.
struct Encoding {
  std::string format;  ///< "openexr", "png" or "tiff"
  std::string name;    ///< name of the file, for messages
  int width = 0, height = 0, channels = 0;
  PixelKind kind = PixelKind::Float;
  const void* samples =
      nullptr;        ///< as Image::data; float for Float and Half, else unsigned integers of the kind's width
  bool srgb = false;  ///< else linear
  std::string software;
  Metadata metadata;
};

/// ErrorParts::what when memory runs out, which is a failure of the machine.
inline constexpr const char* kNoMemory = "not enough memory to decode";

/// The operations of the module. Refusals are returned as data, not thrown, so that program and module share no symbol.
struct Codec {
  /// Version of the library that was found, "2.4.7".
  std::string (*version)();
  /// Decodes the whole file's `bytes`, whose magic number indicates `format`. On failure returns the reason, without
  /// `where`; `loaded` is then invalid.
  std::optional<ErrorParts> (*decode)(const std::string& format, std::string_view bytes, LoadedImage& loaded);
  /// Appends the whole file to `bytes`. Returns the reason of a failure, else an empty text.
  std::string (*encode)(const Encoding& picture, std::vector<unsigned char>& bytes);
};

/// The symbols of the module: a tag with version, compiler and the types above, and the table itself.
inline constexpr const char* kTagSymbol = "fastsplat_codec_tag";
inline constexpr const char* kTableSymbol = "fastsplat_codec_table";

/// Opens the module on the first call, from any thread. Searches the folder of the running program, then
/// ../lib/fastsplat/ from there. Throws UserError (Input) if it is missing, cannot be loaded, or has another tag.
const Codec& codec();

}  // namespace fastsplat::images
