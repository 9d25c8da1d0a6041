// SPDX-License-Identifier: Apache-2.0
// Image files of a render or a replay: --out and --raw.
#pragma once

#include <string>
#include <vector>

#include "base/images/image_file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"

namespace fastsplat::cli {

void declare_images(Options& options, std::vector<std::string>& out, std::string& raw);

/// By extension: .exr float, .tif 16-bit linear, .png 8-bit for display. An .exr file gets `image`, the others `shown`
/// (scene/display.hpp). Warns if values were clamped.
void write_images(const std::vector<std::string>& paths, const Image& image, const Image& shown,
                  const images::Metadata& metadata, const Output& output);

/// Warns if all values are 0, which is almost always a mistake.
void warn_if_empty(const Image& image, const Output& output);

}  // namespace fastsplat::cli
