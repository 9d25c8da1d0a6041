// SPDX-License-Identifier: Apache-2.0
#include "base/images/exr_codec.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfChromaticitiesAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>

#include "base/images/decoding.hpp"
#include "base/images/encoding.hpp"
#include "base/images/metadata_text.hpp"

namespace fastsplat::images {
namespace {

constexpr std::int64_t kBlockValues = std::int64_t{1} << 22;  // decoded at once: limits the cost of a wrong header

class Source final : public Imf::IStream {
 public:
  explicit Source(std::string_view bytes) : IStream("image"), bytes_(bytes) {}
  bool read(char to[], int count) override {
    if (static_cast<std::uint64_t>(count) > bytes_.size() - at_) throw std::runtime_error("the file ends too early");
    std::memcpy(to, bytes_.data() + at_, static_cast<std::size_t>(count));
    at_ += static_cast<std::size_t>(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override {
    if (at > bytes_.size()) throw std::runtime_error("the file ends too early");
    at_ = at;
  }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
};

class Sink final : public Imf::OStream {
 public:
  explicit Sink(std::vector<unsigned char>& bytes) : OStream("image"), bytes_(bytes) {}
  void write(const char from[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (bytes_.size() < at_ + size) bytes_.resize(at_ + size);
    std::memcpy(bytes_.data() + at_, from, size);
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = at; }

 private:
  std::vector<unsigned char>& bytes_;
  std::size_t at_ = 0;
};

class Decoder {
 public:
  explicit Decoder(std::string_view bytes) : source_(bytes), file_(source_) {}

  LoadedImage load() {
    if (file_.parts() != 1)
      throw Refused("several images in one file", "one", {}, "select one with oiiotool --subimage");
    const Imf::Header& header = file_.header(0);
    if (header.hasType() && Imf::isDeepData(header.type())) throw Refused("deep or volume image", "a flat image");
    const auto window = header.dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1,
                       height = std::int64_t{window.max.y} - window.min.y + 1;
    for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel)
      names_.emplace_back(channel.name());
    check_size(width, height, static_cast<std::int64_t>(names_.size()));
    if (header.displayWindow() != window)
      throw Refused("the data window differs from the display window", {}, {}, "convert with oiiotool --croptofull");
    if (const auto* orientation = header.findTypedAttribute<Imf::IntAttribute>("Orientation"))
      check_upright(orientation->value());
    if (header.hasTileDescription()) check_tiles(header.tileDescription());
    order_ = channel_order(names_);

    LoadedImage out;
    out.kind = kind_of(header.channels());
    out.metadata = metadata_of(header);
    out.encoding = encoding_of(header);
    out.image.width = static_cast<int>(width);
    out.image.height = static_cast<int>(height);
    out.image.channels = order_.size() == 2 ? 4 : static_cast<int>(order_.size());
    if (order_.size() == 1 && names_[0] != "Y") out.grey = names_[0];
    if (out.kind == PixelKind::RawWords) {
      out.frac_bits = frac_bits_of(out.metadata);
      out.words = samples<std::uint32_t>(Imf::UINT, window);
      const double one = std::ldexp(1.0, out.frac_bits);
      for (const std::uint32_t word : out.words) out.image.data.push_back(static_cast<float>(word / one));
    } else {
      out.image.data = samples<float>(Imf::FLOAT, window);
    }
    return out;
  }

 private:
  void check_tiles(const Imf::TileDescription& tiles) const {
    if (std::int64_t{tiles.xSize} * tiles.ySize * static_cast<std::int64_t>(names_.size()) > kBlockValues) {
      throw Refused("tiles too large", "at most 2^22 values",
                    std::to_string(tiles.xSize) + " x " + std::to_string(tiles.ySize));
    }
  }

  static PixelKind kind_of(const Imf::ChannelList& channels) {
    const auto first = channels.begin().channel().type;
    bool half = true;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
      const auto type = channel.channel().type;
      if ((type == Imf::UINT) != (first == Imf::UINT))
        throw Refused("channels of different sample types", "half and float, or one type", "uint");
      half = half && type == Imf::HALF;
    }
    return first == Imf::UINT ? PixelKind::RawWords : half ? PixelKind::Half : PixelKind::Float;
  }

  static Metadata metadata_of(const Imf::Header& header) {
    Metadata out;
    for (auto at = header.begin(); at != header.end(); ++at) {
      const auto* text = dynamic_cast<const Imf::StringAttribute*>(&at.attribute());
      if (text == nullptr) continue;
      // Earlier versions of this program wrote some entries as lines of the comment.
      if (std::strcmp(at.name(), "comments") == 0) read_metadata_lines(text->value(), out);
      if (auto key = metadata_key(at.name())) out[*key] = text->value();
    }
    return out;
  }

  static std::string encoding_of(const Imf::Header& header) {
    if (const auto* id = header.findTypedAttribute<Imf::StringAttribute>("colorInteropID"))
      return interop_encoding(id->value());
    if (Imf::hasChromaticities(header)) {
      const Imf::Chromaticities& c = Imf::chromaticities(header);
      return with_primaries(kLinear, {c.red.x, c.red.y, c.green.x, c.green.y, c.blue.x, c.blue.y, c.white.x, c.white.y});
    }
    const auto* aces = header.findTypedAttribute<Imf::IntAttribute>("acesImageContainerFlag");
    return aces != nullptr && aces->value() == 1 ? with_primaries(kLinear, kAcesPrimaries) : "";
  }

  /// All samples, block of rows by block of rows: memory grows only with the decoded data.
  template <class T>
  std::vector<T> samples(Imf::PixelType type, const Imath::Box2i& window) {
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x) + 1;
    const std::size_t channels = names_.size(), row = width * channels;
    // Grey with alpha becomes RGBA.
    const std::vector<std::size_t> places =
        order_.size() == 2 ? std::vector<std::size_t>{order_[0], order_[0], order_[0], order_[1]} : order_;
    const int rows = static_cast<int>(std::clamp<std::int64_t>(kBlockValues / static_cast<std::int64_t>(row), 1, 65536));
    std::vector<T> block, out;
    Imf::InputPart part(file_, 0);
    for (int y = window.min.y; y <= window.max.y; y += rows) {
      const int last = std::min(window.max.y, y + rows - 1);
      block.resize(static_cast<std::size_t>(last - y + 1) * row);
      Imf::FrameBuffer buffer;
      for (std::size_t c = 0; c < channels; ++c) {
        buffer.insert(names_[c], Imf::Slice::Make(type, block.data() + c, Imath::V2i(window.min.x, y),
                                                  static_cast<std::int64_t>(width), last - y + 1,
                                                  channels * sizeof(T), row * sizeof(T)));
      }
      part.setFrameBuffer(buffer);
      part.readPixels(y, last);
      for (std::size_t pixel = 0; pixel < block.size(); pixel += channels)
        for (const std::size_t place : places) out.push_back(block[pixel + place]);
    }
    return out;
  }

  Source source_;
  Imf::MultiPartInputFile file_;
  std::vector<std::string> names_;
  std::vector<std::size_t> order_;  ///< place of each channel in a pixel
};

Imf::PixelType type_of(PixelKind kind) {
  return kind == PixelKind::Half ? Imf::HALF : kind == PixelKind::RawWords ? Imf::UINT : Imf::FLOAT;
}

}  // namespace

std::optional<ErrorParts> decode_exr(std::string_view bytes, LoadedImage& loaded) {
  try {
    loaded = Decoder(bytes).load();
    return {};
  } catch (const Refused& refused) {
    return refused.parts;
  } catch (const std::bad_alloc&) {
    return ErrorParts{{}, kNoMemory, {}, {}, {}};
  } catch (const std::exception& error) {
    return ErrorParts{{}, std::string("corrupt or truncated pixels: ") + error.what(), {}, {}, "write the file again"};
  }
}

std::string encode_exr(const Encoding& picture, std::vector<unsigned char>& bytes) {
  try {
    Imf::Header header(picture.width, picture.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities());  // those of sRGB
    for (const auto& [key, value] : picture.metadata)
      header.insert(std::string(kEntryPrefix) + key, Imf::StringAttribute(value));
    header.insert("Software", Imf::StringAttribute(picture.software));

    const Imf::PixelType type = type_of(picture.kind);
    const std::size_t channels = static_cast<std::size_t>(picture.channels),
                      values = static_cast<std::size_t>(picture.width) * picture.height * channels;
    std::vector<Imath::half> halves;
    const void* samples = picture.samples;
    if (type == Imf::HALF) {
      const auto* floats = static_cast<const float*>(picture.samples);
      halves.assign(floats, floats + values);
      samples = halves.data();
    }
    const std::size_t sample = type == Imf::HALF ? 2 : 4;
    Imf::FrameBuffer buffer;
    static constexpr const char* kRgba[] = {"R", "G", "B", "A"};
    for (std::size_t c = 0; c < channels; ++c) {
      const char* name = channels == 1 ? "Y" : kRgba[c];
      header.channels().insert(name, Imf::Channel(type));
      buffer.insert(name, Imf::Slice(type, const_cast<char*>(static_cast<const char*>(samples)) + c * sample,
                                     channels * sample, static_cast<std::size_t>(picture.width) * channels * sample));
    }
    Sink sink(bytes);
    {
      Imf::OutputFile file(sink, header);
      file.setFrameBuffer(buffer);
      file.writePixels(picture.height);
    }
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace fastsplat::images
