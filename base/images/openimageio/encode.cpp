// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <exception>

#include "base/images/metadata_text.hpp"
#include "base/images/openimageio/operations.hpp"

namespace fastsplat::images {
namespace {

using OIIO::TypeDesc;

TypeDesc type_of(PixelKind kind) {
  return kind == PixelKind::Uint8 ? TypeDesc::UINT8 : kind == PixelKind::Uint16 ? TypeDesc::UINT16 : TypeDesc::FLOAT;
}

}  // namespace

std::string encode(const Encoding& picture, std::vector<unsigned char>& bytes) {
  try {
    auto output = OIIO::ImageOutput::create(picture.format);
    if (!output) return OIIO::geterror();
    const TypeDesc type = type_of(picture.kind);
    OIIO::ImageSpec spec(picture.width, picture.height, picture.channels, type);
    spec.attribute("ImageDescription", metadata_lines(picture.metadata));
    spec.attribute("Software", picture.software);
    spec.attribute("DateTime", "");  // else OpenImageIO writes the current time, and equal pictures differ
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", picture.srgb ? "sRGB" : "Linear");
    OIIO::Filesystem::IOVecOutput memory(bytes);
    output->set_ioproxy(&memory);
    if (output->open(picture.name, spec) && output->write_image(type, picture.samples) && output->close()) return {};
    const std::string reason = output->geterror();
    return reason.empty() ? "no reason given" : reason;
  } catch (const std::exception& error) {  // thrown by an encoder
    return error.what();
  }
}

}  // namespace fastsplat::images
