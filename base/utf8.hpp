// SPDX-License-Identifier: Apache-2.0
// Checks whether bytes are UTF-8 text.
#pragma once

#include <string_view>

namespace fastsplat {

/// Well-formed UTF-8: no stray or missing continuation, surrogate or overlong form, nothing above U+10FFFF.
bool is_utf8(std::string_view bytes);

}  // namespace fastsplat
