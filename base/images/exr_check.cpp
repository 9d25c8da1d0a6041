// SPDX-License-Identifier: Apache-2.0
#include "base/images/exr_check.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace fastsplat::images {
namespace {

using Bytes = std::span<const unsigned char>;

/// Reads from the front; returns nothing if too few bytes are left.
class Reader {
 public:
  explicit Reader(Bytes bytes) : rest_(bytes) {}

  std::size_t left() const { return rest_.size(); }

  std::optional<Bytes> take(std::size_t count) {
    if (count > rest_.size()) return {};
    const Bytes taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  /// The text up to a zero byte; consumes that byte, too.
  std::optional<std::string_view> name() {
    const auto end = std::find(rest_.begin(), rest_.end(), 0);
    if (end == rest_.end()) return {};
    const auto length = static_cast<std::size_t>(end - rest_.begin());
    const std::string_view text(reinterpret_cast<const char*>(rest_.data()), length);
    rest_ = rest_.subspan(length + 1);
    return text;
  }
  std::optional<std::uint32_t> word() {
    const auto four = take(4);
    if (!four) return {};
    const Bytes& b = *four;
    return b[0] | std::uint32_t{b[1]} << 8 | std::uint32_t{b[2]} << 16 | std::uint32_t{b[3]} << 24;
  }

 private:
  Bytes rest_;
};

/// Bytes that OpenEXR reads for a type, regardless of the declared length; 0 if it follows the length.
std::size_t fixed_size(std::string_view type) {
  struct Type {
    std::string_view name;
    std::size_t size;
  };
  static constexpr std::array<Type, 24> kTypes{{{"box2f", 16},
                                                {"box2i", 16},
                                                {"chromaticities", 32},
                                                {"compression", 1},
                                                {"deepImageState", 1},
                                                {"double", 8},
                                                {"envmap", 1},
                                                {"float", 4},
                                                {"int", 4},
                                                {"keycode", 28},
                                                {"lineOrder", 1},
                                                {"m33d", 72},
                                                {"m33f", 36},
                                                {"m44d", 128},
                                                {"m44f", 64},
                                                {"rational", 8},
                                                {"tiledesc", 9},
                                                {"timecode", 8},
                                                {"v2d", 16},
                                                {"v2f", 8},
                                                {"v2i", 8},
                                                {"v3d", 24},
                                                {"v3f", 12},
                                                {"v3i", 12}}};
  const auto* found = std::find_if(kTypes.begin(), kTypes.end(), [type](const Type& t) { return t.name == type; });
  return found == kTypes.end() ? 0 : found->size;
}

constexpr std::size_t kChannel = 16;  // sample type, linearity and three reserved bytes, sampling in x and y

/// Channels, each a name and four words, up to an empty name; no bytes follow.
bool is_channel_list(Bytes value) {
  Reader reader(value);
  for (auto name = reader.name(); name; name = reader.name()) {
    if (name->empty()) return reader.left() == 0;
    if (!reader.take(kChannel)) return false;
  }
  return false;
}

/// Calls visit(name, words) for each channel.
template <class Visit>
void each_channel(Bytes list, const Visit& visit) {
  Reader reader(list);
  for (auto name = reader.name(); name && !name->empty(); name = reader.name()) {
    if (const auto words = reader.take(kChannel)) visit(*name, *words);
  }
}

bool is_sorted(Bytes list) {
  bool sorted = true;
  std::string_view before;
  each_channel(list, [&](std::string_view name, Bytes) {
    sorted &= before < name;
    before = name;
  });
  return sorted;
}

bool is_luminance_chroma(Bytes list) {
  bool found = false;
  each_channel(list, [&](std::string_view name, Bytes words) {
    Reader sampling(words.subspan(8));
    found |= sampling.word() != 1u || sampling.word() != 1u;
    found |= name == "BY" || name == "RY";  // newer decoders convert them, and fail unless they are subsampled
  });
  return found;
}

/// Texts, each preceded by its length.
bool is_text_list(Bytes value) {
  Reader reader(value);
  while (reader.left() > 0) {
    const auto length = reader.word();
    if (!length || !reader.take(*length)) return false;
  }
  return true;
}

/// Width and height, then width x height pixels of four bytes.
bool is_preview(Bytes value) {
  Reader reader(value);
  const auto width = reader.word();
  const auto height = reader.word();
  return width && height && std::uint64_t{*width} * *height == reader.left() / 4 && reader.left() % 4 == 0;
}

bool fits(std::string_view type, Bytes value) {
  if (const std::size_t size = fixed_size(type); size != 0) return value.size() == size;
  if (type == "chlist") return is_channel_list(value);
  if (type == "floatvector") return value.size() % 4 == 0;
  if (type == "stringvector") return is_text_list(value);
  return type != "preview" || is_preview(value);
}

/// Calls visit(type, value) for each attribute of all parts. Returns the first defect with its offset.
template <class Visit>
std::string walk(Bytes bytes, const Visit& visit) {
  constexpr std::uint32_t kMagic = 20000630, kSeveralParts = 1u << 12;
  Reader reader(bytes);
  const auto magic = reader.word();
  const auto version = reader.word();
  if (!magic || *magic != kMagic || !version) return "bad EXR signature";
  for (bool first_of_header = true;;) {
    const std::string where = " at byte " + std::to_string(bytes.size() - reader.left());
    const auto name = reader.name();
    if (!name) return "the file ends inside its header" + where;
    if (name->empty()) {
      // An empty header ends the list of parts.
      if ((*version & kSeveralParts) == 0 || first_of_header) return {};
      first_of_header = true;
      continue;
    }
    first_of_header = false;
    const auto type = reader.name();
    const auto length = reader.word();
    if (!type || !length) return "the file ends inside its header" + where;
    const std::size_t left = reader.left();
    const auto value = reader.take(*length);
    if (!value)
      return "an attribute of " + std::to_string(*length) + " bytes exceeds the remaining " + std::to_string(left) +
             where;
    if (const std::string defect = visit(*type, *value); !defect.empty()) return defect + where;
  }
}

}  // namespace

std::string exr_defect(Bytes bytes) {
  return walk(bytes, [](std::string_view type, Bytes value) {
    return fits(type, value) ? std::string() : "an attribute's length does not match its type";
  });
}

std::string exr_channel_defect(Bytes bytes) {
  return walk(bytes, [](std::string_view type, Bytes value) {
    return type != "chlist" || is_sorted(value) ? std::string() : "the channel list is not sorted by name";
  });
}

bool exr_is_luminance_chroma(Bytes bytes) {
  const auto defect = walk(bytes, [](std::string_view type, Bytes value) {
    return std::string(type == "chlist" && is_luminance_chroma(value) ? "luminance/chroma" : "");
  });
  return !defect.empty();
}

}  // namespace fastsplat::images
