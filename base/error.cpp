#include "base/error.hpp"

#include <array>
#include <cstdio>

namespace fastsplat {
namespace {

std::string printable(const std::string& text) {
  std::string out;
  for (const unsigned char c : text) {
    if (c == '\n' || c == '\r' || c == '\t') {
      out += ' ';
    } else if (c < 0x20 || c == 0x7f) {
      std::array<char, 8> escape{};
      std::snprintf(escape.data(), escape.size(), "\\x%02x", c);
      out += escape.data();
    } else {
      out += static_cast<char>(c);
    }
  }
  return out;
}

}  // namespace

std::string one_line(const ErrorParts& parts) {
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
