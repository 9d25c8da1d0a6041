// SPDX-License-Identifier: Apache-2.0
// Base64 (RFC 4648), the encoding of bytes in a page.
#pragma once

#include <string>
#include <string_view>

namespace fastsplat::report {

/// With padding, without line breaks.
std::string base64(std::string_view bytes);

}  // namespace fastsplat::report
