// The pictures a render or a replay leaves behind: names checked before the work, written after it.
#pragma once

#include <string>
#include <vector>

#include "analysis/image_file.hpp"
#include "cli/output.hpp"

namespace fastsplat::cli {

/// Every name has a known ending, can be created and is named once; else a UserError, before any time is spent.
/// `others` are further result files (JSON, scene) that must be writable too; empty and "-" ones are skipped.
void check_outputs(const std::vector<std::string>& images, const std::string& raw,
                   const std::vector<std::string>& others);

/// By ending: .exr float, .tif 16 bit linear, .png 8 bit for looking. Warns where values had to be clamped.
void write_images(const std::vector<std::string>& paths, const Image& image, const analysis::Metadata& metadata,
                  const Output& output);

/// Nothing in the picture is almost always a mistake worth a word.
void warn_if_empty(const Image& image, const Output& output);

}  // namespace fastsplat::cli
