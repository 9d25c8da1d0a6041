// How a picture's words lie in the page: split into planes that deflate well, and back in the browser
// (report/web/src/codec.ts; docs/report.md has the format).
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace fastsplat::report {

/// Words of a picture: row-major, y downwards, channels interleaved.
struct Words {
  int width = 0, height = 0, channels = 0;
  int bytes = 2;                         ///< of a word, 1 to 4; negative words are two's complement of so many bytes
  std::span<const std::int64_t> values;  ///< width*height*channels, each of `bytes` bytes
};

/// The least bytes that hold them all.
int bytes_for(std::span<const std::int64_t> values);

/// "split16-deflate": its name has the bits of a word.
std::string codec_name(int bytes);

/// Three steps. Each word becomes its difference to its left neighbour, modulo 2^(8 bytes). (The first of a row: to the
/// one above; the very first: to 0.) Channel by channel, each byte becomes a plane, lowest first. Then raw deflate.
std::string encode(const Words& words);

/// The words as they were, little-endian: what the browser hashes again.
std::string plain_bytes(const Words& words);

}  // namespace fastsplat::report
