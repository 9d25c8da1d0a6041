// SPDX-License-Identifier: Apache-2.0
// The sRGB transfer curve (IEC 61966-2-1), for display only, never for measuring.
#pragma once

namespace fastsplat {

/// Linear [0,1] to encoded [0,1].
double srgb_encode(double linear);
/// Encoded [0,1] to linear [0,1]; srgb_encode(srgb_decode(i/255)) rounds back to i for every 8-bit i.
double srgb_decode(double encoded);

}  // namespace fastsplat
