// SPDX-License-Identifier: Apache-2.0
// What a PNG declares: colour encoding and animation.
#pragma once

#include <span>
#include <string>

namespace fastsplat::images {

/// The value of LoadedImage::encoding. Chunks have the priority of the PNG specification: cICP, iCCP, sRGB, then gAMA
/// and cHRM. Requires that png_defect() found nothing in `bytes`.
std::string png_encoding(std::span<const unsigned char> bytes);

/// Whether it is animated; readers show the first image only.
bool png_is_animated(std::span<const unsigned char> bytes);

}  // namespace fastsplat::images
