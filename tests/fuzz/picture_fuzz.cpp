// SPDX-License-Identifier: Apache-2.0
// Pictures: read, or refused; the decoders are libpng, OpenEXR and OpenImageIO.
#include "base/images/image_file.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fastsplat;
  static const char* const kEndings[] = {".exr", ".tif", ".png"};
  fuzz::Bytes bytes{data, size};
  const std::string ending = kEndings[fuzz::take_byte(bytes) % 3];
  fuzz::answered([&] { images::read_image(fuzz::file_of(bytes, ending)); });
  return 0;
}
