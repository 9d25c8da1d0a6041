// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <exception>
#include <utility>

#include "base/images/encoding.hpp"
#include "base/images/openimageio/attributes.hpp"
#include "base/images/openimageio/operations.hpp"

namespace fastsplat::images {
namespace {

using OIIO::TypeDesc;

/// Sample types as stored in the file and as given in memory.
std::pair<TypeDesc, TypeDesc> types_of(PixelKind kind) {
  switch (kind) {
    case PixelKind::Float:
      break;
    case PixelKind::Half:
      return {TypeDesc::HALF, TypeDesc::FLOAT};
    case PixelKind::Uint8:
      return {TypeDesc::UINT8, TypeDesc::UINT8};
    case PixelKind::Uint16:
      return {TypeDesc::UINT16, TypeDesc::UINT16};
    case PixelKind::RawWords:
      return {TypeDesc::UINT32, TypeDesc::UINT32};
  }
  return {TypeDesc::FLOAT, TypeDesc::FLOAT};
}

}  // namespace

std::string encode(const Encoding& picture, std::vector<unsigned char>& bytes) {
  try {
    auto output = OIIO::ImageOutput::create(picture.format);
    if (!output) return OIIO::geterror();
    const auto [stored, given] = types_of(picture.kind);
    OIIO::ImageSpec spec(picture.width, picture.height, picture.channels, stored);
    set_metadata(spec, picture.format, picture.metadata);
    spec.attribute("Software", picture.software);
    spec.attribute("DateTime", "");  // else OpenImageIO writes the current time, and equal pictures differ
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", picture.srgb ? "sRGB" : "Linear");
    if (picture.format == "openexr") {
      std::array<float, kSrgbPrimaries.size()> primaries{};
      std::copy(kSrgbPrimaries.begin(), kSrgbPrimaries.end(), primaries.begin());
      spec.attribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8), primaries.data());
    }
    // PNG defines alpha as unassociated, so OpenImageIO would divide by it. TIFF's tag rightly says associated.
    if (picture.format == "png") spec.attribute("oiio:UnassociatedAlpha", 1);
    OIIO::Filesystem::IOVecOutput memory(bytes);
    output->set_ioproxy(&memory);
    if (output->open(picture.name, spec) && output->write_image(given, picture.samples) && output->close()) return {};
    const std::string reason = output->geterror();
    return reason.empty() ? "no reason given" : reason;
  } catch (const std::exception& error) {  // thrown by an encoder
    return error.what();
  }
}

}  // namespace fastsplat::images
