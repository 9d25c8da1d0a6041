// SPDX-License-Identifier: Apache-2.0
// Checks that a PNG is complete before libpng reads it: libpng prints errors to stderr and accepts a missing end.
#pragma once

#include <span>
#include <string>

namespace fastsplat::images {

/// Walks the chunks (order, length, CRC) and inflates the pixels without keeping them (size, checksum, filter types).
/// Returns the first defect with its byte offset, or an empty text.
std::string png_defect(std::span<const unsigned char> bytes);

}  // namespace fastsplat::images
