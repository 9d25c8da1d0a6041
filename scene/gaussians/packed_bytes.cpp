// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/packed_bytes.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <stdexcept>

#include "base/error.hpp"

namespace fastsplat::scene {
namespace {

constexpr int kGzip = 16 + MAX_WBITS;  // zlib: with a gzip header

/// Inflates to `to` until it has `most` bytes. Returns zlib's last answer.
int inflate_to(std::string& to, std::string_view packed, std::size_t most) {
  z_stream stream{};
  if (inflateInit2(&stream, kGzip) != Z_OK) throw std::runtime_error("zlib does not start");
  constexpr std::size_t kStep = std::size_t{1} << 20;  // memory grows with the data and not with a declared size
  std::string_view left = packed;
  int answer = Z_OK;
  while (answer == Z_OK && to.size() < most) {
    const std::size_t in = std::min(left.size(), kStep), before = to.size();
    to.resize(std::min(most, before + kStep));
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(left.data()));
    stream.avail_in = static_cast<uInt>(in);
    stream.next_out = reinterpret_cast<Bytef*>(to.data() + before);
    stream.avail_out = static_cast<uInt>(to.size() - before);
    answer = inflate(&stream, Z_NO_FLUSH);
    left.remove_prefix(in - stream.avail_in);
    to.resize(to.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  return answer;
}

}  // namespace

void check_growth(std::uint64_t unpacked, std::uint64_t packed, const std::string& where) {
  if (unpacked / kMostGrowth <= packed) return;
  throw_input({.where = where,
               .what = "the file declares more Gaussians than it can hold",
               .expected = fmt::format("at most {} times its {} bytes", kMostGrowth, packed),
               .got = fmt::format("{} bytes unpacked", unpacked),
               .fix = "the file is damaged or malicious: write or download it again"});
}

bool is_gzip(std::string_view bytes) { return bytes.starts_with("\x1f\x8b"); }

std::string start_of_gzip(std::string_view packed, std::size_t most) {
  std::string out;
  inflate_to(out, packed, most);
  return out;
}

std::string gunzip(std::string_view packed, std::size_t most, const std::string& where) {
  std::string out;
  const int answer = inflate_to(out, packed, most);
  if (answer == Z_STREAM_END || out.size() >= most) return out;
  const bool cut = answer == Z_BUF_ERROR || answer == Z_OK;
  throw_input({.where = where,
               .what = cut ? "the compressed data is truncated" : "the compressed data is damaged",
               .expected = {},
               .got = fmt::format("{} bytes before the {}", out.size(), cut ? "end" : "damage"),
               .fix = "write or download the file again"});
}

std::string gzip(const std::string& bytes) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzip, 9, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib does not start");
  std::string out, piece(std::size_t{1} << 20, '\0');
  std::string_view left = bytes;
  int answer = Z_OK;
  while (answer == Z_OK) {
    const std::size_t in = std::min(left.size(), piece.size());
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(left.data()));
    stream.avail_in = static_cast<uInt>(in);
    stream.next_out = reinterpret_cast<Bytef*>(piece.data());
    stream.avail_out = static_cast<uInt>(piece.size());
    answer = deflate(&stream, in == left.size() ? Z_FINISH : Z_NO_FLUSH);
    left.remove_prefix(in - stream.avail_in);
    out.append(piece, 0, piece.size() - stream.avail_out);
  }
  deflateEnd(&stream);
  return out;
}

}  // namespace fastsplat::scene
