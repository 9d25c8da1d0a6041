// SPDX-License-Identifier: Apache-2.0
// PNG files built chunk by chunk.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>
#include <vector>

namespace fastsplat::images {

inline std::string big_endian(std::uint32_t value) {
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(value >> shift & 0xff);
  return out;
}

inline std::string chunk(const std::string& type, const std::string& data) {
  const std::string body = type + data;
  const auto crc = crc32(0, reinterpret_cast<const unsigned char*>(body.data()), static_cast<uInt>(body.size()));
  return big_endian(static_cast<std::uint32_t>(data.size())) + body + big_endian(static_cast<std::uint32_t>(crc));
}

inline std::string deflated(const std::string& data) {
  uLongf size = compressBound(data.size());
  std::string out(size, '\0');
  compress(reinterpret_cast<unsigned char*>(out.data()), &size, reinterpret_cast<const unsigned char*>(data.data()),
           data.size());
  out.resize(size);
  return out;
}

inline const std::string kSignature = "\x89PNG\r\n\x1a\n";

inline std::string header(std::uint32_t width, std::uint32_t height, int depth, int colour, int interlace) {
  std::string tail{static_cast<char>(depth), static_cast<char>(colour), 0, 0, static_cast<char>(interlace)};
  return chunk("IHDR", big_endian(width) + big_endian(height) + tail);
}

/// Grey 8-bit pixels, every row with filter 0.
inline std::string rows(const std::vector<std::string>& lines) {
  std::string out;
  for (const auto& line : lines) out += '\0' + line;
  return out;
}

inline const std::string kEnd = chunk("IEND", "");

}  // namespace fastsplat::images
