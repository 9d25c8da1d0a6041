// SPDX-License-Identifier: Apache-2.0
#include "base/json_text.hpp"

#include <array>
#include <cstdio>

namespace fastsplat {

std::string without_controls(std::string json) {
  // They occur only in strings: U+007F as one byte, the others after 0xc2.
  for (std::size_t at = json.find_first_of("\x7f\xc2"); at != std::string::npos;
       at = json.find_first_of("\x7f\xc2", at + 1)) {
    const std::size_t length = json[at] == '\x7f' ? 1 : 2;
    const auto code = static_cast<unsigned char>(length == 1 ? json[at] : at + 1 < json.size() ? json[at + 1] : '\xff');
    if (code > 0x9f) continue;
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "\\u%04x", code);
    json.replace(at, length, text.data());
  }
  return json;
}

}  // namespace fastsplat
