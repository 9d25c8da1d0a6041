// The pictures a render or a replay leaves behind: names checked before the work, written after it.
#pragma once

#include <string>
#include <vector>

#include "base/images/image_file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"

namespace fastsplat::cli {

/// --out and --raw.
void declare_images(Options& options, std::vector<std::string>& out, std::string& raw);

/// By ending: .exr float, .tif 16 bit linear, .png 8 bit for looking. An .exr gets the picture, the others what is
/// shown of it (scene/display.hpp). Warns where values had to be clamped.
void write_images(const std::vector<std::string>& paths, const Image& image, const Image& shown,
                  const images::Metadata& metadata, const Output& output);

/// Nothing in the picture is almost always a mistake worth a word.
void warn_if_empty(const Image& image, const Output& output);

}  // namespace fastsplat::cli
