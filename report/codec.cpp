// SPDX-License-Identifier: Apache-2.0
#include "report/codec.hpp"

#include <zlib.h>

#include <algorithm>
#include <cassert>
#include <stdexcept>

namespace fastsplat::report {
namespace {

std::string deflated(const std::string& bytes) {
  z_stream stream{};
  // Negative window bits: raw deflate, as the browser's DecompressionStream('deflate-raw') expects.
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 9, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib cannot start");
  std::string out(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int outcome = deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (outcome != Z_STREAM_END) throw std::runtime_error("zlib cannot finish");
  return out;
}

}  // namespace

int bytes_for(std::span<const std::int64_t> values) {
  if (values.empty()) return 1;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  for (int bytes = 1; bytes < 4; ++bytes) {
    const std::int64_t room = std::int64_t{1} << 8 * bytes;
    if (*least < 0 ? *least >= -room / 2 && *most < room / 2 : *most < room) return bytes;
  }
  return 4;
}

std::string codec_name(int bytes) { return "split" + std::to_string(8 * bytes) + "-deflate"; }

std::string encode(const Words& words) {
  const auto channels = static_cast<std::size_t>(words.channels),
             row = static_cast<std::size_t>(words.width) * channels, bytes = static_cast<std::size_t>(words.bytes);
  const std::size_t pixels = static_cast<std::size_t>(words.width) * static_cast<std::size_t>(words.height);
  assert(words.values.size() == pixels * channels);
  std::string planes(pixels * channels * bytes, '\0');
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    for (std::size_t c = 0; c < channels; ++c) {
      const std::size_t at = pixel * channels + c;
      const std::int64_t before = at % row >= channels ? words.values[at - channels]
                                  : at >= row          ? words.values[at - row]
                                                       : 0;
      const auto difference = static_cast<std::uint64_t>(words.values[at] - before);
      for (std::size_t b = 0; b < bytes; ++b)
        planes[(c * bytes + b) * pixels + pixel] = static_cast<char>(difference >> 8 * b & 0xff);
    }
  }
  return deflated(planes);
}

std::string plain_bytes(const Words& words) {
  std::string out;
  out.reserve(words.values.size() * static_cast<std::size_t>(words.bytes));
  for (const std::int64_t word : words.values) {
    for (int b = 0; b < words.bytes; ++b) out += static_cast<char>(static_cast<std::uint64_t>(word) >> 8 * b & 0xff);
  }
  return out;
}

}  // namespace fastsplat::report
