// What a PNG declares of its numbers, beside its pixels.
#pragma once

#include <span>
#include <string>

namespace fastsplat::images {

/// As LoadedImage::encoding. Chunks count as the PNG specification ranks them: cICP, iCCP, sRGB, then gAMA and cHRM.
/// `bytes`: of a whole PNG (png_defect() found nothing).
std::string png_encoding(std::span<const unsigned char> bytes);

/// Whether it is animated: readers show its first image only.
bool png_is_animated(std::span<const unsigned char> bytes);

}  // namespace fastsplat::images
