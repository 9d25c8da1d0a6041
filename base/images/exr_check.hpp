// Do the attributes of this EXR lie within its bytes? Asked before OpenEXR sees it, because that makes room for as much
// as a length says before it reads: a file of a kilobyte costs two gigabytes.
#pragma once

#include <span>
#include <string>

namespace fastsplat::images {

/// Walks the headers of all parts ("OpenEXR File Layout": name, type, length, value, until an empty name) and returns
/// what is wrong with the byte offset, or an empty text. Lengths are those that OpenEXR will read: of the types it
/// knows the size of, that size; of a list of channels, up to its empty name. What the values mean is left to OpenEXR,
/// and so are the pixels.
std::string exr_defect(std::span<const unsigned char> bytes);

/// What is wrong with the lists of channels, of a file in which exr_defect() found nothing: pixels lie in the order of
/// names, and readers sort a list that is not sorted.
std::string exr_channel_defect(std::span<const unsigned char> bytes);

/// Whether a channel has fewer samples than there are pixels. `bytes`: exr_defect() found nothing.
bool exr_is_subsampled(std::span<const unsigned char> bytes);

}  // namespace fastsplat::images
