// What the module shows: its tag and its table. Everything else in it is hidden.
#include <OpenImageIO/imageio.h>

#include "base/images/openimageio/operations.hpp"

namespace {

std::string version() {
  const int number = OIIO::openimageio_version();
  return std::to_string(number / 10000) + "." + std::to_string(number / 100 % 100) + "." + std::to_string(number % 100);
}

}  // namespace

// The names are base/images/codec.hpp's kTagSymbol and kTableSymbol.
extern "C" {
[[gnu::visibility("default")]] extern const char fastsplat_codec_tag[] = FASTSPLAT_CODEC_TAG;
[[gnu::visibility("default")]] extern const fastsplat::images::Codec fastsplat_codec_table{
    version, fastsplat::images::decode, fastsplat::images::encode};
}
