// Words for what a file declares of its colours. Equal words mean that samples may be compared.
#pragma once

#include <array>
#include <string>

namespace fastsplat::images {

inline const std::string kLinear = "linear", kSrgb = "sRGB";

/// x and y of red, green, blue and white.
using Primaries = std::array<double, 8>;

/// `transfer`, with the primaries where they are not those of sRGB.
std::string with_primaries(const std::string& transfer, const Primaries& primaries);

/// Of an embedded ICC profile by its name.
std::string profile_encoding(const std::string& name);

}  // namespace fastsplat::images
