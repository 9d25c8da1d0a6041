// Is this PNG whole? Asked before libpng sees it, because libpng prints its errors to stderr and forgives a missing
// end.
#pragma once

#include <span>
#include <string>

namespace fastsplat::images {

/// Walks the chunks (order, length, CRC), inflates the pixels without keeping them (size, checksum, filter types) and
/// returns what is wrong with the byte offset, or an empty text.
std::string png_defect(std::span<const unsigned char> bytes);

}  // namespace fastsplat::images
