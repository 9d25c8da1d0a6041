// SPDX-License-Identifier: Apache-2.0
// The two operations of the module's table, as specified in base/images/codec.hpp.
#pragma once

#include "base/images/codec.hpp"

namespace fastsplat::images {

std::optional<ErrorParts> decode(const std::string& format, std::string_view bytes, LoadedImage& loaded);
std::string encode(const Encoding& picture, std::vector<unsigned char>& bytes);

}  // namespace fastsplat::images
