// SPDX-License-Identifier: Apache-2.0
// Our metadata as attributes of an OpenImageIO header, in every format.
#pragma once

#include <OpenImageIO/imageio.h>

#include "base/images/image_file.hpp"

namespace fastsplat::images {

/// Each entry becomes the attribute "fastsplat:<key>". Formats without free attributes (TIFF), and values that a format
/// would drop (empty strings in EXR), go as lines "fastsplat:<key>=<value>" into ImageDescription instead.
void set_metadata(OIIO::ImageSpec& spec, const std::string& format_name, const Metadata& metadata);

/// The inverse of set_metadata; attributes and lines of other programs are ignored.
Metadata get_metadata(const OIIO::ImageSpec& spec);

}  // namespace fastsplat::images
