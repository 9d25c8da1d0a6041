// Checks whether bytes are UTF-8 text.
#pragma once

#include <string_view>

namespace fastsplat {

/// Well-formed UTF-8: no stray or missing continuation, no surrogate, nothing longer than needed or above U+10FFFF.
bool is_utf8(std::string_view bytes);

}  // namespace fastsplat
