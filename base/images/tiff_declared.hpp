// What a TIFF declares of its numbers and no decoder follows.
#pragma once

#include <span>
#include <string>

namespace fastsplat::images {

/// The name of a tag in the first directory by which samples are another colour than they seem; empty for none.
/// Whatever is not whole is left to the decoder.
std::string tiff_unfollowed(std::span<const unsigned char> bytes);

}  // namespace fastsplat::images
