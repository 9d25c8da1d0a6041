// SPDX-License-Identifier: Apache-2.0
// EXR by the OpenEXR library.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/images/codec.hpp"

namespace fastsplat::images {

/// As Codec::decode, for bytes in which exr_defect() found nothing.
std::optional<ErrorParts> decode_exr(std::string_view bytes, LoadedImage& loaded);

/// As Codec::encode: ZIP, with sRGB's primaries declared.
std::string encode_exr(const Encoding& picture, std::vector<unsigned char>& bytes);

}  // namespace fastsplat::images
