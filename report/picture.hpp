// A picture of a report: the words of a file, whatever its format, with what they stand for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace fastsplat::report {

struct Picture {
  std::string role;               ///< "golden", "integer", "rtl", "blame"; a word of the user's
  std::string from;               ///< its file, as named
  std::vector<std::string> also;  ///< other files that hold the same values
  std::string kind;               ///< of the file's samples: "raw words", "float", "uint8"
  int width = 0, height = 0, channels = 0;
  std::vector<std::int64_t> words;  ///< as Words::values; value = word / scale
  std::int64_t scale = 1;           ///< the word of 1.0: 2^frac_bits, 255, 65535
  int frac_bits = -1;               ///< -1: the scale is no power of two
  int int_bits = -1;                ///< of raw words that tell
  bool exact = true;                ///< else the file's values were rounded to words
  bool display = false;             ///< made for looking: sRGB, over black
  std::uint64_t nonfinite = 0;      ///< NaN and infinity; their words are 0
  std::map<std::string, std::string> metadata;
  std::vector<std::string> ties;                        ///< NamedPicture::tie of all that name it
  int x0 = 0, y0 = 0, full_width = 0, full_height = 0;  ///< the window that is left of a larger one

  bool operator==(const Picture&) const = default;
};

/// Raw words as they are, 8 and 16 bit samples as they are, floats rounded to 16 fraction bits (fewer where they are
/// so large that 32 bits would not hold them). UserError (Input) for what images::read_image refuses.
Picture load_picture(const std::string& role, const std::filesystem::path& file);

/// Whether both hold the same values: equal size and channels, and word by word the same number.
bool same_values(const Picture& a, const Picture& b);

/// What is left inside the window, which lies wholly in the picture.
Picture cropped(const Picture& picture, int x0, int y0, int width, int height);

}  // namespace fastsplat::report
