// SPDX-License-Identifier: Apache-2.0
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <utility>

#include "base/images/encoding.hpp"
#include "base/images/openimageio/attributes.hpp"
#include "base/images/openimageio/operations.hpp"

namespace fastsplat::images {
namespace {

using OIIO::TypeDesc;

constexpr int kLargestSide = 1 << 16;
constexpr std::int64_t kMostValues = std::int64_t{1} << 31;
constexpr std::int64_t kBlockValues = std::int64_t{1} << 22;  // decoded at once: limits the cost of a wrong header

constexpr const char* kUnnamed = "image";  // name for the decoders; our message gives the path
constexpr const char* kAgain = "write the file again";

/// Why a picture is refused; caught in this file.
struct Refused {
  ErrorParts parts;
};

[[noreturn]] void refuse(std::string what, std::string expected = {}, std::string got = {}, std::string fix = {}) {
  throw Refused{{{}, std::move(what), std::move(expected), std::move(got), std::move(fix)}};
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
    loaded.metadata = get_metadata(spec_);
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
        loaded.frac_bits = frac_bits(loaded.metadata);
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
    if (spec_.width < 1 || spec_.height < 1 || spec_.width > kLargestSide || spec_.height > kLargestSide) {
      refuse("unsupported image size", "sides of 1 to " + std::to_string(kLargestSide), size_text());
    }
    const int channels = spec_.nchannels;
    find_channels();
    if (std::int64_t{spec_.width} * spec_.height * channels > kMostValues) {
      refuse("image too large", "at most 2^31 values", size_text());
    }
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

  /// Finds channels by name, because libraries sort them: R, G, B, A or Y, A after a common prefix. A single channel
  /// may have any name.
  void find_channels() {
    const auto& names = spec_.channelnames;
    if (names.size() == 1) {
      order_ = {0};
      return;
    }
    std::string_view prefix = names.empty() ? std::string_view() : names[0];
    for (std::string_view name : names) {
      while (!name.starts_with(prefix)) prefix.remove_suffix(1);
    }
    for (const std::string_view wanted : {"RGB", "RGBA", "YA"}) {
      if (wanted.size() != names.size()) continue;
      order_.clear();
      for (const char letter : wanted) {
        const auto found = std::find(names.begin(), names.end(), std::string(prefix) + letter);
        if (found == names.end()) break;
        order_.push_back(static_cast<std::size_t>(found - names.begin()));
      }
      if (order_.size() == names.size()) return;
    }
    std::string all;
    for (const auto& name : names) all += (all.empty() ? "" : ", ") + name;
    refuse(names.size() == 4 ? "four channels, but the fourth is not alpha" : "unsupported channels",
           "channels named Y, YA, RGB or RGBA, or a single channel", all, "select or name channels with oiiotool --ch");
  }

  /// Refuses declarations that would change samples, which are taken as stored.
  void check_declared() {
    if (const int orientation = spec_.get_int_attribute("Orientation", 1); orientation != 1) {
      refuse("the image is stored rotated or mirrored: orientation " + std::to_string(orientation), "1", {},
             "write it upright with oiiotool --reorient");
    }
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
    if (const auto id = spec_.get_string_attribute("colorInteropID"); !id.empty()) return interop_encoding(id);
    const auto* declared = spec_.find_attribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8));
    if (declared == nullptr)
      return spec_.get_int_attribute("acesImageContainerFlag") == 1 ? with_primaries(kLinear, kAcesPrimaries) : "";
    Primaries primaries{};
    std::copy_n(static_cast<const float*>(declared->data()), primaries.size(), primaries.begin());
    return with_primaries(kLinear, primaries);
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

  std::string size_text() const {
    return std::to_string(spec_.width) + " x " + std::to_string(spec_.height) + " x " + std::to_string(spec_.nchannels);
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

  int frac_bits(const Metadata& metadata) const {
    const auto found = metadata.find("frac_bits");
    if (found == metadata.end()) {
      refuse("integer words of unknown scale", "metadata fastsplat:frac_bits", "none", "write it with this program");
    }
    const std::string& text = found->second;
    int bits = -1;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), bits);
    if (status != std::errc{} || end != text.data() + text.size() || bits < 0 || bits > 32) {
      refuse("bad metadata fastsplat:frac_bits", "0 to 32", text);
    }
    return bits;
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
