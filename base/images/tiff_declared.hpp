// Declarations of a TIFF that decoders ignore.
#pragma once

#include <span>
#include <string>

namespace fastsplat::images {

/// The name of a tag in the first directory that changes the colour of samples; empty without one. Incomplete files are
/// left to the decoder.
std::string tiff_unfollowed(std::span<const unsigned char> bytes);

}  // namespace fastsplat::images
