// SPDX-License-Identifier: Apache-2.0
// Names of the colour encodings that files declare. Samples may be compared if their names are equal.
#pragma once

#include <array>
#include <string>

namespace fastsplat::images {

inline const std::string kLinear = "linear", kSrgb = "sRGB";

/// x and y of red, green, blue and white.
using Primaries = std::array<double, 8>;

inline constexpr Primaries kSrgbPrimaries{0.64, 0.33, 0.30, 0.60, 0.15, 0.06, 0.3127, 0.3290};
/// AP0, which every ACES container holds.
inline constexpr Primaries kAcesPrimaries{0.7347, 0.2653, 0.0, 1.0, 0.0001, -0.077, 0.32168, 0.33767};

/// `transfer`, with the primaries if they are not those of sRGB.
std::string with_primaries(const std::string& transfer, const Primaries& primaries);

/// Encoding that an EXR's colorInteropID names.
std::string interop_encoding(const std::string& id);

/// Encoding of an embedded ICC profile, by its name.
std::string profile_encoding(const std::string& name);

}  // namespace fastsplat::images
