// SPDX-License-Identifier: Apache-2.0
// Percent-encoding (RFC 3986) of words in URIs.
#pragma once

#include <string>
#include <string_view>

namespace fastsplat {

/// Bytes other than ASCII letters and digits as "%2E".
std::string percent_encoded(std::string_view text);
/// Replaces "%2E" and the like; an incomplete one stays.
std::string percent_decoded(std::string_view text);

}  // namespace fastsplat
