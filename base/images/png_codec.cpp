// SPDX-License-Identifier: Apache-2.0
#include "base/images/png_codec.hpp"

#include <png.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <span>
#include <stdexcept>

#include "base/images/decoding.hpp"
#include "base/images/metadata_text.hpp"

namespace fastsplat::images {
namespace {

[[noreturn]] void fail(png_structp, png_const_charp reason) { throw std::runtime_error(reason); }
void ignore(png_structp, png_const_charp) {}

/// libpng's state, to read or to write.
struct Png {
  png_structp state;
  png_infop info;
  bool reads;

  explicit Png(bool read)
      : state((read ? png_create_read_struct : png_create_write_struct)(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore)),
        info(state == nullptr ? nullptr : png_create_info_struct(state)),
        reads(read) {
    if (info == nullptr) throw std::bad_alloc();
  }
  Png(const Png&) = delete;
  Png& operator=(const Png&) = delete;
  ~Png() { reads ? png_destroy_read_struct(&state, &info, nullptr) : png_destroy_write_struct(&state, &info); }
};

void take(png_structp state, png_bytep to, std::size_t count) {
  auto& left = *static_cast<std::string_view*>(png_get_io_ptr(state));
  if (count > left.size()) png_error(state, "the file ends too early");
  std::memcpy(to, left.data(), count);
  left.remove_prefix(count);
}

void append(png_structp state, png_bytep from, std::size_t count) {
  auto& bytes = *static_cast<std::vector<unsigned char>*>(png_get_io_ptr(state));
  bytes.insert(bytes.end(), from, from + count);
}

/// Samples of one picture, 8 or 16 bits, as values of [0, 1].
class Pixels {
 public:
  Pixels(Png& png, std::size_t file_bytes) : png_(png) {
    png_set_expand(png.state);  // palettes to RGB, few bits to eight, a transparent colour to alpha
    if (std::endian::native == std::endian::little) png_set_swap(png.state);
    passes_ = png_set_interlace_handling(png.state);
    png_read_update_info(png.state, png.info);
    width_ = png_get_image_width(png.state, png.info);
    height_ = png_get_image_height(png.state, png.info);
    channels_ = png_get_channels(png.state, png.info);
    deep_ = png_get_bit_depth(png.state, png.info) == 16;
    row_ = png_get_rowbytes(png.state, png.info);
    // Deflate shrinks nothing by more than this: a size that lies costs no memory.
    constexpr std::size_t kMostDeflated = 1032;
    if (row_ * height_ / kMostDeflated > file_bytes) throw std::runtime_error("fewer samples than its size says");
  }

  LoadedImage load() {
    LoadedImage out;
    out.kind = deep_ ? PixelKind::Uint16 : PixelKind::Uint8;
    out.image.width = static_cast<int>(width_);
    out.image.height = static_cast<int>(height_);
    out.image.channels = channels_ == 2 ? 4 : channels_;
    std::vector<unsigned char> rows(passes_ > 1 ? row_ * height_ : row_);
    for (int pass = 0; pass < passes_; ++pass) {
      for (std::size_t y = 0; y < height_; ++y) {
        unsigned char* row = rows.data() + (passes_ > 1 ? y * row_ : 0);
        png_read_row(png_.state, row, nullptr);
        if (pass + 1 == passes_) append_values(row, out.image.data);
      }
    }
    png_read_end(png_.state, png_.info);
    return out;
  }

 private:
  /// Grey with alpha becomes RGBA. The picture grows row by row: a size that lies costs little memory.
  void append_values(const unsigned char* row, std::vector<float>& to) const {
    const auto sample = [&](std::size_t i) {
      if (!deep_) return static_cast<float>(row[i] / 255.0);
      std::uint16_t word = 0;
      std::memcpy(&word, row + 2 * i, 2);
      return static_cast<float>(word / 65535.0);
    };
    const auto samples = width_ * static_cast<std::size_t>(channels_);
    for (std::size_t i = 0; i < samples; ++i) {
      if (channels_ == 2 && i % 2 == 0) to.insert(to.end(), 2, sample(i));
      to.push_back(sample(i));
    }
  }

  Png& png_;
  std::size_t width_ = 0, height_ = 0, row_ = 0;
  int channels_ = 0, passes_ = 1;
  bool deep_ = false;
};

Metadata metadata_of(Png& png) {
  Metadata out;
  png_textp texts = nullptr;
  int count = 0;
  png_get_text(png.state, png.info, &texts, &count);
  for (int i = 0; i < count; ++i) {
    const std::string_view name = texts[i].key, value = texts[i].text == nullptr ? "" : texts[i].text;
    if (name == "Description") read_metadata_lines(value, out);
    if (auto key = metadata_key(name)) out[*key] = value;
  }
  return out;
}

/// The orientation that EXIF data declare, in TIFF's form; 1 without.
int exif_orientation(std::span<const unsigned char> exif) {
  if (exif.size() < 8 || (exif[0] != 'I' && exif[0] != 'M')) return 1;
  const bool little = exif[0] == 'I';
  const auto number = [&](std::size_t at, std::size_t bytes) {
    std::size_t out = 0;
    for (std::size_t i = 0; i < bytes && at + bytes <= exif.size(); ++i)
      out = out << 8 | exif[at + (little ? bytes - 1 - i : i)];
    return out;
  };
  const std::size_t list = number(4, 4), count = number(list, 2);
  constexpr std::size_t kOrientation = 0x112, kEntry = 12;
  for (std::size_t i = 0; i < count && list + kEntry * (i + 1) < exif.size(); ++i) {
    const std::size_t entry = list + 2 + kEntry * i;
    if (number(entry, 2) == kOrientation) return static_cast<int>(number(entry + 8, 2));
  }
  return 1;
}

/// libpng may meet EXIF data before or behind the samples.
void check_exif(Png& png) {
  png_uint_32 size = 0;
  png_bytep exif = nullptr;
  if (png_get_eXIf_1(png.state, png.info, &size, &exif) == 0) return;
  check_upright(exif_orientation({exif, size}));
}

void write_texts(Png& png, const Encoding& picture) {
  const auto text = [&](const std::string& name, const std::string& value) {
    png_text one{};
    one.compression = PNG_TEXT_COMPRESSION_NONE;
    one.key = const_cast<char*>(name.c_str());
    one.text = const_cast<char*>(value.c_str());
    one.text_length = value.size();
    png_set_text(png.state, png.info, &one, 1);
  };
  const Metadata lines = only_as_lines(picture.metadata);
  for (const auto& [key, value] : picture.metadata)
    if (!lines.contains(key)) text(std::string(kEntryPrefix) + key, value);
  if (!lines.empty()) text("Description", metadata_lines(lines));
  text("Software", picture.software);
}

}  // namespace

std::optional<ErrorParts> decode_png(std::string_view bytes, LoadedImage& loaded) {
  try {
    Png png(true);
    std::string_view left = bytes;
    png_set_read_fn(png.state, &left, take);
    png_set_user_limits(png.state, 0x7fffffff, 0x7fffffff);
    png_read_info(png.state, png.info);
    check_exif(png);
    check_size(png_get_image_width(png.state, png.info), png_get_image_height(png.state, png.info),
               png_get_channels(png.state, png.info));
    loaded = Pixels(png, bytes.size()).load();
    loaded.metadata = metadata_of(png);
    check_exif(png);
    return {};
  } catch (const Refused& refused) {
    return refused.parts;
  } catch (const std::bad_alloc&) {
    return ErrorParts{{}, kNoMemory, {}, {}, {}};
  } catch (const std::exception& error) {
    return ErrorParts{{}, std::string("corrupt or truncated pixels: ") + error.what(), {}, {}, "write the file again"};
  }
}

std::string encode_png(const Encoding& picture, std::vector<unsigned char>& bytes) {
  try {
    Png png(false);
    png_set_write_fn(png.state, &bytes, append, nullptr);
    const bool deep = picture.kind == PixelKind::Uint16;
    const int model = picture.channels == 1   ? PNG_COLOR_TYPE_GRAY
                      : picture.channels == 3 ? PNG_COLOR_TYPE_RGB
                                              : PNG_COLOR_TYPE_RGB_ALPHA;
    png_set_IHDR(png.state, png.info, static_cast<png_uint_32>(picture.width), static_cast<png_uint_32>(picture.height),
                 deep ? 16 : 8, model, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    picture.srgb ? png_set_sRGB(png.state, png.info, PNG_sRGB_INTENT_ABSOLUTE)
                 : png_set_gAMA(png.state, png.info, 1.0);
    write_texts(png, picture);
    png_write_info(png.state, png.info);
    if (deep && std::endian::native == std::endian::little) png_set_swap(png.state);
    const std::size_t row = static_cast<std::size_t>(picture.width) * picture.channels * (deep ? 2 : 1);
    const auto* samples = static_cast<const unsigned char*>(picture.samples);
    for (int y = 0; y < picture.height; ++y) png_write_row(png.state, samples + y * row);
    png_write_end(png.state, png.info);
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace fastsplat::images
