// SPDX-License-Identifier: Apache-2.0
// Image files of a render or a replay: --out and --raw.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/images/image_file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"

namespace fastsplat::cli {

void declare_images(Options& options, std::vector<std::string>& out, std::string& raw);

/// The picture to look at of a linear one (scene/display.hpp); an empty function: the same picture.
using Shown = std::function<Image(const Image&)>;

/// By extension: .exr float, .tif 16-bit linear, .png 8-bit for display. An .exr file gets `image`, the others what
/// `shown` makes of it. Warns if values were clamped, or if all are 0, which is almost always a mistake.
void write_images(const std::vector<std::string>& paths, const Image& image, const Shown& shown,
                  const images::Metadata& metadata, const Output& output);

}  // namespace fastsplat::cli
