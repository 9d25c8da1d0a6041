// All that base/images/ knows of the image library: a table of functions in a module that is opened when a picture is
// first read or written. The module is base/images/openimageio/, alone in including OpenImageIO.
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
  std::string name;    ///< of the file, for messages
  int width = 0, height = 0, channels = 0;
  PixelKind kind = PixelKind::Float;
  const void* samples =
      nullptr;        ///< as Image::data; float for Float and Half, else unsigned integers of the kind's width
  bool srgb = false;  ///< else linear
  std::string software;
  Metadata metadata;
};

/// `what` of a refusal for lack of memory, which is the machine's.
inline constexpr const char* kNoMemory = "not enough memory to decode";

/// What the module does. A refusal comes back as data, not as an exception: program and module need share no symbol.
struct Codec {
  /// Of the library that was found, "2.4.7".
  std::string (*version)();
  /// The whole file's `bytes`, whose magic number says `format`. Returns why not, without `where`; `loaded` is then
  /// void.
  std::optional<ErrorParts> (*decode)(const std::string& format, std::string_view bytes, LoadedImage& loaded);
  /// Appends the whole file to `bytes`; returns why not, or an empty text.
  std::string (*encode)(const Encoding& picture, std::vector<unsigned char>& bytes);
};

/// The symbols of the module: a text that names version, compiler and the types above, and the table itself.
inline constexpr const char* kTagSymbol = "fastsplat_codec_tag";
inline constexpr const char* kTableSymbol = "fastsplat_codec_table";

/// Opens the module on the first call, from any thread. It is looked for beside the running program, then in
/// ../lib/fastsplat/ as seen from there. UserError (Input) when it is missing, cannot be loaded, or has another tag.
const Codec& codec();

}  // namespace fastsplat::images
