// SPDX-License-Identifier: Apache-2.0
// Declarations of a TIFF that decoders ignore.
#pragma once

#include <span>
#include <string>

namespace fastsplat::images {

/// The name of the first tag in the first directory that changes sample colours; empty without one. Incomplete files
/// are left to the decoder.
std::string tiff_unfollowed(std::span<const unsigned char> bytes);

}  // namespace fastsplat::images
