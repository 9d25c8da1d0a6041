// SPDX-License-Identifier: Apache-2.0
// What every decoder asks of a picture: its channels by name, the scale of its words.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/images/image_file.hpp"

namespace fastsplat::images {

/// Why a picture is refused; caught by its decoder.
struct Refused {
  ErrorParts parts;
  explicit Refused(ErrorParts why) : parts(std::move(why)) {}
  explicit Refused(std::string what, std::string expected = {}, std::string got = {}, std::string fix = {})
      : parts{{}, std::move(what), std::move(expected), std::move(got), std::move(fix)} {}
};

/// The places of R, G, B, A or Y, A in a pixel, found by name, because libraries sort channels; names may have a common
/// prefix. A single channel may have any name. Throws Refused for others.
std::vector<std::size_t> channel_order(const std::vector<std::string>& names);

/// For an orientation other than 1: samples are taken as stored.
inline Refused turned_refusal(int orientation) {
  return Refused("the image is stored rotated or mirrored: orientation " + std::to_string(orientation), "1", {},
                 "write it upright with oiiotool --reorient");
}

/// Fraction bits of raw words, from their metadata. Throws Refused without.
int frac_bits_of(const Metadata& metadata);

}  // namespace fastsplat::images
