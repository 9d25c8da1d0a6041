// SPDX-License-Identifier: Apache-2.0
// The module's exported symbols: its tag and its table. All others are hidden.
#include <OpenImageIO/imageio.h>

#include "base/images/openimageio/operations.hpp"

namespace {

std::string version() {
  const int number = OIIO::openimageio_version();
  return std::to_string(number / 10000) + "." + std::to_string(number / 100 % 100) + "." + std::to_string(number % 100);
}

}  // namespace

// Named by kTagSymbol and kTableSymbol of base/images/codec.hpp.
extern "C" {
[[gnu::visibility("default")]] extern const char fastsplat_codec_tag[] = FASTSPLAT_CODEC_TAG;
[[gnu::visibility("default")]] extern const fastsplat::images::Codec fastsplat_codec_table{
    version, fastsplat::images::decode, fastsplat::images::encode};
}
