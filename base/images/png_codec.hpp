// SPDX-License-Identifier: Apache-2.0
// PNG by libpng.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/images/codec.hpp"

namespace fastsplat::images {

/// As Codec::decode, for bytes in which png_defect() found nothing. Palettes become RGB, few bits become eight.
std::optional<ErrorParts> decode_png(std::string_view bytes, LoadedImage& loaded);

/// As Codec::encode: colours as given, not divided by alpha. sRGB and linear samples are declared.
std::string encode_png(const Encoding& picture, std::vector<unsigned char>& bytes);

}  // namespace fastsplat::images
