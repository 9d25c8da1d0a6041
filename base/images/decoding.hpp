// SPDX-License-Identifier: Apache-2.0
// What every decoder checks: the size of a picture, its channels by name, its orientation, the scale of its words.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
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

/// Throws Refused for sizes without a pixel, sides above 65536, and more than 2^31 values.
void check_size(std::int64_t width, std::int64_t height, std::int64_t channels);

/// The places of R, G, B, A or Y, A in a pixel, found by name, because libraries sort channels; names may have a common
/// prefix. A single channel may have any name. Throws Refused for others.
std::vector<std::size_t> channel_order(const std::vector<std::string>& names);

/// Throws Refused for an orientation other than 1, because samples are taken as stored.
void check_upright(int orientation);

/// Fraction bits of raw words, from their metadata. Throws Refused without.
int frac_bits_of(const Metadata& metadata);

}  // namespace fastsplat::images
