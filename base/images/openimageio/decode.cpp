// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <utility>

#include "base/images/decoding.hpp"
#include "base/images/encoding.hpp"
#include "base/images/metadata_text.hpp"
#include "base/images/openimageio/operations.hpp"

namespace fastsplat::images {
namespace {

using OIIO::TypeDesc;

constexpr std::int64_t kBlockValues = std::int64_t{1} << 22;  // decoded at once: limits the cost of a wrong header

constexpr const char* kUnnamed = "image";  // name for the decoders; our message gives the path
constexpr const char* kAgain = "write the file again";

[[noreturn]] void refuse(std::string what, std::string expected = {}, std::string got = {}, std::string fix = {}) {
  throw Refused(std::move(what), std::move(expected), std::move(got), std::move(fix));
}

class Decoder {
 public:
  Decoder(const std::string& format, std::string_view bytes)
      : memory_(bytes.data(), bytes.size()), input_(OIIO::ImageInput::create(format)) {
    if (!input_) refuse("cannot decode: " + OIIO::geterror(), "OpenImageIO with " + format + " support");
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);  // samples as stored: no multiplication by alpha
    input_->set_ioproxy(&memory_);
    if (!input_->open(kUnnamed, spec_, config)) corrupt("header");
  }

  LoadedImage load() {
    check_header();
    LoadedImage loaded;
    read_metadata_lines(std::string(spec_.get_string_attribute("ImageDescription")), loaded.metadata);
    loaded.kind = kind();
    loaded.image.width = spec_.width;
    loaded.image.height = spec_.height;
    loaded.image.channels = order_.size() == 2 ? 4 : spec_.nchannels;
    loaded.encoding = encoding();
    loaded.unassociated = loaded.image.channels == 4 && spec_.get_int_attribute("oiio:UnassociatedAlpha") != 0;
    if (order_.size() == 1 && spec_.channelnames[0] != "Y") loaded.grey = spec_.channelnames[0];
    auto& values = loaded.image.data;
    switch (loaded.kind) {
      case PixelKind::Float:
      case PixelKind::Half:
        values = samples<float>(TypeDesc::FLOAT);
        break;
      case PixelKind::Uint8:
        values = unit_values(samples<std::uint8_t>(TypeDesc::UINT8), 255.0);
        break;
      case PixelKind::Uint16:
        values = unit_values(samples<std::uint16_t>(TypeDesc::UINT16), 65535.0);
        break;
      case PixelKind::RawWords:
        loaded.frac_bits = frac_bits_of(loaded.metadata);
        loaded.words = samples<std::uint32_t>(TypeDesc::UINT32);
        values = unit_values(loaded.words, std::ldexp(1.0, loaded.frac_bits));
        break;
    }
    check_single();
    return loaded;
  }

 private:
  [[noreturn]] void corrupt(const std::string& where) {
    std::string reason = input_->geterror();
    for (const std::string& noise : {std::string(" image file \"") + kUnnamed + "\"", std::string(kUnnamed) + ": "}) {
      for (auto at = reason.find(noise); at != std::string::npos; at = reason.find(noise))
        reason.erase(at, noise.size());
    }
    refuse("corrupt or truncated " + where + (reason.empty() ? "" : ": " + reason), {}, {}, kAgain);
  }

  void check_header() {
    if (spec_.deep || spec_.depth != 1) refuse("deep or volume image", "a flat image");
    check_size(spec_.width, spec_.height, spec_.nchannels);
    const int channels = spec_.nchannels;
    order_ = channel_order(spec_.channelnames);
    const bool whole = spec_.x == spec_.full_x && spec_.y == spec_.full_y && spec_.width == spec_.full_width &&
                       spec_.height == spec_.full_height;
    if (!whole) {
      refuse("the data window differs from the display window", {}, {}, "convert with oiiotool --croptofull");
    }
    const std::string compression = spec_.get_string_attribute("compression");
    static constexpr std::array kLossless{"none", "lzw", "zip", "packbits", "zstd", "lzma"};
    if (std::strcmp(input_->format_name(), "tiff") == 0 && !compression.empty() &&
        std::find(kLossless.begin(), kLossless.end(), compression) == kLossless.end()) {
      refuse("TIFF compression is not supported", "none, lzw, zip, packbits, zstd or lzma", compression);
    }
    check_declared();
    if (spec_.tile_width != 0 && std::int64_t{spec_.tile_width} * spec_.tile_height * channels > kBlockValues) {
      refuse("tiles too large", "at most 2^22 values",
             std::to_string(spec_.tile_width) + " x " + std::to_string(spec_.tile_height));
    }
  }

  /// Refuses declarations that would change samples, which are taken as stored.
  void check_declared() {
    check_upright(spec_.get_int_attribute("Orientation", 1));
    const std::string model = spec_.get_string_attribute(std::string(input_->format_name()) + ":ColorSpace");
    constexpr int kPalette = 3;  // WhiteIsZero, BlackIsZero, RGB and palette are read as grey and RGB
    const bool followed = model.empty() || model == "palette";
    if (!followed || spec_.get_int_attribute("tiff:PhotometricInterpretation") > kPalette)
      refuse("unsupported colour model", "grey or RGB", model, "convert it to RGB");
    // The decoder inverts only samples of at most 8 bits.
    const bool white_is_zero = std::strcmp(input_->format_name(), "tiff") == 0 &&
                               spec_.get_int_attribute("tiff:PhotometricInterpretation", 1) == 0;
    if (white_is_zero && spec_.format != TypeDesc::UINT8)
      refuse("WhiteIsZero is not supported for samples of more than 8 bits", "BlackIsZero", {}, "invert it");
  }

  std::string encoding() const {
    if (spec_.find_attribute("ICCProfile") != nullptr)
      return profile_encoding(spec_.get_string_attribute("ICCProfile:profile_description", "unnamed"));
    return {};
  }

  /// Reorders to R, G, B, A; grey with alpha becomes RGBA.
  template <typename T>
  std::vector<T> in_order(std::vector<T> samples) const {
    const std::vector<std::size_t> as_rgba{order_[0], order_[0], order_[0], order_.back()};
    const auto& order = order_.size() == 2 ? as_rgba : order_;
    if (order.size() == order_.size() && std::is_sorted(order.begin(), order.end())) return samples;
    std::vector<T> out;
    out.reserve(samples.size() / order_.size() * order.size());
    for (std::size_t pixel = 0; pixel < samples.size(); pixel += order_.size())
      for (const std::size_t channel : order) out.push_back(samples[pixel + channel]);
    return out;
  }

  PixelKind kind() const {
    for (const auto& format : spec_.channelformats) {
      if (format != TypeDesc::HALF && format != TypeDesc::FLOAT) {
        refuse("channels of different sample types", "half and float, or one type", format.c_str());
      }
    }
    if (spec_.format == TypeDesc::FLOAT) return PixelKind::Float;
    if (spec_.format == TypeDesc::HALF) return PixelKind::Half;
    if (spec_.format == TypeDesc::UINT8) return PixelKind::Uint8;
    if (spec_.format == TypeDesc::UINT16) return PixelKind::Uint16;
    if (spec_.format == TypeDesc::UINT32) return PixelKind::RawWords;
    refuse("unsupported sample type", "half, float, uint8, uint16 or raw uint32", spec_.format.c_str());
  }

  /// Decodes all samples as `type`, block by block; memory grows only with the decoded data.
  template <typename T>
  std::vector<T> samples(TypeDesc type) {
    const std::int64_t row = std::int64_t{spec_.width} * spec_.nchannels;
    const bool tiled = spec_.tile_width != 0;
    std::int64_t rows = std::max<std::int64_t>(1, kBlockValues / row);
    if (tiled) rows = std::max<std::int64_t>(1, rows / spec_.tile_height) * spec_.tile_height;
    std::vector<T> out;
    if (row * spec_.height <= kBlockValues) out.reserve(static_cast<std::size_t>(row) * spec_.height);
    for (int y = 0; y < spec_.height;) {
      const int end = static_cast<int>(std::min<std::int64_t>(spec_.height, y + rows));
      const std::size_t filled = out.size();
      out.resize(filled + static_cast<std::size_t>(row) * (end - y));
      const int top = spec_.y + y;
      const int bottom = spec_.y + end;
      const bool read =
          tiled ? input_->read_tiles(0, 0, spec_.x, spec_.x + spec_.width, top, bottom, 0, 1, 0, spec_.nchannels, type,
                                     out.data() + filled)
                : input_->read_scanlines(0, 0, top, bottom, 0, 0, spec_.nchannels, type, out.data() + filled);
      // Some readers return true but set an error for the part they could not decode.
      if (!read || input_->has_error()) corrupt("pixels");
      y = end;
    }
    return in_order(std::move(out));
  }

  template <typename T>
  static std::vector<float> unit_values(const std::vector<T>& samples, double one) {
    std::vector<float> values(samples.size());
    std::transform(samples.begin(), samples.end(), values.begin(),
                   [one](T sample) { return static_cast<float>(sample / one); });
    return values;
  }

  void check_single() {
    if (input_->seek_subimage(1, 0)) {
      refuse("several images in one file", "one", {}, "select one with oiiotool --subimage");
    }
    (void)input_->geterror();  // clears "no such subimage", the good case
  }

  OIIO::Filesystem::IOMemReader memory_;
  std::unique_ptr<OIIO::ImageInput> input_;
  OIIO::ImageSpec spec_;
  std::vector<std::size_t> order_;  ///< place of each channel in a pixel
};

}  // namespace

std::optional<ErrorParts> decode(const std::string& format, std::string_view bytes, LoadedImage& loaded) {
  try {
    loaded = Decoder(format, bytes).load();
    return {};
  } catch (Refused& refused) {
    return std::move(refused.parts);
  } catch (const std::bad_alloc&) {
    return ErrorParts{{}, kNoMemory, {}, {}, {}};
  } catch (const std::exception& error) {  // thrown by a decoder
    return ErrorParts{{}, std::string("corrupt: ") + error.what(), {}, {}, {}};
  }
}

}  // namespace fastsplat::images
