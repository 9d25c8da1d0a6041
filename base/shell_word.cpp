// SPDX-License-Identifier: Apache-2.0
#include "base/shell_word.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace fastsplat {

std::string shell_word(const std::string& word) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || std::strchr("/._-+,=:@%", c) != nullptr; };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace fastsplat
