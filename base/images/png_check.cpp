// SPDX-License-Identifier: Apache-2.0
#include "base/images/png_check.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace fastsplat::images {
namespace {

using Bytes = std::span<const unsigned char>;

std::uint32_t big_endian(Bytes bytes) {
  return std::uint32_t{bytes[0]} << 24 | std::uint32_t{bytes[1]} << 16 | std::uint32_t{bytes[2]} << 8 | bytes[3];
}

struct Header {
  std::uint32_t width = 0, height = 0;
  int depth = 0, colour = 0, interlace = 0;

  bool valid(Bytes data) const {
    constexpr std::uint32_t kLargest = 0x7fffffff;
    const bool sizes = width > 0 && height > 0 && width <= kLargest && height <= kLargest;
    const bool any_depth = depth == 1 || depth == 2 || depth == 4 || depth == 8 || depth == 16;
    const bool fits = colour == 0                                 ? any_depth
                      : colour == 3                               ? any_depth && depth <= 8
                      : colour == 2 || colour == 4 || colour == 6 ? depth == 8 || depth == 16
                                                                  : false;
    return sizes && fits && data[10] == 0 && data[11] == 0 && interlace <= 1;
  }
  std::uint64_t row_bytes(std::uint64_t columns) const {
    constexpr std::array<int, 7> kChannels{1, 0, 3, 1, 2, 0, 4};
    return (columns * static_cast<std::uint64_t>(kChannels[static_cast<std::size_t>(colour)] * depth) + 7) / 8;
  }
};

/// Inflates the IDAT stream through a small buffer, row by row of every interlace pass.
class PixelStream {
 public:
  explicit PixelStream(const Header& header) : header_(header) {
    inflateInit(&stream_);
    next_pass();
  }
  ~PixelStream() { inflateEnd(&stream_); }
  PixelStream(const PixelStream&) = delete;
  PixelStream& operator=(const PixelStream&) = delete;

  /// Returns the first defect, or an empty text.
  std::string feed(Bytes data) {
    std::array<unsigned char, 65536> out;
    stream_.next_in = const_cast<unsigned char*>(data.data());
    stream_.avail_in = static_cast<uInt>(data.size());
    while (stream_.avail_in > 0) {
      if (ended_) return "data after the end of the compressed pixels";
      stream_.next_out = out.data();
      stream_.avail_out = static_cast<uInt>(out.size());
      const int status = inflate(&stream_, Z_NO_FLUSH);
      if (status != Z_OK && status != Z_STREAM_END && status != Z_BUF_ERROR) {
        return std::string("bad compressed pixels: ") + (stream_.msg != nullptr ? stream_.msg : "no message");
      }
      const std::string defect = count(Bytes(out.data(), out.size() - stream_.avail_out));
      if (!defect.empty()) return defect;
      ended_ = status == Z_STREAM_END;
    }
    return {};
  }
  bool complete() const { return ended_ && pass_ == passes(); }

 private:
  int passes() const { return header_.interlace == 0 ? 1 : 7; }

  /// Advances to the next pass that has a pixel.
  void next_pass() {
    // Adam7: first column, first row, column step, row step of each pass.
    static constexpr std::array<std::array<std::uint32_t, 4>, 7> kAdam7{
        {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}};
    for (++pass_; pass_ < passes(); ++pass_) {
      std::uint64_t columns = header_.width;
      rows_left_ = header_.height;
      if (header_.interlace == 1) {
        const auto [x, y, dx, dy] = kAdam7[static_cast<std::size_t>(pass_)];
        columns = (columns + dx - 1 - x) / dx;
        rows_left_ = (rows_left_ + dy - 1 - y) / dy;
      }
      row_ = 1 + header_.row_bytes(columns);
      if (columns > 0 && rows_left_ > 0) return;
    }
  }

  std::string count(Bytes pixels) {
    for (std::size_t i = 0; i < pixels.size();) {
      if (pass_ == passes()) return "more pixels than the header declares";
      if (in_row_ == 0 && pixels[i] > 4) return "unknown row filter";
      const std::uint64_t step = std::min<std::uint64_t>(row_ - in_row_, pixels.size() - i);
      in_row_ += step;
      i += static_cast<std::size_t>(step);
      if (in_row_ < row_) continue;
      in_row_ = 0;
      if (--rows_left_ == 0) next_pass();
    }
    return {};
  }

  Header header_;
  z_stream stream_{};
  bool ended_ = false;
  int pass_ = -1;
  std::uint64_t rows_left_ = 0, row_ = 0, in_row_ = 0;
};

bool is_type(Bytes type) {
  for (const unsigned char c : type) {
    if (!((c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'))) return false;
  }
  return true;
}

}  // namespace

std::string png_defect(Bytes bytes) {
  constexpr std::array<unsigned char, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  constexpr std::size_t kFrame = 12;  // length, type, CRC
  if (bytes.size() < kSignature.size() || !std::equal(kSignature.begin(), kSignature.end(), bytes.begin())) {
    return "bad PNG signature";
  }
  Header header;
  std::optional<PixelStream> pixels;
  std::string_view before;
  bool palette = false;
  bool pixels_over = false;
  for (std::size_t at = kSignature.size();;) {
    const std::string where = " at byte " + std::to_string(at);
    if (bytes.size() - at < kFrame) return "the file ends inside a chunk" + where;
    const std::uint32_t length = big_endian(bytes.subspan(at));
    if (length > bytes.size() - at - kFrame) return "the file ends inside a chunk" + where;
    const Bytes type = bytes.subspan(at + 4, 4);
    const Bytes data = bytes.subspan(at + 8, length);
    if (!is_type(type)) return "bad chunk type" + where;
    const std::string_view name(reinterpret_cast<const char*>(type.data()), 4);
    const auto crc = crc32(crc32(0, type.data(), 4), data.data(), length);
    if (crc != big_endian(bytes.subspan(at + 8 + length)))
      return "wrong checksum of chunk " + std::string(name) + where;

    if (before == "IDAT" && name != "IDAT") pixels_over = true;
    const std::string chunk = "chunk " + std::string(name) + where;
    if (before.empty() != (name == "IHDR")) return "misplaced " + chunk;
    if (name == "IHDR") {
      if (length != 13) return "bad " + chunk;
      header = {big_endian(data), big_endian(data.subspan(4)), data[8], data[9], data[12]};
      if (!header.valid(data)) return "bad " + chunk;
      pixels.emplace(header);
    } else if (name == "PLTE") {
      const bool fits = length % 3 == 0 && length > 0 && length <= 768 && header.colour != 0 && header.colour != 4;
      if (!fits || palette || pixels_over) return "bad " + chunk;
      palette = true;
    } else if (name == "IDAT") {
      if (header.colour == 3 && !palette) return "no palette before " + chunk;
      if (pixels_over) return "misplaced " + chunk;
      if (const std::string defect = pixels->feed(data); !defect.empty()) return defect + " in " + chunk;
    } else if (name == "IEND") {
      return length == 0 && pixels->complete() ? std::string() : "pixels are missing before " + chunk;
    } else if ((type[0] & 0x20) == 0) {
      return "unknown critical " + chunk;
    }
    before = name;
    at += kFrame + length;
  }
}

}  // namespace fastsplat::images
