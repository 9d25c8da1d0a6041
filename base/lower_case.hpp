// SPDX-License-Identifier: Apache-2.0
// Lower-cases ASCII letters of format names and file extensions, independent of the locale.
#pragma once

#include <filesystem>
#include <string>

namespace fastsplat {

inline std::string lower_case(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

/// ".png" of A.PNG.
inline std::string ending_of(const std::filesystem::path& path) { return lower_case(path.extension().string()); }

}  // namespace fastsplat
