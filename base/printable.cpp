// SPDX-License-Identifier: Apache-2.0
#include "base/printable.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "base/utf8.hpp"

namespace fastsplat {
namespace {

/// Length in bytes of the first character; 0 if it is not UTF-8.
std::size_t character(std::string_view text) {
  for (std::size_t length = 1; length <= std::min<std::size_t>(4, text.size()); ++length) {
    if (is_utf8(text.substr(0, length))) return length;
  }
  return 0;
}

/// U+0000 to U+001F, U+007F, U+0080 to U+009F, which terminals obey as well, line ends (U+2028, U+2029), and marks that
/// turn the direction of what follows (U+200E, U+200F, U+202A to U+202E, U+2066 to U+2069).
bool is_control(std::string_view character) {
  if (character.size() == 3 && character[0] == '\xe2') {
    const std::string_view rest = character.substr(1);
    return (rest >= "\x80\xa8" && rest <= "\x80\xae") || rest == "\x80\x8e" || rest == "\x80\x8f" ||
           (rest >= "\x81\xa6" && rest <= "\x81\xa9");
  }
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first < 0x20 || first == 0x7f;
  return character.size() == 2 && first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
}

void escape(std::string_view bytes, std::string& to) {
  for (const char byte : bytes) {
    std::array<char, 8> text{};
    std::snprintf(text.data(), text.size(), "\\x%02x", static_cast<unsigned char>(byte));
    to += text.data();
  }
}

std::string printed(std::string_view text, bool keep_lines) {
  std::string out;
  while (!text.empty()) {
    const std::size_t length = character(text);
    const std::string_view one = text.substr(0, std::max<std::size_t>(1, length));
    const bool blank = one == "\n" || one == "\t" || (one == "\r" && (!keep_lines || text.starts_with("\r\n")));
    if (blank) {
      out += keep_lines ? one : " ";
    } else if (length == 0 || is_control(one)) {
      escape(one, out);
    } else {
      out += one;
    }
    text.remove_prefix(one.size());
  }
  return out;
}

}  // namespace

std::string printable(std::string_view text) { return printed(text, false); }
std::string printable_lines(std::string_view text) { return printed(text, true); }

}  // namespace fastsplat
