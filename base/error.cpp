// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"

#include "base/printable.hpp"

namespace fastsplat {
namespace {

/// Quoted input may be a megabyte. Texts longer than any path keep their beginning and end.
void shorten(std::string& text) {
  constexpr std::size_t kMost = 4500, kEnd = 400;
  if (text.size() > kMost) text.replace(kMost - kEnd, text.size() - kMost, "...");
}

}  // namespace

std::string one_line(const ErrorParts& whole) {
  ErrorParts parts = whole;
  for (std::string* quoted : {&parts.where, &parts.what, &parts.got}) shorten(*quoted);
  std::string line;
  if (!parts.where.empty()) line += parts.where + ": ";
  line += parts.what;
  if (!parts.expected.empty() && !parts.got.empty()) {
    line += " (expected " + parts.expected + ", got " + parts.got + ")";
  } else if (!parts.expected.empty()) {
    line += " (expected " + parts.expected + ")";
  } else if (!parts.got.empty()) {
    line += " (got " + parts.got + ")";
  }
  if (!parts.fix.empty()) line += "; " + parts.fix;
  return printable(line);
}

}  // namespace fastsplat
