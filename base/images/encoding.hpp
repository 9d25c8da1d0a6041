// SPDX-License-Identifier: Apache-2.0
// Names of the colour encodings that files declare. Samples may be compared if their names are equal.
#pragma once

#include <array>
#include <string>

namespace fastsplat::images {

inline const std::string kLinear = "linear", kSrgb = "sRGB";

/// x and y of red, green, blue and white.
using Primaries = std::array<double, 8>;

/// `transfer`, with the primaries if they are not those of sRGB.
std::string with_primaries(const std::string& transfer, const Primaries& primaries);

/// Encoding of an embedded ICC profile, by its name.
std::string profile_encoding(const std::string& name);

}  // namespace fastsplat::images
