// SPDX-License-Identifier: Apache-2.0
// Checks that the attributes of an EXR lie within its bytes, before OpenEXR reads it. OpenEXR allocates each declared
// length before it reads: a file of a kilobyte could cost two gigabytes.
#pragma once

#include <span>
#include <string>

namespace fastsplat::images {

/// Walks the headers of all parts ("OpenEXR File Layout": name, type, length, value, until an empty name). Returns the
/// first defect with its byte offset, or an empty text. Lengths are as OpenEXR will read them: the fixed size of a type
/// that has one, and channel lists up to their empty name. OpenEXR itself checks the values and the pixels.
std::string exr_defect(std::span<const unsigned char> bytes);

/// A defect of the channel lists, or an empty text. They must be sorted: pixels are stored in the order of names, and
/// readers sort the list. Requires that exr_defect() found nothing.
std::string exr_channel_defect(std::span<const unsigned char> bytes);

/// Whether a channel has fewer samples than pixels or is a chroma channel, BY or RY. Requires that exr_defect() found
/// nothing.
bool exr_is_luminance_chroma(std::span<const unsigned char> bytes);

}  // namespace fastsplat::images
