// SPDX-License-Identifier: Apache-2.0
// Encodes a picture's words for the page: split into byte planes that deflate well. The browser decodes them
// (report/web/src/codec.ts; docs/report.md has the format).
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace fastsplat::report {

/// Words of a picture: row-major, y downwards, channels interleaved.
struct Words {
  int width = 0, height = 0, channels = 0;
  int bytes = 2;                         ///< of a word, 1 to 4; negative words are in two's complement
  std::span<const std::int64_t> values;  ///< width*height*channels words that fit in `bytes` bytes
};

/// The smallest number of bytes per word that holds all values.
int bytes_for(std::span<const std::int64_t> values);

/// "split16-deflate"; the number is the bits of a word.
std::string codec_name(int bytes);

/// Three steps. Each word becomes its difference from its left neighbour, modulo 2^(8 bytes); the first word of a row
/// uses the one above, the very first uses 0. For each channel, each byte becomes a plane, lowest first. Then raw
/// deflate.
std::string encode(const Words& words);

/// The original words, little-endian; the browser checks their hash.
std::string plain_bytes(const Words& words);

}  // namespace fastsplat::report
