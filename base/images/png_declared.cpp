// SPDX-License-Identifier: Apache-2.0
#include "base/images/png_declared.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>

#include "base/images/encoding.hpp"

namespace fastsplat::images {
namespace {

using Bytes = std::span<const unsigned char>;

std::uint32_t number_at(Bytes bytes, std::size_t at) {
  if (bytes.size() < at + 4) return 0;
  return std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 | std::uint32_t{bytes[at + 2]} << 8 |
         bytes[at + 3];
}

/// The chunks before the pixels, by name; the first of each name.
std::map<std::string_view, Bytes> chunks_before_pixels(Bytes bytes) {
  std::map<std::string_view, Bytes> chunks;
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = number_at(bytes, at);
    if (length > bytes.size() - at - 12) break;
    const std::string_view name(reinterpret_cast<const char*>(&bytes[at + 4]), 4);
    if (name == "IDAT") break;
    chunks.emplace(name, bytes.subspan(at + 8, length));
    at += length + 12;
  }
  return chunks;
}

/// gAMA and cHRM hold numbers times 100,000.
double scaled(Bytes chunk, std::size_t at) { return number_at(chunk, at) * 1e-5; }

std::string gamma_encoding(double gamma) {
  constexpr double kOfSrgb = 1.0 / 2.2, kStep = 5e-4;  // the value that sRGB writers store
  if (std::abs(gamma - 1.0) < kStep) return kLinear;
  if (std::abs(gamma - kOfSrgb) < kStep) return kSrgb;
  return "gamma " + std::to_string(gamma);
}

}  // namespace

std::string png_encoding(Bytes bytes) {
  const auto chunks = chunks_before_pixels(bytes);
  if (const auto cicp = chunks.find("cICP"); cicp != chunks.end() && cicp->second.size() == 4) {
    const Bytes code = cicp->second;
    if (code[0] == 1 && code[1] == 13 && code[2] == 0 && code[3] == 1) return kSrgb;
    return "video code points " + std::to_string(code[0]) + ", " + std::to_string(code[1]);
  }
  if (const auto profile = chunks.find("iCCP"); profile != chunks.end()) {
    const std::string_view text(reinterpret_cast<const char*>(profile->second.data()), profile->second.size());
    return profile_encoding(std::string(text.substr(0, text.find('\0'))));
  }
  if (chunks.contains("sRGB")) return kSrgb;
  const auto gamma = chunks.find("gAMA"), primaries = chunks.find("cHRM");
  const std::string transfer = gamma == chunks.end() ? std::string() : gamma_encoding(scaled(gamma->second, 0));
  if (primaries == chunks.end() || primaries->second.size() != 32) return transfer;
  Primaries declared{};
  // cHRM stores white first.
  for (std::size_t i = 0; i < declared.size(); ++i) declared[i] = scaled(primaries->second, 4 * ((i + 2) % 8));
  return with_primaries(transfer.empty() ? kSrgb : transfer, declared);
}

bool png_is_animated(Bytes bytes) {
  const auto chunks = chunks_before_pixels(bytes);
  const auto control = chunks.find("acTL");
  return control != chunks.end() && number_at(control->second, 0) > 1;
}

}  // namespace fastsplat::images
