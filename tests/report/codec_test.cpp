// SPDX-License-Identifier: Apache-2.0
// The page's data decode to their source: planes and deflate decoded independently, base64 by its standard.
#include "report/codec.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

#include "report/base64.hpp"

namespace fastsplat::report {
namespace {

std::string inflated(const std::string& bytes, std::size_t size) {
  std::string out(size, '\0');
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, -15), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  EXPECT_EQ(stream.avail_in, 0u) << "bytes after the end";
  EXPECT_EQ(stream.total_out, size);
  inflateEnd(&stream);
  return out;
}

/// As in docs/report.md, row by row.
std::vector<std::int64_t> decoded(const std::string& bytes, int width, int height, int channels, int word_bytes,
                                  bool has_sign) {
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const std::string planes =
      inflated(bytes, pixels * static_cast<std::size_t>(channels) * static_cast<std::size_t>(word_bytes));
  std::vector<std::int64_t> words(pixels * static_cast<std::size_t>(channels));
  const std::int64_t modulus = std::int64_t{1} << 8 * word_bytes;
  for (int c = 0; c < channels; ++c) {
    const auto at = [&](int x, int y) -> std::int64_t& {
      return words[static_cast<std::size_t>((y * width + x) * channels + c)];
    };
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        std::int64_t difference = 0;
        for (int b = 0; b < word_bytes; ++b) {
          const auto plane = static_cast<std::size_t>(c * word_bytes + b);
          const char byte = planes[plane * pixels + static_cast<std::size_t>(y * width + x)];
          difference |= std::int64_t{static_cast<unsigned char>(byte)} << 8 * b;
        }
        const std::int64_t before = x > 0 ? at(x - 1, y) : y > 0 ? at(x, y - 1) : 0;
        at(x, y) = ((before + difference) % modulus + modulus) % modulus;
        if (has_sign && at(x, y) >= modulus / 2) at(x, y) -= modulus;
      }
    }
  }
  return words;
}

TEST(Codec, GivesEveryWordBack) {
  std::mt19937_64 random(5);
  std::size_t checked = 0;
  for (const int bytes : {1, 2, 3, 4}) {
    for (const bool has_sign : {false, true}) {
      for (const auto& [width, height, channels] : {std::tuple{2, 1, 1}, {1, 9, 3}, {17, 1, 4}, {33, 21, 4}}) {
        const std::int64_t room = std::int64_t{1} << 8 * bytes, least = has_sign ? -room / 2 : 0;
        std::vector<std::int64_t> words(static_cast<std::size_t>(width * height * channels));
        for (auto& word : words) word = least + static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(room));
        words.front() = least;
        words.back() = least + room - 1;
        ASSERT_EQ(bytes_for(words), bytes);
        const std::string packed = encode({width, height, channels, bytes, words});
        ASSERT_EQ(decoded(packed, width, height, channels, bytes, has_sign), words);
        checked += words.size();
      }
    }
  }
  std::printf("[figure] words given back = %zu (limit > 0)\n", checked);
  EXPECT_GT(checked, 0u);
}

TEST(Codec, TakesTheLeastBytesThatHoldAll) {
  const auto bytes = [](std::vector<std::int64_t> words) { return bytes_for(words); };
  EXPECT_EQ(bytes({}), 1);
  EXPECT_EQ(bytes({0, 255}), 1);
  EXPECT_EQ(bytes({0, 256}), 2);
  EXPECT_EQ(bytes({65536}), 3);
  EXPECT_EQ(bytes({-1, 127}), 1);
  EXPECT_EQ(bytes({-1, 128}), 2);
  EXPECT_EQ(bytes({-8388609}), 4);
  EXPECT_EQ(codec_name(2), "split16-deflate");
}

TEST(Codec, PlainBytesAreLittleEndian) {
  const std::vector<std::int64_t> words{0x1234, -2};
  EXPECT_EQ(plain_bytes({1, 1, 2, 2, words}), std::string("\x34\x12\xfe\xff", 4));
}

TEST(Codec, ASmoothPictureGetsSmall) {
  std::vector<std::int64_t> words;
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) words.push_back(100 * x + 37 * y);
  }
  const double share = static_cast<double>(encode({256, 256, 1, 2, words}).size()) / (2.0 * 256 * 256);
  std::printf("[figure] share of a smooth picture's bytes = %.4f (limit < 0.02)\n", share);
  EXPECT_LT(share, 0.02);
}

TEST(Base64, IsTheStandards) {
  const std::vector<std::pair<std::string, std::string>> examples{{"", ""},
                                                                  {"f", "Zg=="},
                                                                  {"fo", "Zm8="},
                                                                  {"foo", "Zm9v"},
                                                                  {"foob", "Zm9vYg=="},
                                                                  {"foobar", "Zm9vYmFy"},
                                                                  {std::string("\xff\x00\xfe", 3), "/wD+"}};
  for (const auto& [bytes, text] : examples) EXPECT_EQ(base64(bytes), text);
}

}  // namespace
}  // namespace fastsplat::report
