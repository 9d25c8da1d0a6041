// SPDX-License-Identifier: Apache-2.0
// A picture of a report: the values of a file of any format as words, and their meaning.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace fastsplat::report {

struct Picture {
  std::string role;               ///< "golden", "integer", "rtl", "blame", or the user's
  std::string from;               ///< its file, as named
  std::vector<std::string> also;  ///< other files that hold the same values
  std::string kind;               ///< of the file's samples: "raw words", "float", "uint8"
  int width = 0, height = 0, channels = 0;
  std::vector<std::int64_t> words;  ///< as Words::values; value = word / scale
  std::int64_t scale = 1;           ///< the word of 1.0: 2^frac_bits, 255, 65535
  int frac_bits = -1;               ///< -1: the scale is not a power of two
  int int_bits = -1;                ///< of raw words; -1: unknown
  bool exact = true;                ///< false: the file's values were rounded to words
  bool display = false;             ///< made for display: sRGB, over black
  std::uint64_t nonfinite = 0;      ///< NaN and infinity; their words are 0
  std::map<std::string, std::string> metadata;
  std::vector<std::string> ties;                        ///< NamedPicture::tie of all results that name it
  int x0 = 0, y0 = 0, full_width = 0, full_height = 0;  ///< its window in the uncropped picture

  bool operator==(const Picture&) const = default;
};

/// Keeps raw words and 8 and 16 bit samples, and rounds floats to 16 fraction bits (fewer if 32 bits would not hold the
/// largest). UserError (Input) for files that images::read_image refuses.
Picture load_picture(const std::string& role, const std::filesystem::path& file);

/// Whether both have the same size, channels and values, compared exactly as word / scale.
bool same_values(const Picture& a, const Picture& b);

/// The part inside the window, which must lie within the picture.
Picture cropped(const Picture& picture, int x0, int y0, int width, int height);

}  // namespace fastsplat::report
